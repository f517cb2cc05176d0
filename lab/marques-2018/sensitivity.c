/* Sensitivity to parameters: the smoothness that weights are optimised for against the smoothness at which
 * the error is evaluated, and the regularisation (Marques 2018, sections 4.3 and 6.2). */
#include <math.h>

#include "samples.h"

enum { COUNT = 64, SMOOTHNESSES = 5, REGULARIZATIONS = 6, EXPONENTS = 3 };

static const char *const columns[] = {
    "set", "exponent", "made_for_s", "judged_at_s", "regularization", "gain_percent", NULL};

typedef struct choice {
    const char *set;
    double exponent, solved_for, judged_at, regularization;
} choice;

/* The gain in percent over equal weights, by root mean squares over seeds. */
static aur_result add_row(lab_run *run, const choice *c, double *gain, aur_error *error) {
    const size_t seeds = lab_run_options(run)->quick ? 8 : 100;
    const aur_weights_options options = {.size = sizeof options, .regularization = c->regularization};
    aur_potential *maker = NULL, *judge = NULL;
    aur_result result = lab_lobe_potential(c->exponent, c->solved_for, &maker, error);
    if (result == AUR_OK)
        result = lab_lobe_potential(c->exponent, c->judged_at, &judge, error);
    const aur_potential *const solved = maker;
    double equal = 0.0, weighted = 0.0;
    for (uint64_t seed = 0; seed < seeds && result == AUR_OK; ++seed) {
        double xyz[3 * COUNT], weights[COUNT], plain, optimal;
        result = lab_draw(&(lab_samples){c->set, COUNT, c->exponent, 0, seed}, xyz, NULL, error);
        if (result == AUR_OK)
            result = aur_weights_solve(COUNT, xyz, 1, &solved, &options, COUNT, weights, NULL, NULL, error);
        if (result == AUR_OK)
            result = aur_worst_case_error(COUNT, xyz, NULL, judge, NULL, &plain, error);
        if (result == AUR_OK)
            result = aur_worst_case_error(COUNT, xyz, weights, judge, NULL, &optimal, error);
        if (result == AUR_OK) {
            equal += plain * plain;
            weighted += optimal * optimal;
        }
    }
    if (result == AUR_OK) {
        lab_text(run, c->set);
        lab_number(run, c->exponent);
        lab_number(run, c->solved_for);
        lab_number(run, c->judged_at);
        lab_number(run, c->regularization);
        *gain = 100.0 * (1.0 - sqrt(weighted / equal));
        lab_number(run, *gain);
    }
    aur_potential_destroy(maker);
    aur_potential_destroy(judge);
    return result;
}

static const double smoothness[SMOOTHNESSES] = {1.1, 1.3, 1.5, 1.7, 1.9};
static const double regularizations[REGULARIZATIONS] = {0.0, 1e-6, 1e-3, 0.01, 0.1, 0.5};
static const double exponents[EXPONENTS] = {1.0, 20.0, 200.0};

/* The loss of the weights of each smoothness against the best ones, over the smoothnesses at which they are
 * evaluated, in percentage points of gain. */
static aur_result vary_smoothness(lab_run *run, const char *set, report_table *drawn, aur_error *error) {
    double gains[SMOOTHNESSES][SMOOTHNESSES] = {{0}}, lost[SMOOTHNESSES] = {0};
    size_t best = 0, published = 2;
    for (size_t judged = 0; judged < SMOOTHNESSES; judged += 2) {
        for (size_t solved = 0; solved < SMOOTHNESSES; ++solved) {
            const choice c = {set, 20.0, smoothness[solved], smoothness[judged], AUR_REGULARIZATION_DEFAULT};
            const aur_result result = add_row(run, &c, &gains[solved][judged], error);
            if (result != AUR_OK)
                return result;
            lab_table_row(drawn, (const char *const[]){set, NULL}, 3,
                          (const double[]){c.solved_for, c.judged_at, gains[solved][judged]});
        }
        double most = gains[0][judged];
        for (size_t solved = 1; solved < SMOOTHNESSES; ++solved)
            most = fmax(most, gains[solved][judged]);
        for (size_t solved = 0; solved < SMOOTHNESSES; ++solved)
            lost[solved] = fmax(lost[solved], most - gains[solved][judged]);
    }
    for (size_t solved = 1; solved < SMOOTHNESSES; ++solved)
        best = lost[solved] < lost[best] ? solved : best;
    lab_note(
        run,
        "%s: weights made for s = 1.5 gain %.1f, %.1f and %.1f %% at s = 1.1, 1.5 and 1.9, at most %.1f "
        "points below the best choice there; the least such loss has s = %.1f (%.1f points), the most s = "
        "1.1 (%.1f)",
        set, gains[published][0], gains[published][2], gains[published][4], lost[published], smoothness[best],
        lost[best], lost[0]);
    return AUR_OK;
}

static aur_result vary_regularization(lab_run *run, const char *set, aur_error *error) {
    for (size_t e = 0; e < EXPONENTS; ++e) {
        double gains[REGULARIZATIONS];
        for (size_t r = 0; r < REGULARIZATIONS; ++r) {
            const choice c = {set, exponents[e], 1.5, 1.5, regularizations[r]};
            const aur_result result = add_row(run, &c, &gains[r], error);
            if (result != AUR_OK)
                return result;
        }
        lab_note(run, "%s, m = %g: gain %.1f %% without regularisation, %.1f %% with 1e-6, %.1f %% with 0.5",
                 set, exponents[e], gains[0], gains[1], gains[REGULARIZATIONS - 1]);
    }
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const char *const sets[] = {"sobol", "spherical-fibonacci", lab_run_options(run)->set};
    static const char *const drawn_columns[] = {"set", "made_for_s", "judged_at_s", "gain_percent", NULL};
    report_table *const drawn = lab_table(run, "smoothness", drawn_columns);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 3 && result == AUR_OK; ++i) {
        if (sets[i] == NULL)
            continue;
        result = vary_smoothness(run, sets[i], drawn, error);
        if (result == AUR_OK)
            result = vary_regularization(run, sets[i], error);
        result = lab_forgive(run, sets[i], result, error);
    }
    return result;
}

static const report_plot plots[] = {
    {.name = "gain",
     .title = "Gain over equal weights in percent against the smoothness that it is judged at",
     .table = "smoothness",
     .x = "judged_at_s",
     .y = "gain_percent",
     .series = "made_for_s",
     .panel = "set"},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_sensitivity = {
    .name = "marques-2018-sensitivity",
    .reproduces = "Marques 2018, sections 4.3 and 6.2",
    .summary = "how much the smoothness and the regularisation of weights matter",
    .columns = columns,
    .plots = plots,
    .seconds = 0.3,
    .quick_seconds = 0.1,
    .run = run,
};
