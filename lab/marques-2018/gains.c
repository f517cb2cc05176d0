/* Gains by optimal weights in worst-case error (Marques 2018, sections 5.2 and 5.3): 128 diffuse and 64
 * glossy samples of a digit-scrambled set, each lobe from its own samples (OSW) and from all (OSWA). The
 * published figures are for one scrambling. For two lobes they can only be of a sum of two errors, as here.
 * However, both lobes see the same light, so the error of their sum is ||h_d + h_g||, given in addition. */
#include <aureole/statistics.h>
#include <math.h>
#include <string.h>

#include "search.h"

enum { DIFFUSE = 128, GLOSSY = 64, ALL = DIFFUSE + GLOSSY, GAINS = 6 };

static const double NORMAL_95 = 1.959964;

static const char *const columns[] = {
    "set",   "figure",    "seeds",      "mean",      "spread", "low", "high", "percent_published",
    "ratio", "ratio_low", "ratio_high", "published", NULL};

/* ||h_d + h_g|| (eq. 6) for weights that are the sums of those for both lobes. */
static aur_result joint_error(const double *xyz, const double *weights, const aur_potential *const lobes[2],
                              double cross, double *value, aur_error *error) {
    double z[ALL], diffuse = 0.0;
    const aur_result result = aur_worst_case_error(ALL, xyz, weights, lobes[0], NULL, &diffuse, error);
    double square = diffuse * diffuse + aur_potential_self_energy(lobes[1]) + 2.0 * cross;
    aur_potential_evaluate(lobes[1], ALL, xyz, z);
    for (size_t i = 0; i < ALL; ++i)
        square -= 2.0 * weights[i] * z[i];
    *value = sqrt(fmax(0.0, square));
    return result;
}

/* One scrambling: the gains in percent. */
static aur_result measure(const char *set, uint64_t seed, const aur_potential *const potentials[2],
                          double cross, double gains[GAINS], aur_error *error) {
    const aur_weights_options unconstrained = {.size = sizeof unconstrained,
                                               .regularization = AUR_REGULARIZATION_DEFAULT};
    double xyz[3 * ALL], weights[2 * ALL], apart[ALL], equal[ALL], joint[3] = {0};
    aur_weights_report diffuse, glossy, all[2];
    aur_result result = lab_draw(&(lab_samples){set, DIFFUSE, 1.0, 0, 2 * seed}, xyz, NULL, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){set, GLOSSY, 20.0, 0, 2 * seed + 1}, xyz + 3 * DIFFUSE, NULL, error);
    if (result == AUR_OK)
        result = aur_weights_solve(DIFFUSE, xyz, 1, potentials, &unconstrained, DIFFUSE, apart, &diffuse,
                                   NULL, error);
    if (result == AUR_OK)
        result = aur_weights_solve(GLOSSY, xyz + 3 * DIFFUSE, 1, potentials + 1, &unconstrained, GLOSSY,
                                   apart + DIFFUSE, &glossy, NULL, error);
    if (result == AUR_OK)
        result =
            aur_weights_solve(ALL, xyz, 2, potentials, &unconstrained, 2 * ALL, weights, all, NULL, error);
    for (size_t i = 0; i < ALL; ++i) {
        equal[i] = i < DIFFUSE ? 1.0 / DIFFUSE : 1.0 / GLOSSY;
        weights[i] += weights[ALL + i];
    }
    const double *const others[] = {weights, apart, equal};
    for (size_t i = 0; i < 3 && result == AUR_OK; ++i)
        result = joint_error(xyz, others[i], potentials, cross, &joint[i], error);
    if (result != AUR_OK)
        return result;
    const double merged = all[0].optimal_error + all[1].optimal_error;
    gains[0] = 100.0 * (1.0 - diffuse.optimal_error / diffuse.equal_error);
    gains[1] = 100.0 * (1.0 - glossy.optimal_error / glossy.equal_error);
    gains[2] = 100.0 * (1.0 - merged / (diffuse.optimal_error + glossy.optimal_error));
    gains[3] = 100.0 * (1.0 - merged / (diffuse.equal_error + glossy.equal_error));
    gains[4] = 100.0 * (1.0 - joint[0] / joint[1]);
    gains[5] = 100.0 * (1.0 - joint[0] / joint[2]);
    return AUR_OK;
}

