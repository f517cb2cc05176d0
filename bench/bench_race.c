/* Cost of choosing the integrator for a target error, in rooms generated from seeds and in bundled scenes, or
 * in one scene file: CPU time of the chosen candidate and of the whole request, over the best candidate's. */
#include <aureole-render/adaptive.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "render/adaptive/adaptive.h"
#include "room.h"

enum { FIRST_ROOM = 101, ROOMS = 24, QUICK_ROOMS = 2 };

static const char *const scenes[] = {
    "cornell-box/cornell-box.xml", "cornell-box/figure.xml", "room/room.xml",    "parade/parade.xml",
    "plates/plates.xml",           "statue/statue.xml",      "sphere/sphere.xml"};

typedef struct target {
    aur_error_measure measure;
    double error;
} target;

typedef struct outcome {
    double seconds, rays; /* CPU time and work of all */
    double ray_seconds;   /* of the samples, per ray */
    bool met;             /* not stopped by the limit of rays */
    size_t row;           /* of the race, and what it predicted: */
    double needs[AUR_RACE_ROWS];
} outcome;

/* Renders to the target with an integrator, or with the race (NULL), by at most `most` rays (0: no limit). */
static bool run_to(const aur_scene *scene, const char *integrator, const target *goal, double most,
                   outcome *found) {
    aur_render_options render = {.size = sizeof render};
    aur_render_options_init(&render, NULL);
    render.width = 128;
    render.height = 96;
    render.threads = 1;
    render.use_cache = 0;
    render.integrator = integrator;
    aur_adaptive_options options = {.size = sizeof options};
    aur_adaptive_options_init(&options, NULL);
    options.error = goal->error;
    options.measure = goal->measure;
    options.rays = (uint64_t)most;
    if (integrator != NULL && strncmp(integrator, "finalgather", 11) == 0)
        options.bias = 0.5 * goal->error;
    aur_renderer *renderer = NULL;
    aur_adaptive *adaptive = NULL;
    aur_adaptive_report report = {.size = sizeof report};
    const bool good = aur_renderer_create(scene, &renderer, NULL) == AUR_OK &&
                      aur_adaptive_create(renderer, &render, &options, &adaptive, NULL) == AUR_OK &&
                      aur_adaptive_run(adaptive, NULL) == AUR_OK &&
                      aur_adaptive_get_report(adaptive, &report, NULL) == AUR_OK;
    if (good) {
        *found = (outcome){.seconds = report.statistics.cpu_seconds,
                           .rays = (double)report.statistics.rays,
                           .ray_seconds = report.statistics.render_seconds /
                                          aur_replicas_rays(&adaptive->candidate.replicas),
                           .met = report.error_high <= goal->error || most == 0.0,
                           .row = adaptive->row};
        for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
            found->needs[i] = adaptive->race.entries[i].need;
    }
    aur_adaptive_destroy(adaptive);
    aur_renderer_destroy(renderer);
    return good;
}

typedef struct ratios {
    double choice, whole, worst_choice, worst_whole; /* sums of logarithms in the first two */
    double prices[AUR_RACE_ROWS]; /* sums of logarithms of the time per ray, relative to path tracing's */
    size_t count;
} ratios;

static bool run_row(const aur_scene *scene, size_t row, const target *goal, double most, outcome *found) {
    char *const text = aur_race_integrator(row, "path", 100000, 0);
    const bool good = text != NULL && run_to(scene, text, goal, most, found);
    free(text);
    return good;
}

/* All candidates; what takes four times as many rays as the chosen one is not the best by any price of a ray.
 */
static bool run_rows(const aur_scene *scene, const target *goal, size_t chosen, outcome rows[AUR_RACE_ROWS]) {
    bool good = run_row(scene, chosen, goal, 0.0, &rows[chosen]);
    for (size_t i = 0; i < AUR_RACE_ROWS && good; ++i)
        if (i != chosen)
            good = run_row(scene, i, goal, 4.0 * rows[chosen].rays, &rows[i]);
    return good;
}

static void print_rows(const outcome *whole, const outcome rows[AUR_RACE_ROWS]) {
    const size_t chosen = whole->row;
    printf("       ");
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        printf(" %s %s%.2f", aur_race_rows[i].name, rows[i].met ? "" : ">",
               rows[i].seconds / rows[chosen].seconds);
        if (whole->needs[i] > 0.0)
            printf(" (%.2f)", whole->needs[i] / whole->needs[chosen]);
    }
    printf("\n");
}

