/* Aureole's extensions of the weights of Marques 2018, one number per row: cost and benefit of the constraint
 * on the sum, of the optimal density, of lobes clipped at the horizon, and the loss by interpolation in
 * tables. Worst-case errors at s = 1.5, root mean squares over seeds. */
#include <math.h>
#include <stdio.h>

#include "samples.h"

enum { COUNT = 64, DIFFUSE = 64, GLOSSY = 32, ALL = DIFFUSE + GLOSSY };

static const char *const columns[] = {
    "extension", "set", "case", "exponent", "error", "over_baseline_percent", NULL};

static const aur_weights_options unconstrained = {.size = sizeof unconstrained,
                                                  .regularization = AUR_REGULARIZATION_DEFAULT};

static const double radian = 3.14159265358979323846 / 180.0;

typedef struct beyond_study {
    lab_run *run;
    const char *set;
    size_t seeds;
} beyond_study;

static void add_row(const beyond_study *s, const char *extension, double exponent, const char *what,
                    double value, double baseline) {
    lab_row(s->run, (const char *const[]){extension, s->set, what, NULL}, 3,
            (const double[]){exponent, value, 100.0 * (value / baseline - 1.0)});
}

/* --- the sum, and the density */

typedef enum case_of_lobe { EQUAL, FREE, SUMMED, DENSE_RATIO, DENSE_SUMMED, CASES } case_of_lobe;

static aur_result one_seed(const beyond_study *s, double exponent, uint64_t seed, const aur_potential *lobe,
                           double squares[CASES], double *off, aur_error *error) {
    double xyz[3 * COUNT], weights[COUNT], value = 0.0;
    aur_weights_report free_sum = {0}, summed = {0}, dense = {0};
    aur_result result = lab_draw(&(lab_samples){s->set, COUNT, exponent, false, seed}, xyz, NULL, error);
    if (result == AUR_OK)
        result =
            aur_weights_solve(COUNT, xyz, 1, &lobe, &unconstrained, COUNT, weights, &free_sum, NULL, error);
    if (result == AUR_OK)
        result = aur_weights_solve(COUNT, xyz, 1, &lobe, NULL, COUNT, weights, &summed, NULL, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){s->set, COUNT, exponent, true, seed}, xyz, weights, error);
    if (result == AUR_OK)
        result = aur_worst_case_error(COUNT, xyz, weights, lobe, NULL, &value, error);
    if (result == AUR_OK)
        result = aur_weights_solve(COUNT, xyz, 1, &lobe, NULL, COUNT, weights, &dense, NULL, error);
    const double errors[CASES] = {summed.equal_error, free_sum.optimal_error, summed.optimal_error, value,
                                  dense.optimal_error};
    for (size_t i = 0; i < CASES; ++i)
        squares[i] += errors[i] * errors[i] / (double)s->seeds;
    *off += 100.0 * (free_sum.weight_sum - 1.0) / (double)s->seeds;
    return result;
}

static aur_result study_lobe(const beyond_study *s, double exponent, aur_error *error) {
    static const char *const names[CASES] = {"equal weights", "optimal weights of free sum",
                                             "optimal weights of sum 1", "optimal density and p/q",
                                             "optimal density and weights of sum 1"};
    double squares[CASES] = {0}, off = 0.0;
    aur_potential *lobe = NULL;
    aur_result result = lab_lobe_potential(exponent, 1.5, &lobe, error);
    for (uint64_t seed = 0; seed < s->seeds && result == AUR_OK; ++seed)
        result = one_seed(s, exponent, seed, lobe, squares, &off, error);
    aur_potential_destroy(lobe);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < CASES; ++i)
        add_row(s, i < DENSE_RATIO ? "sum constraint" : "optimal density", exponent, names[i],
                sqrt(squares[i]), sqrt(squares[EQUAL]));
    lab_note(s->run,
             "%s, m = %g: without the constraint constants are %+.3f %% off; it costs %.3f %% of the error",
             s->set, exponent, off, 100.0 * (sqrt(squares[SUMMED] / squares[FREE]) - 1.0));
    return AUR_OK;
}

/* --- the horizon */

static aur_oswa_options merged(const beyond_study *s, bool clipped, uint64_t seed) {
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = s->set,
                              .count = DIFFUSE,
                              .mirror_count = GLOSSY,
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = {.exponent = 20.0},
                              .clipped = clipped,
                              .scramble = lab_scrambling(s->set),
                              .seed = seed};
}

