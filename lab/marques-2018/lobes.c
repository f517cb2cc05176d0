/* Merged samples of more lobes than Marques 2018 has, and of the levels of one extensible grid: a diffuse
 * lobe with one to three glossy ones, cos^m and GGX, under random lights of known integrals.
 *
 * Settings, fixed before the run: views of 30 degrees; 64 diffuse samples, 32 of the first glossy lobe and 16
 * of each further one; lobes are normalised over the upper hemisphere and count alike. "E-SFG levels" are the
 * first 64, 32 and 16 points of one grid of 16 points with one extension, so a lobe that is to have more
 * samples keeps those that it has. Intervals are over lights. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "samples.h"

enum { MOST_LOBES = 4, MOST = 64 + 32 + 16 + 16, TRUTH = 8192, LIGHTS = 200, SETS = 4, METHODS = 4 };

typedef enum method { PLAIN, MIS, OSW, OSWA } method;

static const char *const method_names[METHODS] = {"p/q", "MIS", "OSW", "OSWA"};

static const double VIEW_DEGREES = 30.0, PI = 3.14159265358979323846;

static const char LEVELS[] = "esfg:base=16,levels=1,first-shift=best";

typedef struct lobe_case {
    const char *name;
    size_t count;
    aur_lobe lobes[MOST_LOBES];
    bool quick;
} lobe_case;

#define COSINE(m_)                                                                                           \
    { .exponent = (m_) }
#define GGX(alpha_)                                                                                          \
    { .kind = AUR_LOBE_GGX, .alpha = (alpha_), .view_degrees = 30.0 }

static const lobe_case cases[] = {
    {"diffuse + m 20", 2, {COSINE(1.0), COSINE(20.0)}, true},
    {"diffuse + m 5 + m 50", 3, {COSINE(1.0), COSINE(5.0), COSINE(50.0)}, false},
    {"diffuse + m 5 + m 50 + m 500", 4, {COSINE(1.0), COSINE(5.0), COSINE(50.0), COSINE(500.0)}, false},
    {"diffuse + GGX .3", 2, {COSINE(1.0), GGX(0.3)}, false},
    {"diffuse + GGX .5 + GGX .15", 3, {COSINE(1.0), GGX(0.5), GGX(0.15)}, true}};

static const char *const columns[] = {"lobes",      "set",      "light",     "method", "rmse",
                                      "over_plain", "over_low", "over_high", NULL};

typedef struct lobes_study {
    lab_run *run;
    const lobe_case *of;
    const char *set;
    size_t counts[MOST_LOBES], all;
    aur_potential *potentials[MOST_LOBES];
    double *truth; /* 4 * TRUTH a lobe: directions, then weights */
} lobes_study;

static bool is_glossy_cosine(const aur_lobe *lobe) {
    return lobe->kind != AUR_LOBE_GGX && lobe->exponent != 1.0;
}

/* The axis of a cosine lobe. */
static void find_axis(const aur_lobe *lobe, double axis[3]) {
    const double radians = is_glossy_cosine(lobe) ? VIEW_DEGREES * PI / 180.0 : 0.0;
    axis[0] = -sin(radians);
    axis[1] = 0.0;
    axis[2] = cos(radians);
}

/* The first `count` of `size` directions of a set for a lobe. The pattern is turned before it takes the shape
 * of a GGX lobe, which has an azimuth. */
static aur_result draw(const char *set, const aur_lobe *lobe, size_t size, size_t count, uint64_t seed,
                       double *xyz, aur_error *error) {
    const bool ggx = lobe->kind == AUR_LOBE_GGX;
    const aur_directions_options options = {.size = sizeof options,
                                            .count = size,
                                            .domain = AUR_DOMAIN_HEMISPHERE,
                                            .lobe = ggx ? (aur_lobe){.exponent = 0.0} : *lobe,
                                            .scramble = lab_scrambling(set),
                                            .seed = seed};
    aur_directions *directions;
    aur_result result = aur_directions_create(set, &options, &directions, error);
    if (result != AUR_OK)
        return result;
    result = aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, NULL);
    aur_directions_destroy(directions);
    if (ggx)
        aur_lobe_warp(lobe, count, xyz, xyz);
    double axis[3];
    find_axis(lobe, axis);
    for (size_t i = 0; i < count && !ggx; ++i) {
        const double x = xyz[3 * i], z = xyz[3 * i + 2];
        xyz[3 * i] = axis[2] * x + axis[0] * z;
        xyz[3 * i + 2] = axis[2] * z - axis[0] * x;
    }
    return result;
}

