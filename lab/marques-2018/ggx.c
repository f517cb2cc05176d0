/* GGX lobes: gains by optimal weights on visible-normal samples, from a system or from a table over angle and
 * roughness, alone and merged with a diffuse lobe's samples, under random lights with a known integral. The
 * pattern is rotated for each light. No light comes from below the surface. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "samples.h"

enum { DIFFUSE = 64, GLOSSY = 32, ALL = DIFFUSE + GLOSSY, REFERENCE = 8192, TURNS = 16 };

typedef enum rule {
    SHIFTED,  /* heights shifted modulo 1, weights p/q: the renderer's method */
    RATIO,    /* p/q */
    HELD,     /* p/q, scaled so that the sum is the lobe's mass */
    OPTIMAL,  /* solved system */
    TABLE,    /* from a table over angle and roughness */
    SEPARATE, /* two lobes: cos with equal weights, GGX with p/q */
    BALANCE,  /* two lobes: multiple importance sampling */
    SEPARATELY_OPTIMAL,
    MERGED, /* two lobes: all samples for both */
    RULES
} rule;

static const char *const names[RULES] = {
    "shifted ratio", "ratio",         "ratio held",         "optimal",     "table",
    "both: ratio",   "both: balance", "both: optimal each", "both: merged"};

static const char *const columns[] = {"set",  "light",    "alpha",      "degrees", "rule",
                                      "rmse", "relative", "worst_case", NULL};

/* Samples and their weights, including the masses of lobes. */
typedef struct samples {
    size_t count;
    double xyz[3 * ALL], weights[ALL];
} samples;

typedef struct study {
    lab_run *run;
    const char *set;
    aur_lobe lobe;
    double radians, mass;
    aur_weight_table *table;
    aur_oswa *pair;           /* a cosine lobe and this one */
    aur_potential *potential; /* of the lobe */
    aur_potential *cosine;
    double *reference; /* 6 * REFERENCE directions, and REFERENCE masses of the GGX lobe's directions */
} study;

static uint64_t light_count(const study *s) {
    return lab_run_options(s->run)->quick ? 16 : 160;
}

/* Rotations over which worst-case errors are averaged. */
static uint64_t turn_count(const study *s) {
    return lab_run_options(s->run)->quick ? 4 : TURNS;
}

static aur_oswa_options patterns(const study *s, size_t diffuse) {
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = s->set,
                              .count = diffuse,
                              .mirror_count = GLOSSY,
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = s->lobe,
                              .scramble = lab_scrambling(s->set)};
}

/* p/q of samples distributed by the lobe. */
static double ratio(const study *s, const double direction[3]) {
    double density = 0.0;
    if (direction[2] > 0.0)
        aur_potential_density(s->potential, 1, direction, &density, NULL);
    return density > 0.0 ? s->mass * density / aur_lobe_pdf(&s->lobe, direction) : 0.0;
}

/* Heights of the uniform pattern, shifted modulo 1. */
static void shift(const study *s, double by, samples *r) {
    for (size_t i = 0; i < r->count; ++i) {
        double *const u = r->xyz + 3 * i, uniform[3];
        aur_lobe_unwarp(&s->lobe, 1, u, uniform);
        const double across = hypot(uniform[0], uniform[1]), moved = uniform[2] + by;
        uniform[2] = moved - floor(moved);
        const double scale = across > 0.0 ? sqrt(1.0 - uniform[2] * uniform[2]) / across : 0.0;
        uniform[0] *= scale;
        uniform[1] *= scale;
        aur_lobe_warp(&s->lobe, 1, uniform, u);
    }
}

static aur_result one_lobe(const study *s, rule which, uint64_t seed, samples *r, aur_error *error) {
    const size_t rotation = seed % TURNS;
    const double alpha = s->lobe.alpha;
    float found[GLOSSY];
    double turns[2], sum = 0.0;
    r->count = GLOSSY;
    aur_result result =
        aur_weight_table_points(s->table, s->radians, alpha, rotation, false, 3 * GLOSSY, r->xyz, error);
    if (result != AUR_OK)
        return result;
    if (which == OPTIMAL) {
        const aur_potential *const potential = s->potential;
        result =
            aur_weights_solve(GLOSSY, r->xyz, 1, &potential, NULL, GLOSSY, r->weights, NULL, NULL, error);
    } else if (which == TABLE) {
        result = aur_weight_table_look_up(s->table, 1, rotation, s->radians, alpha, GLOSSY, found, error);
    } else if (which == SHIFTED) {
        aur_oswa_turns(seed, 77, turns);
        shift(s, turns[0], r);
    }
    for (size_t i = 0; i < GLOSSY; ++i) {
        if (which == TABLE)
            r->weights[i] = (double)found[i];
        else if (which != OPTIMAL)
            r->weights[i] = ratio(s, r->xyz + 3 * i) / GLOSSY;
        sum += r->weights[i];
    }
    const double scale = which == OPTIMAL || which == TABLE ? s->mass : which == HELD ? s->mass / sum : 1.0;
    for (size_t i = 0; i < GLOSSY; ++i)
        r->weights[i] *= scale;
    return result;
}

