#include "program/cli/render/render_result.h"

#include <aureole/ranks.h>
#include <aureole/text.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/cli.h"

/* Prints statistics per process. A collective operation of all ranks. */
static void print_ranks(void) {
    const size_t count = aur_ranks_count();
    aur_rank_description *const ranks = count > 1 ? calloc(count, sizeof *ranks) : NULL;
    if (ranks == NULL)
        return;
    aur_ranks_describe(ranks);
    for (size_t r = 0; r < count; ++r)
        fprintf(stderr,
                "aureole: rank %zu on %s: %.2f CPU s, %.3f of them talk, %" PRIu64 " bytes sent, %" PRIu64
                " received\n",
                r, ranks[r].host, ranks[r].cpu_seconds, ranks[r].message_seconds, ranks[r].sent,
                ranks[r].received);
    free(ranks);
}

void cli_print_statistics(const aur_render *render) {
    aur_render_statistics counted = {.size = sizeof counted};
    aur_render_get_statistics(render, &counted, NULL);
    const aur_render_statistics *const statistics = &counted;
    const double seconds = statistics->prepare_seconds + statistics->render_seconds;
    fprintf(stderr,
            "aureole: %" PRIu64 " samples, %" PRIu64
            " rays, prepared in %.2f s, rendered in %.2f s (%.2f Mray/s), "
            "%.2f CPU s, %" PRIu64 " invalid samples\n",
            statistics->samples, statistics->rays, statistics->prepare_seconds, statistics->render_seconds,
            seconds > 0 ? 1e-6 * (double)statistics->rays / seconds : 0.0, statistics->cpu_seconds,
            statistics->invalid_samples);
    for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
        if (statistics->levels[l] > 0)
            fprintf(stderr, "aureole: %" PRIu64 " gathers ended at level %zu\n", statistics->levels[l],
                    l + 1);
    print_ranks();
}

static void print_figures(report_table *table, const char *measure, const aur_error_figures *figures) {
    static const char *const ends[] = {"error", "error_low", "error_high"};
    const double values[] = {figures->error, figures->low, figures->high};
    for (size_t i = 0; i < 3; ++i) {
        char name[40];
        aur_format(name, sizeof name, "%s_%s", measure, ends[i]);
        report_fact_number(table, name, values[i]);
    }
}

/* "NAME: RAYS rays, needs NEED, REASON; ..."; empty without a race. */
static void print_race(report_table *table, aur_adaptive *adaptive) {
    char text[1024] = "";
    aur_adaptive_report report = {.size = sizeof report};
    if (adaptive != NULL)
        aur_adaptive_get_report(adaptive, &report, NULL);
    for (size_t i = 0; i < report.race_count; ++i) {
        aur_adaptive_candidate one = {.size = sizeof one};
        const size_t used = strlen(text);
        if (aur_adaptive_get_candidate(adaptive, i, &one, NULL) == AUR_OK)
            aur_format(text + used, sizeof text - used, "%s%s: %.4g rays, needs %.4g, %s", i > 0 ? "; " : "",
                       one.name, one.rays, one.need, one.reason);
    }
    report_fact_text(table, "race", text);
}

aur_result cli_print_json(const cli_render_summary *summary, aur_error *error) {
    const aur_render_statistics *const statistics = &summary->statistics;
    report_table *const table = report_create(0, NULL);
    report_fact_text(table, "output", summary->output);
    report_fact_text(table, "integrator", summary->integrator);
    report_fact_number(table, "error", summary->error);
    report_fact_number(table, "error_low", summary->error_low);
    report_fact_number(table, "error_high", summary->error_high);
    report_fact_number(table, "bias_high", summary->bias_high);
    for (unsigned m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m)
        print_figures(table, aur_error_measure_name((aur_error_measure)m),
                      summary->measures != NULL ? &summary->measures[m]
                                                : &(aur_error_figures){NAN, NAN, NAN});
    print_race(table, summary->adaptive);
    report_fact_number(table, "mean", summary->mean);
    report_fact_number(table, "rounds", summary->rounds);
    report_fact_number(table, "samples_per_pixel", summary->samples_per_pixel);
    report_fact_number(table, "clamped", summary->clamped);
    report_fact_number(table, "samples", (double)statistics->samples);
    report_fact_number(table, "rays", (double)statistics->rays);
    report_fact_number(table, "prepare_seconds", statistics->prepare_seconds);
    report_fact_number(table, "render_seconds", statistics->render_seconds);
    report_fact_number(table, "cpu_seconds", statistics->cpu_seconds);
    report_fact_number(table, "invalid_samples", (double)statistics->invalid_samples);
    const aur_result result = report_write(table, REPORT_JSON, stdout, error);
    report_destroy(table);
    return result;
}

