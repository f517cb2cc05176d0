/* Functions for commands that read images. */
#pragma once

#include <aureole-render/image.h>

#include "program/cli/options.h"
#include "program/cli/render/luminance.h"

/* The part of an image to read. */
typedef struct cli_image_input {
    cli_list channels; /* empty: all */
    size_t downsample; /* 1: unchanged */
    cli_luminance luminance;
} cli_image_input;

extern const cli_option cli_image_input_options[]; /* of a cli_image_input */

/* The extensions of writable image formats; NULL beyond the last. */
const char *cli_image_input_format(unsigned index);

/* Warns of values that are infinite or NaN, or negative if the format cannot store them, and of their
 * replacement. */
void cli_warn_of_values(const char *path, const aur_image *image, bool negative, const char *fate);

/* Reads an image and applies the options. Prints an error and returns the exit status. */
int cli_read_image(const char *path, const cli_image_input *options, aur_image **image);

/* Pages with an image viewer. */

/* Writes a page with images of one size to `path`, with luminances in false colors if `how` requests them;
 * the first image is the reference of the others if `judged`. Prints an error and returns the exit status. */
int cli_write_viewer(const char *path, size_t count, char **names, const cli_image_input *how,
                     double exposure, bool judged);