static aur_result two_lobes(const study *s, rule which, uint64_t seed, samples *r, aur_error *error) {
    double turns[2], found[2 * ALL] = {0};
    const aur_strategy strategies[2] = {{.count = DIFFUSE, .sampled = {.exponent = 1.0}},
                                        {.count = GLOSSY, .sampled = s->lobe}};
    const aur_potential *const potentials[2] = {s->cosine, s->potential};
    const size_t first[2] = {0, DIFFUSE}, count[2] = {DIFFUSE, GLOSSY};
    aur_oswa_turns(0, seed % TURNS, turns);
    r->count = ALL;
    aur_result result = aur_oswa_points(s->pair, s->radians, turns, false, 3 * ALL, r->xyz, error);
    if (result == AUR_OK && which == MERGED)
        result = aur_oswa_solve(s->pair, s->radians, turns, 2 * ALL, found, NULL, error);
    for (size_t k = 0; k < 2 && result == AUR_OK && which != MERGED; ++k) {
        double *const lobe_weights = found + k * ALL;
        if (which == BALANCE)
            result = aur_mis_weights(AUR_MIS_BALANCE, 2, strategies, potentials[k], ALL, r->xyz, lobe_weights,
                                     error);
        else if (which == SEPARATELY_OPTIMAL)
            result = aur_weights_solve(count[k], r->xyz + 3 * first[k], 1, &potentials[k], NULL, count[k],
                                       lobe_weights + first[k], NULL, NULL, error);
        else
            for (size_t i = first[k]; i < first[k] + count[k]; ++i)
                lobe_weights[i] = k == 0 ? 1.0 / DIFFUSE : ratio(s, r->xyz + 3 * i) / (s->mass * GLOSSY);
    }
    /* The cosine lobe's mass is taken as 1, that is, its surface reflects all light. */
    for (size_t i = 0; i < ALL; ++i)
        r->weights[i] = found[i] + s->mass * found[ALL + i];
    return result;
}

/* The integrals of the GGX lobe, and of both lobes. */
static void exact(const study *s, const lab_light *light, double expected[2]) {
    const double *const masses = s->reference + 6 * REFERENCE;
    double glossy = 0.0, diffuse = 0.0;
    for (size_t i = 0; i < REFERENCE; ++i) {
        glossy += masses[i] * lab_radiance(light, s->reference + 3 * i);
        diffuse += lab_radiance(light, s->reference + 3 * (REFERENCE + i)) / REFERENCE;
    }
    expected[0] = glossy;
    expected[1] = glossy + diffuse;
}

/* One rule under one light of either kind: accumulates its squared error and its worst-case error. */
static aur_result try_rule(const study *s, rule which, uint64_t seed, const lab_light lights[2],
                           double expected[2][2], double squares[2][RULES], double *worst, aur_error *error) {
    samples r;
    const bool two = which >= SEPARATE;
    const aur_result result =
        two ? two_lobes(s, which, seed, &r, error) : one_lobe(s, which, seed, &r, error);
    for (int hard = 0; hard < 2 && result == AUR_OK; ++hard) {
        double found = 0.0;
        for (size_t i = 0; i < r.count; ++i)
            found += r.weights[i] * lab_radiance(&lights[hard], r.xyz + 3 * i);
        squares[hard][which] += pow(found - expected[hard][two], 2);
    }
    if (result != AUR_OK || two || seed >= turn_count(s))
        return result;
    double value = 0.0;
    for (size_t i = 0; i < GLOSSY; ++i)
        r.weights[i] /= s->mass;
    const aur_result judged =
        aur_worst_case_error(GLOSSY, r.xyz, r.weights, s->potential, NULL, &value, error);
    worst[which] += value / (double)turn_count(s);
    return judged;
}

static aur_result try_rules(study *s, double squares[2][RULES], double *worst, aur_error *error) {
    const uint64_t count = light_count(s);
    aur_result result = AUR_OK;
    for (uint64_t seed = 0; seed < count && result == AUR_OK; ++seed) {
        const lab_light lights[2] = {lab_random_light(seed, false), lab_random_light(seed, true)};
        double expected[2][2];
        for (int hard = 0; hard < 2; ++hard)
            exact(s, &lights[hard], expected[hard]);
        for (int m = 0; m < RULES && result == AUR_OK; ++m)
            result = try_rule(s, (rule)m, seed, lights, expected, squares, worst, error);
    }
    return result;
}

