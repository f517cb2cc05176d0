/* Samples and their optimal weights, drawn as points (Marques 2018, figs 3 to 5): a few samples chosen by
 * hand, Sobol samples of a diffuse and a glossy lobe, and the union of both for either lobe. The paper's
 * statements on the first are checked sample by sample. */
#include <math.h>
#include <string.h>

#include "samples.h"

enum { RING = 4, FEW = RING + 2, DIFFUSE = 128, GLOSSY = 64, ALL = DIFFUSE + GLOSSY };

static const char *const columns[] = {"panel", "over_mean_is", "sample",    "x", "y",
                                      "z",     "weight",       "over_mean", NULL};

/* The paper's settings: no constraint on the sum. */
static const aur_weights_options unconstrained = {.size = sizeof unconstrained,
                                                  .regularization = AUR_REGULARIZATION_DEFAULT};

static const double pi = 3.14159265358979323846;

/* The figure's colours of a weight relative to the mean: green is 1/N, blue below, yellow and red above. */
static const char *colour_of(double relative) {
    return relative < 0.8     ? "below .8"
           : relative < 0.98  ? ".8 to .98"
           : relative <= 1.02 ? ".98 to 1.02"
           : relative <= 1.2  ? "1.02 to 1.2"
                              : "above 1.2";
}

/* Rows in Lambert's azimuthal projection, with each weight relative to the mean. */
static void add_rows(lab_run *run, const char *panel, size_t count, const double *xyz,
                     const double *weights) {
    double mean = 0.0;
    for (size_t i = 0; i < count; ++i)
        mean += weights[i] / (double)count;
    for (size_t i = 0; i < count; ++i) {
        const double *const u = xyz + 3 * i, scale = 1.0 / sqrt(1.0 + u[2]);
        lab_row(run, (const char *const[]){panel, colour_of(weights[i] / mean), NULL}, 6,
                (const double[]){(double)i, u[0] * scale, u[1] * scale, u[2], weights[i], weights[i] / mean});
    }
}

/* --- figure 3 */

static void place(double theta, double phi, double xyz[3]) {
    xyz[0] = sin(theta) * cos(phi);
    xyz[1] = sin(theta) * sin(phi);
    xyz[2] = cos(theta);
}

/* The pole, four samples about it, and one more near the pole. */
static void few_samples(double theta, double xyz[3 * FEW]) {
    place(0.0, 0.0, xyz);
    for (size_t i = 0; i < RING; ++i)
        place(theta, 0.5 * pi * (double)i, xyz + 3 * (1 + i));
    place(0.25, 0.25 * pi, xyz + 3 * (1 + RING));
}

static aur_result solve_few(size_t count, double theta, const aur_potential *lobe, double xyz[3 * FEW],
                            double weights[FEW], aur_error *error) {
    few_samples(theta, xyz);
    return aur_weights_solve(count, xyz, 1, &lobe, &unconstrained, FEW, weights, NULL, NULL, error);
}

/* The polar angle at which the four about the pole have the same weight as the sample at the pole, for p = 1.
 */
static aur_result find_ring(const aur_potential *uniform, double *theta, aur_error *error) {
    double low = 0.3, high = 1.5;
    for (int i = 0; i < 50; ++i) {
        double xyz[3 * FEW], weights[FEW];
        *theta = 0.5 * (low + high);
        const aur_result result = solve_few(FEW - 1, *theta, uniform, xyz, weights, error);
        if (result != AUR_OK)
            return result;
        /* With larger distances, the pole's sample represents more of the hemisphere. */
        *(weights[0] < weights[1] ? &low : &high) = *theta;
    }
    return AUR_OK;
}

