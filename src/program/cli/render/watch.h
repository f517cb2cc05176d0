/* What `aureole render` shows of a picture while it is rendered. */
#pragma once

#include <aureole-render/ask.h>

#include "program/cli/options.h"
#include "program/watch/watch.h"

typedef struct cli_watch {
    const char *serve;    /* "", PORT or HOST:PORT; NULL: there is no page */
    const char *display;  /* HOST:PORT; NULL: there is none */
    watch_session *watch; /* NULL: nobody watches, or another process serves */
    aur_progress progress;
    double from, to; /* the part of the render that the step is; both 0: it is no step */
} cli_watch;

extern const cli_option cli_watch_options[]; /* cli_watch */

/* Whether the render goes in steps, so that the whole picture is seen soon. */
static inline bool cli_watch_is_asked(const cli_watch *watch) {
    return watch->serve != NULL || watch->display != NULL;
}

/* Begins to serve, and says where; connects to a display server. */
aur_result cli_watch_begin(cli_watch *watch, const char *output, aur_error *error);
/* The progress callback, over all steps, that also tells who watches; who watches may stop the render by it.
 */
aur_progress cli_watch_progress(cli_watch *watch, aur_progress progress);

/* From now on there is a picture to see, until cli_watch_hide; one of `render` and `ask` is NULL. */
void cli_watch_show(cli_watch *watch, const aur_render *render, const aur_ask *ask);
void cli_watch_hide(cli_watch *watch);
/* Renders so many samples more, or for 0 all that remain, and tells what they make of the picture. */
aur_result cli_watch_step(cli_watch *watch, aur_render *render, size_t count, aur_error *error);

/* All has ended as `result` and `error` say, with `image` or NULL. */
void cli_watch_end(cli_watch *watch, const aur_image *image, aur_result result, const aur_error *error);