/* The glossy lobe's error, evaluated for the part above the horizon, from where all light comes. */
static aur_result horizon_error(const beyond_study *s, bool clipped, double degrees, uint64_t seed,
                                const aur_potential *lobe, double *square, double *constant,
                                aur_error *error) {
    const aur_oswa_options options = merged(s, clipped, seed);
    const double radians = degrees * radian, mass = aur_potential_mass(lobe);
    const double whole = 2.0 * 3.14159265358979323846 / 21.0;
    double turns[2], xyz[3 * ALL], weights[2 * ALL], value = 0.0;
    aur_oswa *oswa = NULL;
    aur_oswa_turns(seed, 0, turns);
    aur_result result = aur_oswa_create(&options, &oswa, error);
    if (result == AUR_OK)
        result = aur_oswa_points(oswa, radians, turns, false, 3 * ALL, xyz, error);
    if (result == AUR_OK)
        result = aur_oswa_solve(oswa, radians, turns, 2 * ALL, weights, NULL, error);
    aur_oswa_destroy(oswa);
    double *const glossy = weights + ALL;
    double sum = 0.0;
    for (size_t i = 0; i < ALL && result == AUR_OK; ++i) {
        glossy[i] *= xyz[3 * i + 2] < 0.0 ? 0.0 : clipped ? 1.0 : whole / mass;
        sum += glossy[i];
    }
    if (result == AUR_OK)
        result = aur_worst_case_error(ALL, xyz, glossy, lobe, NULL, &value, error);
    *square += value * value / (double)s->seeds;
    *constant += (sum - 1.0) * (sum - 1.0) / (double)s->seeds;
    return result;
}

static aur_result study_horizon(const beyond_study *s, aur_error *error) {
    static const double angles[] = {45.0, 60.0, 75.0};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 3 && result == AUR_OK; ++k) {
        const double a = angles[k] * radian;
        const aur_density density = {.size = sizeof density,
                                     .kind = AUR_DENSITY_COSINE_POWER,
                                     .axis = {-sin(a), 0.0, cos(a)},
                                     .exponent = 20.0,
                                     .clipped = true};
        aur_potential *lobe = NULL;
        double squares[2] = {0}, constants[2] = {0};
        result = aur_potential_create(&density, 1.5, &lobe, error);
        for (uint64_t seed = 0; seed < s->seeds; ++seed)
            for (size_t c = 0; c < 2 && result == AUR_OK; ++c)
                result = horizon_error(s, c == 1, angles[k], seed, lobe, &squares[c], &constants[c], error);
        aur_potential_destroy(lobe);
        for (size_t c = 0; c < 2 && result == AUR_OK; ++c) {
            char what[64];
            snprintf(what, sizeof what, "%g degrees: %s", angles[k], c == 0 ? "whole lobe" : "clipped");
            add_row(s, "horizon", 20.0, what, sqrt(squares[c]), sqrt(squares[0]));
        }
        if (result == AUR_OK)
            lab_note(
                s->run,
                "%s, m = 20 at %g degrees: constant light above the horizon is %.3f %% off (rms) with whole "
                "lobes, %.3f %% clipped",
                s->set, angles[k], 100.0 * sqrt(constants[0]), 100.0 * sqrt(constants[1]));
    }
    return result;
}

/* --- tables */

enum { PLAIN, SOLVED, LOOKED_UP, WAYS };

typedef struct table_study {
    double exponent;
    bool clipped;
    aur_weight_table *table;
    aur_oswa *oswa;
} table_study;

/* The worst-case errors of the glossy lobe at one angle: its own samples with equal weights, and all samples
 * with the weights of a solve and of the table. */
static aur_result one_angle(const table_study *t, double radians, size_t rotation, double errors[WAYS],
                            aur_error *error) {
    double turns[2], xyz[3 * ALL], solved[2 * ALL], weights[ALL];
    float looked_up[ALL];
    aur_potential *lobe = NULL;
    const aur_density density = {.size = sizeof density,
                                 .kind = AUR_DENSITY_COSINE_POWER,
                                 .axis = {-sin(radians), 0.0, cos(radians)},
                                 .exponent = t->exponent,
                                 .clipped = t->clipped};
    aur_oswa_turns(0, rotation, turns);
    aur_result result = aur_potential_create(&density, 1.5, &lobe, error);
    if (result == AUR_OK)
        result = aur_oswa_points(t->oswa, radians, turns, false, 3 * ALL, xyz, error);
    if (result == AUR_OK)
        result = aur_oswa_solve(t->oswa, radians, turns, 2 * ALL, solved, NULL, error);
    if (result == AUR_OK)
        result = aur_weight_table_look_up(t->table, 1, rotation, radians, 0.0, ALL, looked_up, error);
    size_t visible = 0;
    for (size_t i = DIFFUSE; i < ALL && result == AUR_OK; ++i)
        visible += !t->clipped || xyz[3 * i + 2] >= 0.0;
    for (size_t way = 0; way < WAYS && result == AUR_OK; ++way) {
        for (size_t i = 0; i < ALL; ++i) {
            const bool counts = i >= DIFFUSE && (!t->clipped || xyz[3 * i + 2] >= 0.0);
            const double plain = counts ? 1.0 / (double)visible : 0.0;
            weights[i] = way == PLAIN ? plain : way == SOLVED ? solved[ALL + i] : (double)looked_up[i];
        }
        result = aur_worst_case_error(ALL, xyz, weights, lobe, NULL, &errors[way], error);
    }
    aur_potential_destroy(lobe);
    return result;
}