static bool run_scene(const aur_scene *scene, const char *name, const target *goal, ratios *sum) {
    outcome whole, rows[AUR_RACE_ROWS];
    if (!run_to(scene, NULL, goal, 0.0, &whole) || !run_rows(scene, goal, whole.row, rows))
        return false;
    size_t best = whole.row;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        if (rows[i].met && rows[i].seconds < rows[best].seconds)
            best = i;
    const double choice = rows[whole.row].seconds / rows[best].seconds;
    const double all = whole.seconds / rows[best].seconds;
    printf("  %-27s  %-8s %4.0f %%  %-16s  %-16s %8.2f  %6.2f  %6.2f\n", name,
           aur_error_measure_name(goal->measure), 100.0 * goal->error, aur_race_rows[whole.row].name,
           aur_race_rows[best].name, rows[best].seconds, choice, all);
    print_rows(&whole, rows);
    fflush(stdout);
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        sum->prices[i] += log(rows[i].ray_seconds / rows[AUR_RACE_PATH].ray_seconds);
    sum->choice += log(choice);
    sum->whole += log(all);
    sum->worst_choice = fmax(sum->worst_choice, choice);
    sum->worst_whole = fmax(sum->worst_whole, all);
    ++sum->count;
    return true;
}

/* By two measures; `scene` NULL: it was not loaded. */
static void run_loaded(aur_scene *scene, const char *name, const bench_options *options, ratios *sum) {
    bool good = scene != NULL;
    for (int m = 0; m < (options->quick ? 1 : 2) && good; ++m)
        good = run_scene(scene, name, &(target){(aur_error_measure)m, options->quick ? 0.1 : 0.05}, sum);
    if (!good)
        printf("  %-27s  failed\n", name);
    aur_scene_destroy(scene);
}

static bool is_left_out(const bench_options *options, const char *name) {
    return options->only != NULL && strstr(name, options->only) == NULL;
}

static void run_rooms(const bench_options *options, ratios *sum) {
    static bench_room room;
    for (uint64_t seed = FIRST_ROOM; seed < FIRST_ROOM + (options->quick ? QUICK_ROOMS : ROOMS); ++seed) {
        char name[24];
        snprintf(name, sizeof name, "%llu", (unsigned long long)seed);
        if (is_left_out(options, name))
            continue;
        aur_scene *scene = NULL;
        bench_room_make(seed, &room);
        aur_scene_load_memory("room.xml", room.used, room.text, NULL, &scene, NULL);
        run_loaded(scene, name, options, sum);
    }
}

static void run_file(const char *path, const char *name, const bench_options *options, ratios *sum) {
    aur_scene *scene = NULL;
    aur_error error;
    if (aur_scene_load(path, NULL, &scene, &error) != AUR_OK)
        printf("  %s\n", error.message);
    run_loaded(scene, name, options, sum);
}

static bool run(const bench_options *options) {
    ratios sum = {.count = 0};
    printf(
        "  room or scene                measure   error  chosen            best               CPU s  over it "
        "the chosen one and the whole request;\n        below, CPU times relative to the chosen one's, and "
        "in brackets as the race predicted\n");
    if (options->scene != NULL)
        run_file(options->scene, options->scene, options, &sum);
    else
        run_rooms(options, &sum);
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0] && options->scene == NULL && !options->quick;
         ++i) {
        char path[512];
        snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", scenes[i]);
        if (!is_left_out(options, scenes[i]))
            run_file(path, scenes[i], options, &sum);
    }
    if (sum.count == 0)
        return false;
    printf("  geometric mean: choice %.2f, whole %.2f; worst %.2f, %.2f\n",
           exp(sum.choice / (double)sum.count), exp(sum.whole / (double)sum.count), sum.worst_choice,
           sum.worst_whole);
    printf("  time per ray over path tracing's:");
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        printf(" %s %.2f", aur_race_rows[i].name, exp(sum.prices[i] / (double)sum.count));
    printf("\n");
    return true;
}

const bench bench_race = {"adaptive", "the choice of the integrator for a target error, over the best one",
                          run};
