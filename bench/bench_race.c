/* Cost of choosing the integrator for a target error, in rooms generated from seeds: CPU time of the chosen
 * candidate and of the whole render, over the best candidate's. */
#include <aureole-render/adaptive.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "render/race/race.h"
#include "room.h"

enum { ROOMS = 12, QUICK_ROOMS = 2 };

/* CPU seconds to the target error with an integrator, or with the race (NULL), extrapolated from the error
 * that the render reached. Infinite on failure. */
static double cost(aur_renderer *renderer, const char *integrator, aur_error_measure measure, double error,
                   char chosen[256]) {
    aur_render_options render = {.size = sizeof render};
    aur_render_options_init(&render, NULL);
    render.width = 128;
    render.height = 96;
    render.threads = 1;
    render.use_cache = 0;
    render.integrator = integrator;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = error;
    target.measure = measure;
    if (integrator != NULL && strncmp(integrator, "finalgather", 11) == 0)
        target.bias = 0.5 * error;
    aur_adaptive *adaptive = NULL;
    aur_adaptive_report report = {.size = sizeof report};
    double seconds = INFINITY;
    if (aur_adaptive_create(renderer, &render, &target, &adaptive, NULL) == AUR_OK &&
        aur_adaptive_run(adaptive, NULL) == AUR_OK &&
        aur_adaptive_get_report(adaptive, &report, NULL) == AUR_OK)
        seconds = report.statistics.cpu_seconds;
    if (chosen != NULL)
        snprintf(chosen, 256, "%s", adaptive != NULL ? aur_adaptive_integrator(adaptive) : "");
    aur_adaptive_destroy(adaptive);
    return seconds;
}

typedef struct ratios {
    double choice, whole, worst_choice, worst_whole; /* sums of logarithms in the first two */
    size_t count;
} ratios;

static bool run_room(uint64_t seed, aur_error_measure measure, double error, ratios *sum) {
    static bench_room generated;
    bench_room_make(seed, &generated);
    aur_scene *scene = NULL;
    if (aur_scene_load_memory("room.xml", generated.used, generated.text, NULL, &scene, NULL) != AUR_OK)
        return false;
    double best = INFINITY, chosen_seconds = INFINITY;
    char chosen[256], best_name[32] = "";
    aur_renderer *renderer = NULL;
    const bool created = aur_renderer_create(scene, &renderer, NULL) == AUR_OK;
    const double whole = created ? cost(renderer, NULL, measure, error, chosen) : INFINITY;
    aur_renderer_destroy(renderer);
    for (size_t row = 0; row < AUR_RACE_ROWS && created; ++row) {
        char *const text = aur_race_integrator(row, "path", 100000, 0);
        renderer = NULL;
        if (text != NULL && aur_renderer_create(scene, &renderer, NULL) == AUR_OK) {
            const double seconds = cost(renderer, text, measure, error, NULL);
            const char *const keys = strstr(text, "photons=");
            const size_t same = keys != NULL ? (size_t)(keys - text) : strlen(text);
            if (strncmp(text, chosen, same) == 0)
                chosen_seconds = seconds;
            if (seconds < best) {
                best = seconds;
                snprintf(best_name, sizeof best_name, "%s", aur_race_name(row));
            }
        }
        aur_renderer_destroy(renderer);
        free(text);
    }
    aur_scene_destroy(scene);
    if (!(best > 0.0 && best < INFINITY && chosen_seconds < INFINITY && whole < INFINITY))
        return false;
    printf("  %4llu  %-8s %4.0f %%  %-18s %8.2f s  choice %5.2f  whole %5.2f\n", (unsigned long long)seed,
           aur_error_measure_name(measure), 100.0 * error, best_name, best, chosen_seconds / best,
           whole / best);
    fflush(stdout);
    sum->choice += log(chosen_seconds / best);
    sum->whole += log(whole / best);
    sum->worst_choice = fmax(sum->worst_choice, chosen_seconds / best);
    sum->worst_whole = fmax(sum->worst_whole, whole / best);
    ++sum->count;
    return true;
}

static bool run(const bench_options *options) {
    ratios sum = {.count = 0};
    printf("  room  measure   error  best candidate       CPU s, over it the chosen one and the whole "
           "request\n");
    for (uint64_t k = 0; k < (options->quick ? QUICK_ROOMS : ROOMS); ++k)
        for (int m = 0; m < (options->quick ? 1 : 2); ++m)
            if (!run_room(101 + k, (aur_error_measure)m, options->quick ? 0.1 : 0.05, &sum))
                printf("  %4llu  failed\n", (unsigned long long)(101 + k));
    if (sum.count == 0)
        return false;
    printf("  geometric mean: choice %.2f, whole %.2f; worst %.2f, %.2f\n",
           exp(sum.choice / (double)sum.count), exp(sum.whole / (double)sum.count), sum.worst_choice,
           sum.worst_whole);
    return true;
}

const bench bench_race = {"adaptive", "the choice of the integrator for a target error, over the best one",
                          run};
