
#include <aureole/ranks.h>
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/cli/render/render_result.h"

const cli_option cli_watch_options[] = {
    {CLI_TEXT(cli_watch, serve, "serve", "PORT", NULL,
              "serve a page that shows the image during rendering, at [HOST:]PORT or a free port; the "
              "address is printed"),
     .value_is_optional = true},
    {CLI_TEXT(cli_watch, display, "display-server", "HOST:PORT", NULL,
              "send the image during rendering to tev or another viewer with its protocol")},
    {.key = {0}}};

static void warn(cli_watch *watch) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    if (!watch_has_lost_display(watch->watch, sizeof text, text))
        return;
    cli_progress_clear();
    fprintf(stderr, "aureole: warning: %s\n", text);
}

static int show(void *user, const char *what, uint64_t done, uint64_t total) {
    enum { WHOLE = 10000 };
    cli_watch *const watch = user;
    if (watch->to > watch->from && total > 0) {
        done = (uint64_t)(WHOLE * (watch->from + (watch->to - watch->from) * (double)done / (double)total));
        total = WHOLE;
    }
    const int status = watch->progress.function(watch->progress.user, what, done, total);
    const bool stopped = watch->watch != NULL && watch_progress(watch->watch, what, cli_progress_share());
    if (watch->watch != NULL)
        warn(watch);
    return stopped ? 1 : status;
}

aur_result cli_watch_begin(cli_watch *watch, const char *output, aur_error *error) {
    if (!cli_watch_is_requested(watch) || aur_ranks_rank() != 0)
        return AUR_OK;
    const watch_options options = {.serve = watch->serve, .display = watch->display, .title = output};
    const aur_result result = watch_create(&options, &watch->watch, error);
    if (result == AUR_OK && watch_address(watch->watch) != NULL)
        fprintf(stderr, "aureole: serving the image at %s\n", watch_address(watch->watch));
    return result;
}

void cli_watch_allow_turns(cli_watch *watch) {
    if (watch->watch != NULL && aur_ranks_count() == 1)
        watch_allow_turns(watch->watch);
}

bool cli_watch_turn(cli_watch *watch, aur_result result, aur_scene *scene, aur_image *image) {
    watch_turn turn;
    if (watch->watch == NULL || (result != AUR_OK && result != AUR_ERROR_CANCELLED))
        return false;
    if (result == AUR_OK && !watch_wait_for_turn(watch->watch, image))
        return false;
    return watch_take_turn(watch->watch, &turn) &&
           aur_scene_turn(scene, turn.azimuth, turn.elevation, turn.distance, NULL) == AUR_OK;
}

aur_progress cli_watch_progress(cli_watch *watch, aur_progress progress) {
    watch->progress = progress;
    return (aur_progress){.function = show, .user = watch};
}

static aur_result develop_render(void *user, aur_image **image, aur_error *error) {
    return aur_film_develop(aur_render_film(user), image, error);
}

static aur_result develop_adaptive(void *user, aur_image **image, aur_error *error) {
    return aur_adaptive_develop(user, true, image, error);
}

static void describe_adaptive(void *user, size_t capacity, char *text) {
    aur_adaptive_report report = {.size = sizeof report};
    if (aur_adaptive_get_report(user, &report, NULL) != AUR_OK || !isfinite(report.error_high))
        return;
    aur_format(text, capacity,
               "error after %.4g samples per pixel (95 %% intervals):", report.samples_per_pixel);
    for (unsigned m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        const aur_error_figures *const figures = &report.errors[m];
        const size_t used = strlen(text);
        aur_format(text + used, capacity - used, "%s %s %.3g %% [%.3g, %.3g]", m > 0 ? "," : "",
                   aur_error_measure_name((aur_error_measure)m), 100.0 * figures->error, 100.0 * figures->low,
                   100.0 * figures->high);
    }
}

void cli_watch_show(cli_watch *watch, aur_render *render, aur_adaptive *adaptive) {
    if (watch->watch == NULL)
        return;
    const watch_source source = {.user = render != NULL ? (void *)render : adaptive,
                                 .develop = render != NULL ? develop_render : develop_adaptive,
                                 .describe = render != NULL ? NULL : describe_adaptive};
    watch_set_source(watch->watch, &source);
}

void cli_watch_hide(cli_watch *watch) {
    if (watch->watch != NULL)
        watch_set_source(watch->watch, &(watch_source){0});
}

static void report_samples(cli_watch *watch, const aur_render *render) {
    char text[160], error[80] = "";
    const double relative = cli_relative_error(aur_render_film(render));
    if (relative > 0.0)
        aur_format(error, sizeof error, "; the error is at most about %.2g %% of the mean", 100.0 * relative);
    aur_format(text, sizeof text, "%zu of %zu samples per pixel%s", aur_render_samples(render),
               aur_render_samples_target(render), error);
    watch_describe(watch->watch, text);
}

aur_result cli_watch_step(cli_watch *watch, aur_render *render, size_t count, aur_error *error) {
    const double total_samples = (double)aur_render_samples_target(render);
    watch->from = (double)aur_render_samples(render) / total_samples;
    watch->to = count > 0 ? fmin(watch->from + (double)count / total_samples, 1.0) : 1.0;
    const aur_result result = aur_render_step(render, count, error);
    watch->from = watch->to = 0.0;
    if (result == AUR_OK && watch->watch != NULL)
        report_samples(watch, render);
    return result;
}

void cli_watch_end(cli_watch *watch, const aur_image *image, aur_result result, const aur_error *error) {
    if (watch->watch == NULL)
        return;
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY + 64] = "";
    if (result != AUR_OK && result != AUR_ERROR_CANCELLED)
        aur_error_format(error, sizeof text, text);
    watch_end(watch->watch, image,
              result == AUR_OK                ? "The image is finished."
              : result == AUR_ERROR_CANCELLED ? "The render was stopped."
                                              : text);
    warn(watch);
    watch_destroy(watch->watch);
    watch->watch = NULL;
}
