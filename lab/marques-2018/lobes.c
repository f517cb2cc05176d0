/* Merged samples of more lobes than in Marques 2018, and of the levels of one extensible grid: a diffuse lobe
 * with one to three glossy ones, cos^m and GGX, under random lights with known integrals.
 *
 * Settings, fixed before the run: views of 30 degrees, and lobe_weights.h. "E-SFG levels" are the first 64,
 * 32 and 16 points of one grid of 16 points with one extension, so samples can be added to a lobe without
 * discarding any. Intervals are over lights. */
#include <stdio.h>
#include <string.h>

#include "lobe_weights.h"

enum { LIGHTS = 200, SETS = 4 };

static const char LEVELS[] = "esfg:base=16,levels=1,first-shift=best";

typedef struct lobe_case {
    const char *name;
    lab_lobes lobes;
    bool quick;
} lobe_case;

static const lobe_case cases[] = {
    {"diffuse + m 20",
     {.count = 2, .lobes = {LAB_COSINE(1.0), LAB_COSINE(20.0)}, .view_degrees = 30.0},
     true},
    {"diffuse + m 5 + m 50",
     {.count = 3, .lobes = {LAB_COSINE(1.0), LAB_COSINE(5.0), LAB_COSINE(50.0)}, .view_degrees = 30.0},
     false},
    {"diffuse + m 5 + m 50 + m 500",
     {.count = 4,
      .lobes = {LAB_COSINE(1.0), LAB_COSINE(5.0), LAB_COSINE(50.0), LAB_COSINE(500.0)},
      .view_degrees = 30.0},
     false},
    {"diffuse + GGX .3", {.count = 2, .lobes = {LAB_COSINE(1.0), LAB_GGX(0.3)}, .view_degrees = 30.0}, false},
    {"diffuse + GGX .5 + GGX .15",
     {.count = 3, .lobes = {LAB_COSINE(1.0), LAB_GGX(0.5), LAB_GGX(0.15)}, .view_degrees = 30.0},
     true}};

static const char *const columns[] = {"lobes",      "set",      "light",     "method", "rmse",
                                      "over_plain", "over_low", "over_high", NULL};

typedef struct lobes_study {
    lab_run *run;
    const char *name, *set;
    lab_lobes lobes;
} lobes_study;

/* Squared errors, [light][method][seed]. */
static aur_result measure(const lobes_study *s, size_t lights, double squares[2][LAB_LOBE_METHODS][LIGHTS],
                          aur_error *error) {
    aur_result result = AUR_OK;
    for (uint64_t seed = 0; seed < lights && result == AUR_OK; ++seed) {
        double xyz[3 * LAB_MOST_SAMPLES], weights[LAB_MOST_SAMPLES];
        result = lab_lobes_draw(&s->lobes, s->set, strcmp(s->set, LEVELS) == 0 ? 64 : 0, seed, xyz, error);
        for (size_t m = 0; m < LAB_LOBE_METHODS && result == AUR_OK; ++m) {
            result = lab_lobes_weigh(&s->lobes, (lab_lobe_method)m, xyz, weights, error);
            for (size_t hard = 0; hard < 2; ++hard) {
                const lab_light light = lab_random_light(seed, hard == 1);
                double off = -lab_lobes_integrate(&s->lobes, &light);
                for (size_t i = 0; i < s->lobes.all; ++i)
                    off += weights[i] * lab_radiance(&light, xyz + 3 * i);
                squares[hard][m][seed] = off * off;
            }
        }
    }
    return result;
}

static aur_result study_set(lobes_study *s, size_t lights, aur_error *error) {
    double squares[2][LAB_LOBE_METHODS][LIGHTS] = {{{0.0}}};
    char key[200];
    enum { CELLS = 2 * LAB_LOBE_METHODS * LIGHTS };
    snprintf(key, sizeof key, "%s, %.120s", s->name, s->set);
    if (!lab_recall(s->run, key, CELLS, &squares[0][0][0])) {
        aur_result result = measure(s, lights, squares, error);
        if (result == AUR_OK)
            result = lab_save(s->run, key, CELLS, &squares[0][0][0], error);
        if (result != AUR_OK)
            return result;
    }
    const char *const set = strcmp(s->set, LEVELS) == 0 ? "E-SFG levels" : s->set;
    for (size_t hard = 0; hard < 2; ++hard)
        lab_lobes_rows(s->run, s->name, set, hard == 1, lights, LIGHTS, squares[hard][0]);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const char *const sets[SETS] = {"spherical-fibonacci", LEVELS, options->quick ? NULL : "sobol",
                                    options->set};
    aur_result result = AUR_OK;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0] && result == AUR_OK; ++c) {
        lobes_study s = {.run = run, .name = cases[c].name, .lobes = cases[c].lobes};
        if (options->quick && !cases[c].quick)
            continue;
        result = lab_lobes_open(&s.lobes, error);
        for (size_t i = 0; i < SETS && result == AUR_OK; ++i) {
            s.set = sets[i];
            if (s.set != NULL)
                result = lab_forgive(run, s.set, study_set(&s, options->quick ? 10 : LIGHTS, error), error);
        }
        lab_lobes_close(&s.lobes);
    }
    return result;
}

const lab_experiment lab_marques_2018_lobes = {
    .name = "marques-2018-lobes",
    .reproduces = "none: more lobes than Marques 2018 merges, and levels of E-SFG",
    .summary =
        "merged weights of two to four lobes, cos^m and GGX, and of levels of one grid, under random lights",
    .columns = columns,
    .seconds = 9,
    .quick_seconds = 0.1,
    .run = run,
};
