/* What the commands that read images share. */
#pragma once

#include <aureole-render/image.h>

#include "program/cli/options.h"
#include "program/cli/render/luminance.h"

/* Which part of an image is read. */
typedef struct cli_picture {
    cli_list channels; /* of no count: all */
    size_t downsample; /* 1: as it is */
    cli_luminance luminance;
} cli_picture;

extern const cli_option cli_picture_options[]; /* of a cli_picture */

/* The formats that an image can be written in, by extension; NULL beyond the last. */
const char *cli_picture_format(unsigned index);

/* Warns of values that are infinite or NaN, or negative where the format has none, and says what becomes of
 * them. */
void cli_warn_of_values(const char *path, const aur_image *image, bool negative, const char *fate);

/* Reads an image and makes of it what the options ask for. Prints what is wrong and returns the exit
 * status. */
int cli_read_picture(const char *path, const cli_picture *options, aur_image **image);

/* Pages with a viewer of images. */

/* Writes a page with images of one size to `path`, luminances in false colours if `how` asks for them; the
 * first is the reference of the others where `judged`.
 * Prints what is wrong and returns the exit status. */
int cli_write_viewer(const char *path, size_t count, char **names, const cli_picture *how, double exposure,
                     bool judged);