/* p/q of a direction, p normalised over the upper hemisphere. */
static double ratio(const lobes_study *s, size_t lobe, const double u[3]) {
    const aur_lobe *const of = &s->of->lobes[lobe];
    double density = 0.0;
    if (u[2] <= 0.0)
        return 0.0;
    if (of->kind != AUR_LOBE_GGX) /* the same shape: what is hidden is missing */
        return 2.0 * PI / (of->exponent + 1.0) / aur_potential_mass(s->potentials[lobe]);
    aur_potential_density(s->potentials[lobe], 1, u, &density, NULL);
    return density > 0.0 ? density / aur_lobe_pdf(of, u) : 0.0;
}

/* weights[i]: of all samples for all lobes together, which are added. */
static aur_result weigh(const lobes_study *s, method how, const double *xyz, double *weights,
                        aur_error *error) {
    double own[MOST_LOBES * MOST] = {0.0};
    aur_strategy strategies[MOST_LOBES];
    for (size_t k = 0; k < s->of->count; ++k) {
        strategies[k] = (aur_strategy){.count = s->counts[k], .sampled = s->of->lobes[k]};
        if (s->of->lobes[k].kind != AUR_LOBE_GGX)
            find_axis(&s->of->lobes[k], strategies[k].axis);
    }
    const aur_potential *potentials[MOST_LOBES];
    memcpy(potentials, s->potentials, sizeof potentials);
    aur_result result = AUR_OK;
    if (how == OSWA)
        result = aur_weights_solve(s->all, xyz, s->of->count, potentials, NULL, s->of->count * s->all, own,
                                   NULL, NULL, error);
    for (size_t k = 0, first = 0; k < s->of->count && result == AUR_OK && how != OSWA;
         first += s->counts[k++]) {
        double *const w = own + k * s->all;
        if (how == OSW)
            result = aur_weights_solve(s->counts[k], xyz + 3 * first, 1, &potentials[k], NULL, s->counts[k],
                                       w + first, NULL, NULL, error);
        else if (how == MIS)
            result = aur_mis_weights(AUR_MIS_BALANCE, s->of->count, strategies, potentials[k], s->all, xyz, w,
                                     error);
        else
            for (size_t i = first; i < first + s->counts[k]; ++i)
                w[i] = ratio(s, k, xyz + 3 * i) / (double)s->counts[k];
    }
    for (size_t i = 0; i < s->all; ++i) {
        weights[i] = 0.0;
        for (size_t k = 0; k < s->of->count; ++k)
            weights[i] += own[k * s->all + i];
    }
    return result;
}

static aur_result make_truth(const lobes_study *s, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t k = 0; k < s->of->count && result == AUR_OK; ++k) {
        double *const xyz = s->truth + 4 * TRUTH * k, *const weights = xyz + 3 * TRUTH;
        double sum = 0.0;
        result = draw("spherical-fibonacci", &s->of->lobes[k], TRUTH, TRUTH, 0, xyz, error);
        for (size_t i = 0; i < TRUTH && result == AUR_OK; ++i)
            sum += weights[i] = ratio(s, k, xyz + 3 * i);
        for (size_t i = 0; i < TRUTH; ++i)
            weights[i] /= sum;
    }
    return result;
}

static double integrate(const lobes_study *s, const lab_light *light) {
    double sum = 0.0;
    for (size_t k = 0; k < s->of->count; ++k)
        for (size_t i = 0; i < TRUTH; ++i) {
            const double *const lobe = s->truth + 4 * TRUTH * k;
            sum += lobe[3 * TRUTH + i] * lab_radiance(light, lobe + 3 * i);
        }
    return sum;
}

