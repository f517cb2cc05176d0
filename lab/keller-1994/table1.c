/* Table 1 of Keller 1994: the number of paths until adaptive termination. */
#include <math.h>
#include <stdio.h>

#include "study.h"

enum { EPSILONS = 3 };

static const double epsilons[EPSILONS] = {1e-3, 3.3e-4, 1e-4};

/* [epsilon][set][scene: cube, living room, office, teapot] */
static const double published[EPSILONS][KELLER_PUBLISHED_SETS][KELLER_SCENES] = {
    {{42e3, 36e3, 48e3, 31e3},
     {35e3, 37e3, 37e3, 36e3},
     {33e3, 36e3, 28e3, 29e3},
     {32e3, 29e3, 30e3, 30e3},
     {30e3, 35e3, 30e3, 24e3}},
    {{100e3, 99e3, 149e3, 102e3},
     {101e3, 115e3, 126e3, 106e3},
     {92e3, 100e3, 72e3, 85e3},
     {99e3, 95e3, 72e3, 77e3},
     {95e3, 87e3, 78e3, 77e3}},
    {{330e3, 343e3, 439e3, 334e3},
     {337e3, 314e3, 397e3, 316e3},
     {266e3, 305e3, 235e3, 238e3},
     {276e3, 283e3, 276e3, 219e3},
     {310e3, 298e3, 253e3, 228e3}},
};

static const char *const columns[] = {"scene", "epsilon", "sequence",  "paths",
                                      "low",   "high",    "published", NULL};

typedef struct counts {
    size_t variants;
    double paths[EPSILONS][KELLER_VARIANTS];
} counts;

static aur_result measure(lab_run *run, size_t s, const aur_scene *scene, const char *set,
                          size_t epsilon_count, counts *found, aur_error *error) {
    const bool analytic = s == 0;
    const size_t count = sizeof found->paths / sizeof(double);
    char key[160];
    aur_result result = AUR_OK;
    snprintf(key, sizeof key, "%s %.100s", keller_scene_at(s)->name, set);
    if (lab_recall(run, key, count, found->paths[0]))
        return AUR_OK;
    for (size_t v = 0; v < found->variants && result == AUR_OK; ++v) {
        aur_radiosity *radiosity = NULL;
        result = keller_start(run, scene, set, v, analytic ? 29 : 6, AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity,
                              error);
        /* The window of a smaller epsilon closes later, so one pass finds all. */
        for (size_t e = 0; e < epsilon_count && result == AUR_OK; ++e) {
            const aur_radiosity_termination rule = {.size = sizeof rule,
                                                    .epsilon = epsilons[e],
                                                    .interval = 1000,
                                                    .window = 2,
                                                    .limit = UINT64_C(4000000)};
            aur_radiosity_description d = {.size = sizeof d};
            result = aur_radiosity_terminate(radiosity, &rule, NULL, error);
            aur_radiosity_get_description(radiosity, &d, NULL);
            found->paths[e][v] = (double)d.paths;
        }
        aur_radiosity_destroy(radiosity);
    }
    return result != AUR_OK ? result : lab_save(run, key, count, found->paths[0], error);
}

static void add_rows(lab_run *run, size_t scene, size_t set, const char *name, size_t epsilon_count,
                     const counts *found) {
    for (size_t e = 0; e < epsilon_count; ++e) {
        double mean, half;
        lab_mean_interval(found->variants, found->paths[e], &mean, &half);
        lab_text(run, keller_scene_at(scene)->name);
        lab_number(run, epsilons[e]);
        lab_text(run, name);
        lab_number(run, mean);
        lab_number(run, mean - half);
        lab_number(run, mean + half);
        keller_published(run, set < KELLER_PUBLISHED_SETS ? published[e][set][scene] : NAN);
    }
}

static aur_result run_table(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const size_t epsilon_count = options->quick ? 1 : EPSILONS;
    aur_result result = AUR_OK;
    for (size_t s = 0; s < KELLER_SCENES && result == AUR_OK; ++s) {
        if (options->quick && s != 0 && s != 2)
            continue;
        aur_scene *scene = NULL;
        result = lab_load_scene(run, keller_scene_at(s)->realistic, 0, NULL, &scene, error);
        keller_set set;
        for (size_t k = 0; result == AUR_OK && keller_set_at(run, k, &set); ++k) {
            if (!set.extensible || (options->quick && k != 0 && k != 2 && k != 4 && k < KELLER_SETS))
                continue;
            counts found = {.variants = options->quick ? 3 : KELLER_VARIANTS};
            const aur_result measured = measure(run, s, scene, set.name, epsilon_count, &found, error);
            if (measured == AUR_OK)
                add_rows(run, s, k, set.name, epsilon_count, &found);
            result = lab_forgive(run, set.name, measured, error);
        }
        aur_scene_destroy(scene);
    }
    lab_note(
        run,
        "paths: mean and 95 %% interval over variants (order of the lights, turns of the frames, seeds of "
        "random sets); interval 1000, window 2, uniform angles; 29 bounces in the cube, 6 elsewhere");
    lab_note(run,
             "epsilon bounds the change of the last intervals, not the error: random points pass it too");
    return result;
}

static const report_plot plots[] = {
    {.name = "paths",
     .title = "Paths that adaptive termination takes",
     .x = "epsilon",
     .y = "paths",
     .low = "low",
     .high = "high",
     .series = "sequence",
     .panel = "scene",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_table1 = {
    .name = "keller-1994-table1",
    .reproduces = "Keller 1994, table 1",
    .summary = "paths that adaptive termination takes",
    .columns = columns,
    .measured = "paths",
    .low = "low",
    .high = "high",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .seconds = 190,
    .quick_seconds = 1,
    .run = run_table,
    .takes_no_scene = "its rows are Keller's scenes",
};
