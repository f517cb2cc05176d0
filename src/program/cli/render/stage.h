/* Camera, lighting and models of `aureole render`, and the display of images. */
#pragma once

#include <aureole-render/image.h>
#include <aureole-render/scene.h>

#include "program/cli/options.h"

enum { CLI_FILE_LIMIT = 256 };

typedef struct cli_stage {
    aur_scene_stage stage;
    const char *further[CLI_FILE_LIMIT];
    aur_scene_placement placements[CLI_FILE_LIMIT];
} cli_stage;

extern const cli_option cli_stage_options[]; /* cli_stage */

/* Parses the operands FILE[@X,Y,Z[,TURN[,SCALE]]] and truncates them to the file. Errors: ARGUMENT. */
aur_result cli_stage_read_files(cli_stage *given, const cli_call *call, aur_error *error);

typedef struct cli_display {
    bool is_given, automatic;
    float exposure; /* stops, unless automatic */
    aur_tone tone;
} cli_display;

extern const cli_option cli_display_options[]; /* cli_display */

/* A message if the options do not apply to this output, or NULL. */
const char *cli_display_conflict(const cli_display *display, const char *output);
/* `scene`: the image's scene file. Models and Radiance files have light sources in arbitrary units: if most
 * of an image without exposure would be white or black, the exposure is automatic, with a warning. */
aur_result cli_display_write(const cli_display *display, const char *scene, const char *output,
                             const aur_image *image, const aur_warnings *warnings, aur_error *error);
