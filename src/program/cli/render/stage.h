/* How `aureole render` sees and lights scenes and models, and how images are displayed. */
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

/* Reads the operands FILE[@X,Y,Z[,TURN[,SCALE]]], which lose what stands behind the file. Errors: ARGUMENT.
 */
aur_result cli_stage_read_files(cli_stage *given, const cli_call *call, aur_error *error);

typedef struct cli_display {
    bool is_given, automatic;
    float exposure; /* stops, unless automatic */
    aur_tone tone;
} cli_display;

extern const cli_option cli_display_options[]; /* cli_display */

/* What is wrong with the options for this output, or NULL. */
const char *cli_display_conflict(const cli_display *display, const char *output);
/* `scene`: the file of the image's scene. Models and Radiance's files have lights of any units: where these
 * leave most of an image white or black, and no exposure is given, it is automatic, with a warning. */
aur_result cli_display_write(const cli_display *display, const char *scene, const char *output,
                             const aur_image *image, const aur_warnings *warnings, aur_error *error);