static aur_result figure3(lab_run *run, aur_error *error) {
    static const char *const panels[] = {"3a: p = 1", "3b: p = cos", "3c: p = 1 and one more",
                                         "3d: p = cos and one more"};
    aur_potential *lobes[2] = {NULL};
    double w[4][FEW] = {{0}}, theta = 0.0;
    aur_result result = lab_lobe_potential(0.0, 1.5, &lobes[0], error);
    if (result == AUR_OK)
        result = lab_lobe_potential(1.0, 1.5, &lobes[1], error);
    if (result == AUR_OK)
        result = find_ring(lobes[0], &theta, error);
    for (size_t k = 0; k < 4 && result == AUR_OK; ++k) {
        const size_t count = k < 2 ? FEW - 1 : FEW;
        double xyz[3 * FEW];
        result = solve_few(count, theta, lobes[k % 2], xyz, w[k], error);
        if (result == AUR_OK)
            add_rows(run, panels[k], count, xyz, w[k]);
    }
    aur_potential_destroy(lobes[0]);
    aur_potential_destroy(lobes[1]);
    if (result != AUR_OK)
        return result;
    lab_claim(run, fabs(w[0][0] - w[0][1]) < 1e-9,
              "fig. 3a: five equidistant samples weigh the same for p = 1: four %.1f degrees from the one at "
              "the pole do, "
              "%.4f each (1/N is .2)",
              theta * 180.0 / pi, w[0][0]);
    lab_claim(run, w[1][0] > w[1][1],
              "fig. 3b: for p = cos the pole's sample weighs more than the others, %.3f against %.3f",
              w[1][0], w[1][1]);
    for (size_t k = 2; k < 4; ++k) {
        /* By N times the weight, like the colours. */
        const double more = (double)FEW / (FEW - 1);
        const double pole = more * w[k][0] / w[k - 2][0], near = more * w[k][1] / w[k - 2][1];
        const double far = more * w[k][3] / w[k - 2][3];
        lab_claim(run, pole < 1.0 && near > 1.0 && far > 1.0,
                  "fig. 3%c: one more sample near the pole lowers N w of the pole's, times %.2f, and raises "
                  "that of the others, "
                  "times %.2f and %.2f",
                  k == 2 ? 'c' : 'd', pole, near, far);
    }
    return AUR_OK;
}

/* --- figures 4 and 5 */

static aur_result solve_panel(lab_run *run, const char *panel, size_t count, const double *xyz,
                              const aur_potential *lobe, aur_error *error) {
    double weights[ALL];
    aur_weights_report report;
    const aur_result result =
        aur_weights_solve(count, xyz, 1, &lobe, &unconstrained, ALL, weights, &report, NULL, error);
    if (result != AUR_OK)
        return result;
    add_rows(run, panel, count, xyz, weights);
    double least = weights[0], most = weights[0];
    for (size_t i = 1; i < count; ++i) {
        least = fmin(least, weights[i]);
        most = fmax(most, weights[i]);
    }
    lab_note(run, "%s: weights from %.3f to %.3f / N, worst-case error %.6f", panel, least * (double)count,
             most * (double)count, report.optimal_error);
    return AUR_OK;
}

static aur_result figures4and5(lab_run *run, const char *set, aur_error *error) {
    aur_potential *lobes[2] = {NULL};
    double xyz[3 * ALL];
    char panel[4][80];
    static const char *const what[] = {"4a: diffuse", "4b: glossy", "5a: all for diffuse",
                                       "5b: all for glossy"};
    for (size_t i = 0; i < 4; ++i)
        snprintf(panel[i], sizeof panel[i], "%s (%.40s)", what[i], set);
    aur_result result = lab_lobe_potential(1.0, 1.5, &lobes[0], error);
    if (result == AUR_OK)
        result = lab_lobe_potential(20.0, 1.5, &lobes[1], error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){set, DIFFUSE, 1.0, false, 0}, xyz, NULL, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){set, GLOSSY, 20.0, false, 1}, xyz + 3 * DIFFUSE, NULL, error);
    if (result == AUR_OK)
        result = solve_panel(run, panel[0], DIFFUSE, xyz, lobes[0], error);
    if (result == AUR_OK)
        result = solve_panel(run, panel[1], GLOSSY, xyz + 3 * DIFFUSE, lobes[1], error);
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i)
        result = solve_panel(run, panel[2 + i], ALL, xyz, lobes[i], error);
    aur_potential_destroy(lobes[0]);
    aur_potential_destroy(lobes[1]);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const char *const sets[] = {"sobol", lab_run_options(run)->set};
    aur_result result = figure3(run, error);
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i)
        if (sets[i] != NULL)
            result = lab_forgive(run, sets[i], figures4and5(run, sets[i], error), error);
    return result;
}

static const report_plot plots[] = {
    {.name = "weights",
     .title = "Samples by weight, in Lambert's azimuthal projection",
     .x = "x",
     .y = "y",
     .series = "over_mean_is",
     .panel = "panel",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_weights = {
    .name = "marques-2018-weights",
    .reproduces = "Marques 2018, figs 3-5",
    .summary = "optimal weights of a few samples, of Sobol samples of two lobes, and of their union",
    .columns = columns,
    .plots = plots,
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
};
