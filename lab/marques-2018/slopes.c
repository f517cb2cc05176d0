/* Worst-case error against the number of samples, with equal and with optimal weights: for random samples the
 * rate improves, for low-discrepancy ones the constant. Not a figure of the paper; marques-2018-fig7 measures
 * the errors of images. */
#include <math.h>
#include <stdlib.h>

#include "samples.h"

enum { SIZES = 7, SMALLEST = 16, LARGEST = SMALLEST << (SIZES - 1) };

static const char *const columns[] = {"set", "exponent", "n", "equal", "optimal", "gain_percent", NULL};

/* Root mean squares over seeds. */
static aur_result measure(const lab_samples *first, size_t seeds, const aur_potential *potential,
                          double *room, double rms[2], aur_error *error) {
    const aur_weights_options unconstrained = {.size = sizeof unconstrained,
                                               .regularization = AUR_REGULARIZATION_DEFAULT};
    double *const xyz = room, *const weights = room + 3 * LARGEST;
    double squares[2] = {0};
    for (uint64_t seed = 0; seed < seeds; ++seed) {
        lab_samples requested = *first;
        requested.seed = seed;
        aur_weights_report report;
        aur_result result = lab_draw(&requested, xyz, NULL, error);
        if (result == AUR_OK)
            result = aur_weights_solve(requested.count, xyz, 1, &potential, &unconstrained, requested.count,
                                       weights, &report, NULL, error);
        if (result != AUR_OK)
            return result;
        squares[0] += report.equal_error * report.equal_error;
        squares[1] += report.optimal_error * report.optimal_error;
    }
    rms[0] = sqrt(squares[0] / (double)seeds);
    rms[1] = sqrt(squares[1] / (double)seeds);
    return AUR_OK;
}

static aur_result study(lab_run *run, const char *set, double exponent, double *room, aur_error *error) {
    aur_potential *potential;
    aur_result result = lab_lobe_potential(exponent, 1.5, &potential, error);
    double counts[SIZES], equal[SIZES], optimal[SIZES];
    const bool fixed = lab_scrambling(set) == AUR_SCRAMBLE_ROTATE; /* rotations do not change weights */
    const size_t seeds = fixed ? 1 : lab_run_options(run)->quick ? 4 : 40;
    for (size_t i = 0; i < SIZES && result == AUR_OK; ++i) {
        const size_t count = (size_t)SMALLEST << i;
        double rms[2];
        result = measure(&(lab_samples){.set = set, .count = count, .exponent = exponent}, seeds, potential,
                         room, rms, error);
        if (result != AUR_OK)
            break;
        counts[i] = (double)count;
        equal[i] = rms[0];
        optimal[i] = rms[1];
        lab_row(run, (const char *const[]){set, NULL}, 5,
                (const double[]){exponent, counts[i], rms[0], rms[1], 100.0 * (1.0 - rms[1] / rms[0])});
    }
    if (result == AUR_OK)
        lab_note(run, "%s, m = %g: slope %.3f with equal weights, %.3f with optimal ones", set, exponent,
                 lab_slope(SIZES, counts, equal).value, lab_slope(SIZES, counts, optimal).value);
    aur_potential_destroy(potential);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    double *const room = malloc(4 * LARGEST * sizeof *room);
    if (room == NULL)
        return AUR_ERROR_MEMORY;
    aur_result result = AUR_OK;
    const bool quick = lab_run_options(run)->quick;
    const char *const sets[] = {"random",
                                "sobol",
                                "spherical-fibonacci",
                                "pmj02",
                                "cascaded",
                                quick ? NULL : "sliced",
                                lab_run_options(run)->set};
    const double exponents[] = {1.0, 20.0};
    for (size_t e = 0; e < 2; ++e)
        for (size_t i = 0; i < sizeof sets / sizeof sets[0] && result == AUR_OK; ++i)
            if (sets[i] != NULL)
                result = lab_forgive(run, sets[i], study(run, sets[i], exponents[e], room, error), error);
    free(room);
    return result;
}

static const report_plot plots[] = {
    {.name = "equal",
     .title = "Worst-case error with equal weights against the number of samples",
     .x = "n",
     .y = "equal",
     .series = "set",
     .panel = "exponent",
     .log_x = true,
     .log_y = true},
    {.name = "optimal",
     .title = "Worst-case error with optimal weights against the number of samples",
     .x = "n",
     .y = "optimal",
     .series = "set",
     .panel = "exponent",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_slopes = {
    .name = "marques-2018-slopes",
    .reproduces = "none: worst-case errors; fig. 7 is of images",
    .summary = "worst-case error against N: random samples gain a rate, nets a constant",
    .columns = columns,
    .seconds = 33,
    .quick_seconds = 0.2,
    .plots = plots,
    .run = run,
};