static aur_result compare(study *s, double alpha, double degrees, aur_error *error) {
    double squares[2][RULES] = {{0}}, worst[RULES] = {0};
    const double lights = (double)light_count(s);
    s->lobe = (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = alpha, .view_degrees = degrees};
    s->radians = degrees * 3.14159265358979323846 / 180.0;
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    const aur_oswa_options two = patterns(s, DIFFUSE);
    aur_result result = aur_density_from_lobe(&s->lobe, AUR_DOMAIN_HEMISPHERE, &density, error);
    if (result == AUR_OK)
        result = aur_potential_create(&density, 1.5, &s->potential, error);
    if (result == AUR_OK)
        result = aur_oswa_create(&two, &s->pair, error);
    if (result == AUR_OK) {
        s->mass = aur_potential_mass(s->potential);
        result =
            lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, 0.0, 0, 0}, s->reference, NULL, error);
    }
    if (result == AUR_OK)
        aur_lobe_warp(&s->lobe, REFERENCE, s->reference, s->reference);
    for (size_t i = 0; i < REFERENCE && result == AUR_OK; ++i)
        s->reference[6 * REFERENCE + i] = ratio(s, s->reference + 3 * i) / REFERENCE;
    if (result == AUR_OK)
        result = try_rules(s, squares, worst, error);
    for (int hard = 0; hard < 2 && result == AUR_OK; ++hard)
        for (int m = 0; m < RULES; ++m) {
            lab_text(s->run, s->set);
            lab_text(s->run, hard ? "hard edges" : "smooth");
            lab_number(s->run, alpha);
            lab_number(s->run, degrees);
            lab_text(s->run, names[m]);
            lab_number(s->run, sqrt(squares[hard][m] / lights));
            lab_number(s->run, sqrt(squares[hard][m] / squares[hard][m < SEPARATE ? SHIFTED : SEPARATE]));
            lab_number(s->run, m < SEPARATE ? worst[m] : (double)NAN);
        }
    if (result == AUR_OK)
        lab_note(
            s->run,
            "%s, alpha %g, %g degrees: smooth light, error over shifted ratio weights: ratio %.2f, sum "
            "held %.2f, optimal %.2f, table %.2f; merged over separate %.2f; worst case of the table "
            "%.2f %% above the system's",
            s->set, alpha, degrees, sqrt(squares[0][RATIO] / squares[0][SHIFTED]),
            sqrt(squares[0][HELD] / squares[0][SHIFTED]), sqrt(squares[0][OPTIMAL] / squares[0][SHIFTED]),
            sqrt(squares[0][TABLE] / squares[0][SHIFTED]), sqrt(squares[0][MERGED] / squares[0][SEPARATE]),
            100.0 * (worst[TABLE] / worst[OPTIMAL] - 1.0));
    aur_oswa_destroy(s->pair);
    aur_potential_destroy(s->potential);
    s->pair = NULL;
    s->potential = NULL;
    return result;
}

static aur_result study_set(study *s, aur_error *error) {
    static const double alphas[] = {0.1, 0.3, 0.6}, degrees[] = {0.0, 60.0, 80.0};
    const lab_options *const options = lab_run_options(s->run);
    s->lobe = (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = 0.05};
    const aur_oswa_options alone = patterns(s, 0);
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = options->quick ? 12 : 48,
                                        .roughness_count = options->quick ? 4 : 24,
                                        .rotation_count = TURNS};
    aur_result result =
        aur_weight_table_build(&alone, &grid, options->threads, &options->progress, &s->table, error);
    for (size_t a = 0; a < (options->quick ? 1 : 3); ++a)
        for (size_t d = 0; d < (options->quick ? 2 : 3) && result == AUR_OK; ++d)
            result = compare(s, alphas[a], degrees[d], error);
    aur_weight_table_destroy(s->table);
    s->table = NULL;
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    study s = {.run = run, .reference = malloc(7 * REFERENCE * sizeof *s.reference)};
    if (s.reference == NULL)
        return AUR_ERROR_MEMORY;
    aur_result result = lab_lobe_potential(1.0, 1.5, &s.cosine, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, 1.0, 0, 0},
                          s.reference + 3 * REFERENCE, NULL, error);
    const char *const sets[] = {"spherical-fibonacci", options->quick ? NULL : "sobol",
                                options->quick ? NULL : "random", options->set};
    for (size_t i = 0; i < 4 && result == AUR_OK; ++i) {
        s.set = sets[i];
        if (s.set != NULL)
            result = lab_forgive(run, s.set, study_set(&s, error), error);
    }
    aur_potential_destroy(s.cosine);
    free(s.reference);
    return result;
}

const lab_experiment lab_marques_2018_ggx = {
    .name = "marques-2018-ggx",
    .reproduces = "Marques 2018, for GGX lobes",
    .summary =
        "weights of visible-normal samples: p/q, optimal, from tables over angle and roughness, merged",
    .columns = columns,
    .seconds = 38,
    .quick_seconds = 0.6,
    .run = run,
};
