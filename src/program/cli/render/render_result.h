/* Reports at the end of a render, and its output files. */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/render.h>

#include "program/cli/options.h"
#include "program/watch/watch.h"

/* Prints samples, rays and times on standard error, and statistics per process; a collective operation of all
 * ranks. */
void cli_print_statistics(const aur_render *render);
/* The end of a render without a target error: `samples` per pixel, and their relative error, or 0. */
typedef struct cli_render_end {
    size_t samples;
    double error;
} cli_render_end;

/* The machine-readable report of a render, with or without a target; NaN: not available. */
typedef struct cli_render_summary {
    const char *output, *integrator;
    double error, error_low, error_high, bias_high; /* by the target's measure */
    double mean, rounds, samples_per_pixel;
    double clamped;                    /* cli_clamped_part */
    const aur_error_figures *measures; /* [AUR_ERROR_MEASURE_COUNT], or NULL */
    aur_adaptive *adaptive;            /* the race to list, or NULL */
    aur_render_statistics statistics;
} cli_render_summary;

/* Prints JSON on standard output. */
aur_result cli_print_json(const cli_render_summary *summary, aur_error *error);

/* Writes the image of an interrupted render to OUT.partial.exr, or render.partial.exr if the output is
 * standard output. */
void cli_write_partial(const char *final_path, const aur_image *image);
/* The standard error from the film's steps (aur_film_error), relative to the image's mean; 0 with too few
 * steps or for a black image. */
double cli_relative_error(const aur_film *film);

/* The fraction of light that clamping removed, for an image with channels clamped.R, .G, .B; otherwise 0. */
double cli_clamped_part(const aur_image *image);
/* Prints the last line: the image's file and error. Warns of a black image. */
void cli_report_image(const char *output, const aur_image *image, const cli_render_end *end);
/* Reports the clip planes if they cut off a black image's surfaces. */
void cli_explain_black(const aur_scene *scene, const aur_image *image);

/* Checkpoints of `aureole render`, from which it can resume. */

/* `path` NULL: no checkpoints. */
typedef struct cli_checkpoint {
    const char *path;
    double every; /* seconds */
    bool resume;
    /* One of these is set once there is something to save. */
    const aur_render *render;
    aur_adaptive *adaptive;
    aur_progress progress; /* the next callback */
    double last;           /* time of the last write or attempt */
    bool writes;           /* this process writes */
    bool warned;           /* a failure was reported */
} cli_checkpoint;

extern const cli_option cli_checkpoint_options[]; /* cli_checkpoint */

/* A message if the options conflict, or NULL. */
const char *cli_checkpoint_conflict(const cli_call *call);

/* Returns a progress callback that also writes checkpoints. Warns of the first one that cannot be written;
 * the render continues. */
aur_progress cli_checkpoint_progress(cli_checkpoint *checkpoint, aur_progress progress);

/* Resumes from the checkpoint, or prints, unless `quiet`, that there is none. From now on checkpoints are
 * written. One of `render` and `adaptive` is NULL. */
aur_result cli_checkpoint_begin(cli_checkpoint *checkpoint, aur_render *render, aur_adaptive *adaptive,
                                bool quiet, aur_error *error);
/* Writes the last checkpoint if the samples are `good`. Call it after the image is written and before the
 * render is destroyed. */
void cli_checkpoint_end(cli_checkpoint *checkpoint, bool good);

/* Display of the image during rendering by `aureole render`. */

typedef struct cli_watch {
    const char *serve;    /* "", PORT or HOST:PORT; NULL: no page */
    const char *display;  /* HOST:PORT; NULL: none */
    watch_session *watch; /* NULL: no display, or another process serves */
    aur_progress progress;
    double from, to; /* the interval of progress that the current step covers; both 0: no steps */
} cli_watch;

extern const cli_option cli_watch_options[]; /* cli_watch */

/* Whether the render uses steps, so that the whole image is visible early. */
static inline bool cli_watch_is_requested(const cli_watch *watch) {
    return watch->serve != NULL || watch->display != NULL;
}

/* Allows pages to turn the camera of the scene. */
void cli_watch_allow_turns(cli_watch *watch);
/* After a render that ended with `result`: whether to render again with a camera that a page has turned.
 * Waits for pages that turn it unless the render was stopped. */
bool cli_watch_turn(cli_watch *watch, aur_result result, aur_scene *scene, aur_image *image);

/* Starts to serve, and prints the address; connects to a display server. */
aur_result cli_watch_begin(cli_watch *watch, const char *output, aur_error *error);
/* Returns the progress callback over all steps that also updates the viewers; a viewer may stop the render.
 */
aur_progress cli_watch_progress(cli_watch *watch, aur_progress progress);

/* From now on there is an image to show, until cli_watch_hide; one of `render` and `adaptive` is NULL. */
void cli_watch_show(cli_watch *watch, aur_render *render, aur_adaptive *adaptive);
void cli_watch_hide(cli_watch *watch);
/* Renders `count` more samples per pixel, or all remaining ones for 0, and reports the error. */
aur_result cli_watch_step(cli_watch *watch, aur_render *render, size_t count, aur_error *error);

/* Reports the end with `result` and `error`, and `image` or NULL. */
void cli_watch_end(cli_watch *watch, const aur_image *image, aur_result result, const aur_error *error);

/* `aureole render` to a target error, for a time, or with a number of rays. */

/* The target; all zero: none, and the scene's sample count applies. */
typedef struct cli_target {
    double error, bias, seconds;
    uint64_t rays, rounds;
    aur_error_measure measure;
    bool error_map;
    bool independent_pixels; /* as in aur_adaptive_options */
    size_t replicas;         /* the same; 0: its default */
} cli_target;

extern const cli_option cli_target_options[]; /* cli_target */

bool cli_is_target(const cli_target *target);

/* Services during a render. */
typedef struct cli_render_services {
    cli_checkpoint *checkpoint;
    cli_watch *watch;
    const char *output; /* for messages */
    bool quiet, json, verbose;
} cli_render_services;

/* Renders to the target. *image is the image; if cancelled, the partial image or NULL. The caller always
 * destroys *adaptive. Unless `quiet`, the last line reports the error; with `json` it is also printed on
 * standard output. */
/* Prints the error of a denoised image of half of the samples. */
void cli_report_denoised(const aur_error_figures *figures, aur_error_measure measure);

aur_result cli_render_target(aur_renderer *renderer, const aur_render_options *options,
                             const cli_target *target, const cli_render_services *services,
                             aur_adaptive **created, aur_image **image, aur_error *error);

/* The error of an image against a reference during rendering. */

typedef struct cli_errors cli_errors;

/* Reads the reference. Prints an error and returns NULL. */
cli_errors *cli_errors_create(const char *reference);
void cli_errors_destroy(cli_errors *errors); /* NULL is allowed */
/* Records the error of the current image. */
aur_result cli_errors_note(cli_errors *errors, const aur_render *render, aur_error *error);
/* Writes the records as CSV: samples per pixel, samples, rays, CPU seconds, RMSE and relative RMSE. */
aur_result cli_errors_write(const cli_errors *errors, const char *path, aur_error *error);