/* The fraction of a solve's gain that interpolation loses, over views from 0 to 80 degrees. */
static aur_result table_loss(const beyond_study *s, double exponent, bool clipped, size_t angles,
                             aur_error *error) {
    enum { ROTATIONS = 2 };
    aur_oswa_options options = merged(s, clipped, 0);
    options.mirror_lobe.exponent = exponent;
    const aur_weight_table_grid grid = {
        .size = sizeof grid, .angle_count = angles, .roughness_count = 1, .rotation_count = ROTATIONS};
    const size_t steps = lab_run_options(s->run)->quick ? 6 : 60;
    table_study t = {.exponent = exponent, .clipped = clipped};
    double squares[WAYS] = {0};
    aur_result result = aur_weight_table_build(&options, &grid, 1, NULL, &t.table, error);
    if (result == AUR_OK)
        result = aur_oswa_create(&options, &t.oswa, error);
    for (size_t k = 0; k < steps && result == AUR_OK; ++k) {
        double errors[WAYS] = {0}, whole;
        /* Golden-ratio steps, to cover the intervals between the table's angles uniformly. */
        const double degrees = 80.0 * modf(0.6180339887498949 * (double)(k + 1), &whole);
        result = one_angle(&t, degrees * radian, k % ROTATIONS, errors, error);
        for (size_t way = 0; way < WAYS; ++way)
            squares[way] += errors[way] * errors[way] / (double)steps;
    }
    aur_oswa_destroy(t.oswa);
    aur_weight_table_destroy(t.table);
    if (result != AUR_OK)
        return result;
    char what[64];
    snprintf(what, sizeof what, "%zu angles%s", angles, clipped ? " clipped" : "");
    const double plain = sqrt(squares[PLAIN]), solved = sqrt(squares[SOLVED]),
                 found = sqrt(squares[LOOKED_UP]);
    add_row(s, "table", exponent, what, found, solved);
    lab_note(s->run, "%s, m = %g, table of %s: %.3f %% of a solve's gain over equal weights is lost", s->set,
             exponent, what, 100.0 * (found - solved) / (plain - solved));
    return AUR_OK;
}

static aur_result study_set(const beyond_study *s, aur_error *error) {
    static const struct {
        double exponent;
        size_t angles;
    } tables[] = {{20.0, 32}, {20.0, 128}, {200.0, 64}};
    aur_result result = study_lobe(s, 1.0, error);
    if (result == AUR_OK)
        result = study_lobe(s, 20.0, error);
    if (result == AUR_OK)
        result = study_horizon(s, error);
    for (size_t t = 0; t < 3; ++t)
        for (size_t c = 0; c < 2 && result == AUR_OK; ++c)
            result = table_loss(s, tables[t].exponent, c == 1, tables[t].angles, error);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const char *const sets[] = {"spherical-fibonacci", options->quick ? NULL : "sobol", options->set};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 3 && result == AUR_OK; ++i)
        if (sets[i] != NULL) {
            const bool fixed = lab_scrambling(sets[i]) == AUR_SCRAMBLE_ROTATE;
            const beyond_study study = {run, sets[i], options->quick ? 2 : fixed ? 8 : 40};
            result = lab_forgive(run, sets[i], study_set(&study, error), error);
        }
    return result;
}

const lab_experiment lab_marques_2018_beyond = {
    .name = "marques-2018-beyond",
    .reproduces = "Marques 2018, beyond it",
    .summary = "sum constraint, optimal density, lobes clipped at the horizon, tables: what each is worth",
    .columns = columns,
    .seconds = 5,
    .quick_seconds = 0.4,
    .run = run,
};