void cli_write_partial(const char *final_path, const aur_image *image) {
    const char *const output = strcmp(final_path, "-") == 0 ? "render.exr" : final_path;
    char path[PATH_MAX];
    aur_error error = {0};
    const char *const slash = strrchr(output, '/'), *const dot = strrchr(slash != NULL ? slash : output, '.');
    const size_t length = dot != NULL ? (size_t)(dot - output) : strlen(output);
    snprintf(path, sizeof path, "%.*s.partial.exr", (int)length, output);
    if (aur_image_write(path, image, NULL, &error) == AUR_OK)
        fprintf(stderr, "aureole: wrote the unfinished image %s\n", path);
    else
        cli_fail(&error);
}

double cli_relative_error(const aur_film *film) {
    double rmse[4], mean[4] = {0};
    aur_image *image = NULL;
    const bool measured = aur_film_error(film, rmse, NULL, NULL) == AUR_OK &&
                          aur_film_develop(film, &image, NULL) == AUR_OK &&
                          aur_image_mean(image, mean, NULL) == AUR_OK;
    aur_image_destroy(image);
    return measured && mean[3] > 0.0 ? rmse[3] / mean[3] : 0.0;
}

double cli_clamped_part(const aur_image *image) {
    static const char *const names[] = {"R", "G", "B", "clamped.R", "clamped.G", "clamped.B"};
    double remaining = 0.0, removed = 0.0;
    const size_t channels = aur_image_channel_count(image);
    for (size_t c = 0; c < 6; ++c) {
        const size_t channel = aur_image_find_channel(image, names[c]);
        if (channel >= channels)
            return 0.0;
        for (size_t i = 0; i < aur_image_width(image) * aur_image_height(image); ++i)
            *(c < 3 ? &remaining : &removed) += (double)aur_image_data(image)[i * channels + channel];
    }
    return removed > 0.0 ? removed / (remaining + removed) : 0.0;
}

static bool is_black(const aur_image *image) {
    size_t channels[3];
    if (!aur_image_color_channels(image, channels))
        return false;
    for (size_t i = 0; i < aur_image_width(image) * aur_image_height(image) * 3; ++i)
        if (aur_image_data(image)[i / 3 * aur_image_channel_count(image) + channels[i % 3]] != 0.0f)
            return false;
    return true;
}

void cli_explain_black(const aur_scene *scene, const aur_image *image) {
    aur_clip_description clips = {.size = sizeof clips};
    if (!is_black(image) || aur_scene_get_clips(scene, &clips, NULL) != AUR_OK)
        return;
    if (clips.too_far > 0)
        aur_print(stderr,
                  "aureole: %zu of %zu camera rays end at far_clip (%g) before the surface that they would "
                  "meet\n",
                  clips.too_far, clips.rays, clips.far_clip);
    if (clips.too_near > 0)
        aur_print(stderr, "aureole: %zu of %zu camera rays begin at near_clip (%g), beyond all surfaces\n",
                  clips.too_near, clips.rays, clips.near_clip);
}

void cli_report_image(const char *output, const aur_image *image, const cli_render_end *end) {
    if (strcmp(output, "-") == 0)
        output = "the image";
    if (is_black(image))
        aur_print(stderr, "aureole: warning: %s is black: no sample met light (--camera, --environment)\n",
                  output);
    else if (end->error > 0.0)
        aur_print(
            stderr,
            "aureole: %s has an error of at most about %.*f %% of its mean, after %zu samples per pixel\n",
            output, end->error < 0.1, 100.0 * end->error, end->samples);
    else
        aur_print(stderr,
                  "aureole: %s has %zu sample%s per pixel; use --error 5%% to render to a target error\n",
                  output, end->samples, end->samples == 1 ? "" : "s");
}
