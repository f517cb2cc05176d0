/* What `aureole render` keeps of a long render: checkpoints to go on from. */
#pragma once

#include <aureole-render/ask.h>

#include "program/cli/options.h"

/* `path` NULL: none are kept. */
typedef struct cli_checkpoint {
    const char *path;
    double every; /* seconds */
    bool resume;
    /* One of these from the time on when there is something to keep. */
    const aur_render *render;
    const aur_ask *ask;
    aur_progress progress; /* what is shown meanwhile */
    double last;           /* when the last one was written, or tried */
    bool writes;           /* this is the process that does */
    bool warned;           /* that one could not be written */
} cli_checkpoint;

extern const cli_option cli_checkpoint_options[]; /* cli_checkpoint */

/* What is wrong with the options, or NULL. */
const char *cli_checkpoint_conflict(const cli_call *call);

/* The progress callback that also writes checkpoints. The first checkpoint that cannot be written is warned
 * of, and the render goes on. */
aur_progress cli_checkpoint_progress(cli_checkpoint *checkpoint, aur_progress progress);

/* Takes up what there is: nothing, said so unless `quiet`, where there is no checkpoint yet. From now on
 * checkpoints are written. One of `render` and `ask` is NULL. */
aur_result cli_checkpoint_begin(cli_checkpoint *checkpoint, aur_render *render, aur_ask *ask, bool quiet,
                                aur_error *error);
/* Writes the last one where the samples are `good`: to be called when the image is already in its file, and
 * before the render is destroyed. */
void cli_checkpoint_end(cli_checkpoint *checkpoint, bool good);
