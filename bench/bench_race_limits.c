/* What the race's limits do, in rooms generated from seeds: the work of the candidate that it takes, and that
 * work with the race's, over the least of all candidates by a race over all pixels. */
#include <aureole-render/adaptive.h>
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "render/race/race.h"
#include "room.h"

enum { ROOMS = 12, QUICK_ROOMS = 2, WIDTH = 96, HEIGHT = 72, REPLICAS = 4 };

typedef struct variant {
    const char *name;
    aur_race_limits limits;
} variant;

static const variant variants[] = {
    {"as they are", {9, 0.2, 0.05, 0.95}},      {"first blocks 5", {5, 0.2, 0.05, 0.95}},
    {"first blocks 18", {18, 0.2, 0.05, 0.95}}, {"first part .1", {9, 0.1, 0.05, 0.95}},
    {"first part .4", {9, 0.4, 0.05, 0.95}},    {"part .025", {9, 0.2, 0.025, 0.95}},
    {"part .1", {9, 0.2, 0.1, 0.95}},           {"confidence .8", {9, 0.2, 0.05, 0.8}},
    {"confidence .99", {9, 0.2, 0.05, 0.99}},   {"only the first blocks", {9, 0.2, 0.0, 0.95}},
    {"without a race", {9, 0.0, 0.0, 0.95}},
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

typedef struct regrets {
    double choice, whole, worst_choice, worst_whole; /* sums of logarithms in the first two */
    size_t count;
} regrets;

/* Runs a race with some limits. Entries and order are valid afterwards; false on failure. */
static bool compete(aur_renderer *renderer, const aur_race_limits *limits, double error, uint64_t seed,
                    aur_race *race) {
    static const atomic_bool never;
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.threads = 1;
    options.use_cache = 0;
    options.sampler = "sobol";
    options.seed = seed;
    *race = (aur_race){.renderer = renderer,
                       .options = &options,
                       .path = "path",
                       .width = WIDTH,
                       .height = HEIGHT,
                       .image_replicas = REPLICAS,
                       .replica_count = REPLICAS,
                       .error = error,
                       .cancelled = &never,
                       .limits = limits};
    const bool good = aur_race_run(race, NULL) == AUR_OK && race->order_count > 0;
    aur_race_release(race);
    return good;
}

static double work_of(const aur_race *race) {
    double work = 0.0;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        work += race->entries[i].rays;
    return work;
}

static bool run_room(uint64_t seed, double error, regrets sums[VARIANTS]) {
    static bench_room room;
    static const aur_race_limits all = {SIZE_MAX, INFINITY, 0.0, 2.0}; /* nothing is dropped */
    bench_room_make(seed, &room);
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    bool good = aur_scene_load_memory("room.xml", room.used, room.text, NULL, &scene, NULL) == AUR_OK &&
                aur_renderer_create(scene, &renderer, NULL) == AUR_OK;
    aur_race truth, race;
    good = good && compete(renderer, &all, error, 1000, &truth);
    for (size_t v = 0; v < VARIANTS && good; ++v) {
        good = compete(renderer, &variants[v].limits, error, seed, &race);
        const double least = truth.entries[truth.order[0]].need;
        const double choice = good ? truth.entries[race.order[0]].need / least : 0.0;
        const double whole = choice + work_of(&race) / least;
        sums[v].choice += log(choice);
        sums[v].whole += log(whole);
        sums[v].worst_choice = fmax(sums[v].worst_choice, choice);
        sums[v].worst_whole = fmax(sums[v].worst_whole, whole);
        sums[v].count += good;
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return good;
}

static bool run(const bench_options *options) {
    static const double errors[] = {0.05, 0.02};
    regrets sums[VARIANTS] = {{.count = 0}};
    bool good = true;
    for (uint64_t k = 0; k < (options->quick ? QUICK_ROOMS : ROOMS); ++k)
        for (size_t e = 0; e < (options->quick ? 1 : 2); ++e)
            good = run_room(201 + k, errors[e], sums) && good;
    printf("  %-22s choice: mean, worst   with the race: mean, worst (work over the best candidate's)\n",
           "limits");
    for (size_t v = 0; v < VARIANTS && good; ++v)
        printf("  %-22s %12.2f %6.2f %21.2f %6.2f\n", variants[v].name,
               exp(sums[v].choice / (double)sums[v].count), sums[v].worst_choice,
               exp(sums[v].whole / (double)sums[v].count), sums[v].worst_whole);
    return good;
}

const bench bench_race_limits = {"race-limits", "what the limits of the comparison of integrators do", run};
