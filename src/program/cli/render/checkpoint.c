#include "program/cli/render/render_result.h"

#include <aureole/ranks.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "program/cli/options.h"

static aur_result parse_interval(const char *text, void *field, aur_error *error) {
    return cli_parse_seconds("checkpoint-every", text, field, error);
}

const cli_option cli_checkpoint_options[] = {
    {CLI_TEXT(cli_checkpoint, path, "checkpoint", "FILE", NULL, "write a checkpoint to FILE"),
     .content = "file", .writes = true},
    {CLI_TEXT(cli_checkpoint, every, "checkpoint-every", "TIME", "60s", "time between checkpoints"),
     .parse = parse_interval},
    {CLI_FLAG(cli_checkpoint, resume, "resume",
              "resume from the checkpoint, if it exists; the image is identical to that of an uninterrupted "
              "render")},
    {.key = {0}}};

const char *cli_checkpoint_conflict(const cli_call *call) {
    if (cli_given(call, "checkpoint") != NULL)
        return NULL;
    return cli_given(call, "resume") != NULL             ? "render: '--resume' needs '--checkpoint'"
           : cli_given(call, "checkpoint-every") != NULL ? "render: '--checkpoint-every' needs '--checkpoint'"
                                                         : NULL;
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Rank 0 writes, on any thread. Only the first failure is reported, because a full disk stays full. */
static void save(cli_checkpoint *checkpoint) {
    if (!checkpoint->writes)
        return;
    aur_error error = {0};
    const aur_result result = checkpoint->render != NULL
                                  ? aur_render_save(checkpoint->render, checkpoint->path, &error)
                                  : aur_adaptive_save(checkpoint->adaptive, checkpoint->path, &error);
    checkpoint->last = now();
    if (result == AUR_OK || checkpoint->warned)
        return;
    checkpoint->warned = true;
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY + 64];
    aur_error_format(&error, sizeof text, text);
    cli_progress_clear();
    fprintf(stderr, "aureole: warning: no checkpoint: %s\n", text);
}

static int show(void *user, const char *what, uint64_t done, uint64_t total) {
    cli_checkpoint *const checkpoint = user;
    if ((checkpoint->render != NULL || checkpoint->adaptive != NULL) &&
        now() - checkpoint->last >= checkpoint->every)
        save(checkpoint);
    return checkpoint->progress.function(checkpoint->progress.user, what, done, total);
}

aur_progress cli_checkpoint_progress(cli_checkpoint *checkpoint, aur_progress progress) {
    checkpoint->progress = progress;
    checkpoint->writes = aur_ranks_rank() == 0;
    return checkpoint->path != NULL ? (aur_progress){.function = show, .user = checkpoint} : progress;
}

aur_result cli_checkpoint_begin(cli_checkpoint *checkpoint, aur_render *render, aur_adaptive *adaptive,
                                bool quiet, aur_error *error) {
    if (checkpoint->path == NULL)
        return AUR_OK;
    bool exists = access(checkpoint->path, F_OK) == 0;
    aur_ranks_agree(sizeof exists, &exists);
    if (checkpoint->resume && exists) {
        const aur_result result = render != NULL ? aur_render_resume(render, checkpoint->path, error)
                                                 : aur_adaptive_resume(adaptive, checkpoint->path, error);
        if (result != AUR_OK)
            return result;
    } else if (checkpoint->resume && !quiet) {
        cli_progress_clear();
        fprintf(stderr, "aureole: checkpoint %s not found: rendering from the start\n", checkpoint->path);
    }
    checkpoint->render = render;
    checkpoint->adaptive = adaptive;
    checkpoint->last = now();
    return AUR_OK;
}

void cli_checkpoint_end(cli_checkpoint *checkpoint, bool good) {
    if (good && (checkpoint->render != NULL || checkpoint->adaptive != NULL))
        save(checkpoint);
    checkpoint->render = NULL;
    checkpoint->adaptive = NULL;
}