/* Squares of errors, [light][method][seed]. */
static aur_result measure(const lobes_study *s, size_t lights, double squares[2][METHODS][LIGHTS],
                          aur_error *error) {
    aur_result result = AUR_OK;
    for (uint64_t seed = 0; seed < lights && result == AUR_OK; ++seed) {
        double xyz[3 * MOST], weights[MOST], *next = xyz;
        const bool levels = strcmp(s->set, LEVELS) == 0;
        for (size_t k = 0; k < s->of->count && result == AUR_OK; next += 3 * s->counts[k++])
            result = draw(s->set, &s->of->lobes[k], levels ? 64 : s->counts[k], s->counts[k],
                          MOST_LOBES * seed + k, next, error);
        for (size_t m = 0; m < METHODS && result == AUR_OK; ++m) {
            result = weigh(s, (method)m, xyz, weights, error);
            for (size_t hard = 0; hard < 2; ++hard) {
                const lab_light light = lab_random_light(seed, hard == 1);
                double off = -integrate(s, &light);
                for (size_t i = 0; i < s->all; ++i)
                    off += weights[i] * lab_radiance(&light, xyz + 3 * i);
                squares[hard][m][seed] = off * off;
            }
        }
    }
    return result;
}

static aur_result study_set(lobes_study *s, size_t lights, aur_error *error) {
    static const char *const light_names[] = {"smooth", "hard edges"};
    double squares[2][METHODS][LIGHTS] = {{{0.0}}};
    char key[200];
    enum { CELLS = 2 * METHODS * LIGHTS };
    snprintf(key, sizeof key, "%s, %.120s", s->of->name, s->set);
    if (!lab_recall(s->run, key, CELLS, &squares[0][0][0])) {
        aur_result result = measure(s, lights, squares, error);
        if (result == AUR_OK)
            result = lab_keep(s->run, key, CELLS, &squares[0][0][0], error);
        if (result != AUR_OK)
            return result;
    }
    const char *const set = strcmp(s->set, LEVELS) == 0 ? "E-SFG levels" : s->set;
    for (size_t hard = 0; hard < 2; ++hard) {
        double over[METHODS];
        for (size_t m = 0; m < METHODS; ++m) {
            const lab_interval ratio = lab_root_ratio_paired(lights, squares[hard][m], squares[hard][PLAIN]);
            over[m] = ratio.value;
            lab_row(s->run, (const char *const[]){s->of->name, set, light_names[hard], method_names[m], NULL},
                    4,
                    (const double[]){lab_root_mean(lights, squares[hard][m]).value, ratio.value, ratio.low,
                                     ratio.high});
        }
        lab_note(s->run, "%s, %s, %s: over p/q: MIS %.2f, OSW %.2f, OSWA %.2f", s->of->name, set,
                 light_names[hard], over[MIS], over[OSW], over[OSWA]);
    }
    return AUR_OK;
}

static aur_result open_case(lobes_study *s, aur_error *error) {
    aur_result result = AUR_OK;
    s->all = 0;
    for (size_t k = 0; k < s->of->count && result == AUR_OK; ++k) {
        const aur_lobe *const lobe = &s->of->lobes[k];
        aur_density density = {.size = sizeof density,
                               .kind =
                                   lobe->kind == AUR_LOBE_GGX ? AUR_DENSITY_GGX : AUR_DENSITY_COSINE_POWER,
                               .exponent = lobe->exponent,
                               .clipped = is_glossy_cosine(lobe),
                               .alpha = lobe->alpha,
                               .view_degrees = lobe->view_degrees};
        if (lobe->kind != AUR_LOBE_GGX)
            find_axis(lobe, density.axis);
        s->counts[k] = k == 0 ? 64 : k == 1 ? 32 : 16;
        s->all += s->counts[k];
        result = aur_potential_create(&density, 1.5, &s->potentials[k], error);
    }
    return result == AUR_OK ? make_truth(s, error) : result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const char *const sets[SETS] = {"spherical-fibonacci", LEVELS, options->quick ? NULL : "sobol",
                                    options->set};
    lobes_study s = {.run = run, .truth = malloc(4 * TRUTH * MOST_LOBES * sizeof *s.truth)};
    if (s.truth == NULL)
        return AUR_ERROR_MEMORY;
    aur_result result = AUR_OK;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0] && result == AUR_OK; ++c) {
        s.of = &cases[c];
        if (options->quick && !s.of->quick)
            continue;
        result = open_case(&s, error);
        for (size_t i = 0; i < SETS && result == AUR_OK; ++i) {
            s.set = sets[i];
            if (s.set != NULL)
                result = lab_forgive(run, s.set, study_set(&s, options->quick ? 10 : LIGHTS, error), error);
        }
        for (size_t k = 0; k < MOST_LOBES; ++k) {
            aur_potential_destroy(s.potentials[k]);
            s.potentials[k] = NULL;
        }
    }
    free(s.truth);
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