/* Gains are compared as ratios of errors. */
static double ratio_of(double percent) {
    return 1.0 - 0.01 * percent;
}

static aur_result study_set(lab_run *run, const char *set, const aur_potential *const potentials[2],
                            aur_error *error) {
    static const char *const names[GAINS] = {"OSW diffuse",
                                             "OSW glossy",
                                             "OSWA against OSW",
                                             "OSWA against QMC",
                                             "OSWA against OSW by ||h_d + h_g||",
                                             "OSWA against QMC by ||h_d + h_g||"};
    static const double published[GAINS] = {7.0, 6.3, 19.1, 24.1};
    const size_t seeds = lab_run_options(run)->quick ? 200 : 3000;
    aur_moments moments[GAINS] = {0};
    double cross = 0.0;
    aur_result result = aur_cross_energy(1.0, 20.0, 1.0, 1.5, &cross, error);
    for (uint64_t seed = 0; seed < seeds; ++seed) {
        double gains[GAINS];
        if (result == AUR_OK)
            result = measure(set, seed, potentials, cross, gains, error);
        if (result != AUR_OK)
            return result;
        for (size_t i = 0; i < GAINS; ++i)
            aur_moments_add(&moments[i], gains[i]);
    }
    for (size_t i = 0; i < GAINS; ++i) {
        /* The interval is for one scrambling, as the published figure is. */
        const double mean = moments[i].mean, spread = sqrt(aur_moments_variance(&moments[i]));
        const double half = NORMAL_95 * spread;
        const bool is_published = strcmp(set, "sobol") == 0 && published[i] > 0.0;
        lab_row(run, (const char *const[]){set, names[i], NULL}, 10,
                (const double[]){(double)seeds, mean, spread, mean - half, mean + half,
                                 is_published ? published[i] : NAN, ratio_of(mean), ratio_of(mean + half),
                                 ratio_of(mean - half), is_published ? ratio_of(published[i]) : NAN});
    }
    lab_note(run,
             "%s: OSW gains %.1f +- %.1f and %.1f +- %.1f %% (published 7.0, 6.3); OSWA %.1f and %.1f %% "
             "(19.1, 24.1); by ||h_d + h_g|| %.1f and %.1f %%",
             set, moments[0].mean, sqrt(aur_moments_variance(&moments[0])), moments[1].mean,
             sqrt(aur_moments_variance(&moments[1])), moments[2].mean, moments[3].mean, moments[4].mean,
             moments[5].mean);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_potential *diffuse = NULL, *glossy = NULL;
    aur_result result = lab_lobe_potential(1.0, 1.5, &diffuse, error);
    if (result == AUR_OK)
        result = lab_lobe_potential(20.0, 1.5, &glossy, error);
    const aur_potential *const potentials[] = {diffuse, glossy};
    const char *const sets[] = {"sobol", "random",   "spherical-fibonacci",
                                "pmj02", "cascaded", lab_run_options(run)->set};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0] && result == AUR_OK; ++i)
        if (sets[i] != NULL)
            result = lab_forgive(run, sets[i], study_set(run, sets[i], potentials, error), error);
    aur_potential_destroy(diffuse);
    aur_potential_destroy(glossy);
    return result == AUR_OK ? lab_gains_search(run, error) : result;
}

const lab_experiment lab_marques_2018_gains = {
    .name = "marques-2018-gains",
    .reproduces = "Marques 2018, sections 5.2 and 5.3",
    .summary = "gains of optimal weights in worst-case error, one lobe and merged sets",
    .columns = columns,
    .measured = "ratio",
    .low = "ratio_low",
    .high = "ratio_high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .seconds = 6,
    .quick_seconds = 0.2,
    .run = run,
};
