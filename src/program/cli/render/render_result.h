/* What is said of a render when it ends, and where its files go. */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/render.h>

#include "program/cli/options.h"
#include "program/watch/watch.h"

/* On standard error: samples, rays and times, and what each of several processes did, all of which call it.
 */
void cli_print_statistics(const aur_render *render);
/* How a render ended that asked for no error: `samples` a pixel, and the relative error of these, or 0. */
typedef struct cli_render_end {
    size_t samples;
    double error;
} cli_render_end;

/* What programs are told of a render, however it was asked for: NaN is what is not known. */
typedef struct cli_render_summary {
    const char *output, *integrator;
    double error, error_low, error_high, bias_high; /* by the measure of the target */
    double mean, rounds, samples_per_pixel;
    double clamped;                    /* cli_clamped_part */
    const aur_error_figures *measures; /* [AUR_ERROR_MEASURE_COUNT], or NULL */
    const aur_adaptive *adaptive;      /* whose race is listed, or NULL */
    aur_render_statistics statistics;
} cli_render_summary;

/* On standard output, for programs. */
aur_result cli_print_json(const cli_render_summary *summary, aur_error *error);

/* What an interrupted render has goes beside the image, as OUT.partial.exr, or render.partial.exr where the
 * image was to go to standard output. */
void cli_write_partial(const char *wanted, const aur_image *image);
/* The standard error that the film's steps tell (aur_film_error), relative to the mean of its image; 0
 * where they are too few, or the image is black. */
double cli_relative_error(const aur_film *film);

/* Of an image with channels clamped.R, .G, .B: the part of all light that a limit took away; else 0. */
double cli_clamped_part(const aur_image *image);
/* The last line: where the image is and how good it is. Warns before it of a black image, which nobody
 * wants. */
void cli_say_picture(const char *output, const aur_image *image, const cli_render_end *end);
/* Reports on a black image what clip planes have cut off. */
void cli_explain_black(const aur_scene *scene, const aur_image *image);

/* What `aureole render` keeps of a long render: checkpoints to go on from. */

/* `path` NULL: none are kept. */
typedef struct cli_checkpoint {
    const char *path;
    double every; /* seconds */
    bool resume;
    /* One of these from the time on when there is something to keep. */
    const aur_render *render;
    const aur_adaptive *adaptive;
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
aur_result cli_checkpoint_begin(cli_checkpoint *checkpoint, aur_render *render, aur_adaptive *adaptive,
                                bool quiet, aur_error *error);
/* Writes the last one where the samples are `good`: to be called when the image is already in its file, and
 * before the render is destroyed. */
void cli_checkpoint_end(cli_checkpoint *checkpoint, bool good);

/* What `aureole render` shows of an image while it is rendered. */

typedef struct cli_watch {
    const char *serve;    /* "", PORT or HOST:PORT; NULL: there is no page */
    const char *display;  /* HOST:PORT; NULL: there is none */
    watch_session *watch; /* NULL: nobody watches, or another process serves */
    aur_progress progress;
    double from, to; /* the part of the render that the step is; both 0: it is no step */
} cli_watch;

extern const cli_option cli_watch_options[]; /* cli_watch */

/* Whether the render goes in steps, so that the whole image is seen soon. */
static inline bool cli_watch_is_asked(const cli_watch *watch) {
    return watch->serve != NULL || watch->display != NULL;
}

/* Lets pages turn the camera of the scene, whose renders are not kept otherwise. */
void cli_watch_allow_turns(cli_watch *watch);
/* After a render that ended as `result`: whether it is to be rendered again, by a camera that a page has
 * turned. Waits for pages that turn it where the render was not stopped. */
bool cli_watch_turn(cli_watch *watch, aur_result result, aur_scene *scene, aur_image *image);

/* Begins to serve, and says where; connects to a display server. */
aur_result cli_watch_begin(cli_watch *watch, const char *output, aur_error *error);
/* The progress callback, over all steps, that also tells who watches; who watches may stop the render by it.
 */
aur_progress cli_watch_progress(cli_watch *watch, aur_progress progress);

/* From now on there is an image to see, until cli_watch_hide; one of `render` and `ask` is NULL. */
void cli_watch_show(cli_watch *watch, const aur_render *render, const aur_adaptive *adaptive);
void cli_watch_hide(cli_watch *watch);
/* Renders so many samples more, or for 0 all that remain, and tells what they make of the image. */
aur_result cli_watch_step(cli_watch *watch, aur_render *render, size_t count, aur_error *error);

/* All has ended as `result` and `error` say, with `image` or NULL. */
void cli_watch_end(cli_watch *watch, const aur_image *image, aur_result result, const aur_error *error);

/* `aureole render` to an error, for a time, or for a number of rays. */

/* What was asked for; all zero: nothing, and the scene is rendered as it says. */
typedef struct cli_target {
    double error, bias, seconds;
    uint64_t rays, rounds;
    aur_error_measure measure;
    bool error_map;
} cli_target;

extern const cli_option cli_target_options[]; /* cli_target */

bool cli_is_target(const cli_target *target);

/* What goes on beside. */
typedef struct cli_surroundings {
    cli_checkpoint *checkpoint;
    cli_watch *watch;
    const char *output; /* for messages */
    bool quiet, json, verbose;
} cli_surroundings;

/* Renders what was asked for. *image is the image; CANCELLED by an interrupt leaves what there is of it, or
 * NULL; *made is to be destroyed in every case. The last line, unless `quiet`, says how good it is; where
 * `json` is asked for, standard output does so for programs. */
/* The error of an image of half of the samples, denoised. */
void cli_say_denoised(const aur_error_figures *figures, aur_error_measure measure);

aur_result cli_render_target(aur_renderer *renderer, const aur_render_options *options,
                             const cli_target *target, const cli_surroundings *beside, aur_adaptive **made,
                             aur_image **image, aur_error *error);

/* The error of an image against a reference while it is rendered. */

typedef struct cli_errors cli_errors;

/* Reads the reference. Prints what is wrong and returns NULL. */
cli_errors *cli_errors_create(const char *reference);
void cli_errors_destroy(cli_errors *errors); /* NULL is allowed */
/* Notes the error of what there is of the image. */
aur_result cli_errors_note(cli_errors *errors, const aur_render *render, aur_error *error);
/* Writes samples per pixel, samples, rays, CPU seconds, RMSE and relative RMSE of what was noted as CSV. */
aur_result cli_errors_write(const cli_errors *errors, const char *path, aur_error *error);
