/* `aureole render` to an error, for a time, or for a number of rays. */
#pragma once

#include "program/cli/render/checkpoint.h"
#include "program/cli/render/watch.h"

/* What was asked for; all zero: nothing, and the scene is rendered as it says. */
typedef struct cli_wish {
    double error, bias, seconds;
    uint64_t rays, rounds;
    bool error_map;
} cli_wish;

extern const cli_option cli_wish_options[]; /* cli_wish */

bool cli_is_wish(const cli_wish *wish);

/* What goes on beside. */
typedef struct cli_surroundings {
    cli_checkpoint *checkpoint;
    cli_watch *watch;
    const char *output; /* for messages */
    bool quiet, json;
} cli_surroundings;

/* Renders what was asked for. *image is the picture; CANCELLED by an interrupt leaves what there is of it, or
 * NULL; *made is to be destroyed in every case. The last line, unless `quiet`, says how good it is; where
 * `json` is asked for, standard output does so for programs. */
aur_result cli_render_wish(aur_renderer *renderer, const aur_render_options *options, const cli_wish *wish,
                           const cli_surroundings *beside, aur_ask **made, aur_image **image,
                           aur_error *error);
