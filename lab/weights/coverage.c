/* Coverage of the intervals of aur_integrate, and the rate of wrong results without a warning. */
#include <aureole/integrate.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "families.h"
#include "program/lab/lab.h"

static const char *const columns[] = {"domain", "function", "variance",    "tolerance",
                                      "runs",   "holds",    "converged",   "silent",
                                      "zero",   "doubted",  "evaluations", NULL};

/* Over all runs; doubles, so that they can be stored for resuming. */
typedef struct tally {
    double holds, converged, silent, zero, doubted, evaluations;
} tally;

enum { FIGURES = sizeof(tally) / sizeof(double) };

/* A run is silently wrong if its error is beyond three times the tolerance, but its result reports that the
 * tolerance was reached, without any warning. */
static void count(const aur_integral *found, double expected, double tolerance, tally *t) {
    const double off = fabs(found->value - expected);
    const bool converged = found->reason == AUR_INTEGRATE_TOLERANCE;
    t->holds += off <= found->interval;
    t->converged += converged;
    t->silent += converged && found->doubts == 0 && off > 3.0 * tolerance * fabs(expected);
    t->zero += found->interval == 0.0;
    t->doubted += found->doubts != 0;
    t->evaluations += (double)found->evaluations;
}

static aur_result tally_of(const lab_family *family, double tolerance, size_t runs, tally *t,
                           aur_error *error) {
    static const double corner[1] = {0.0};
    const bool sphere = family->domain == AUR_DOMAIN_SPHERE || family->domain == AUR_DOMAIN_HEMISPHERE;
    const aur_integrate_peak peak = {.centre = sphere ? lab_family_axis : corner,
                                     .radius = fmax(family->peak, 0.0),
                                     .exponent = fmax(-family->peak, 0.0)};
    *t = (tally){0};
    for (size_t seed = 0; seed < runs; ++seed) {
        lab_family function = *family;
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(family->domain, &options, NULL);
        options.dimension = family->dimension;
        options.exponent = family->exponent;
        options.relative = tolerance;
        options.evaluations = UINT64_C(1) << 18;
        options.seed = seed;
        options.peak_count = family->peak != 0.0 ? 1 : 0;
        options.peaks = &peak;
        aur_integral found = {.size = sizeof found};
        const aur_result result = aur_integrate(lab_family_evaluate, &function, &options, &found, error);
        if (result != AUR_OK)
            return result;
        count(&found, family->integral(family), tolerance, t);
    }
    return AUR_OK;
}

static aur_result study(lab_run *run, const lab_family *family, double tolerance, aur_error *error) {
    const size_t runs = lab_run_options(run)->quick ? 20 : 500;
    char key[128];
    snprintf(key, sizeof key, "%s %g", family->name, tolerance);
    double figures[FIGURES];
    if (!lab_recall(run, key, FIGURES, figures)) {
        tally t;
        aur_result result = tally_of(family, tolerance, runs, &t, error);
        memcpy(figures, &t, sizeof figures);
        if (result == AUR_OK)
            result = lab_keep(run, key, FIGURES, figures, error);
        if (result != AUR_OK)
            return result;
    }
    const char *const texts[] = {aur_domain_name(family->domain), family->name,
                                 family->infinite ? "infinite" : "finite", NULL};
    double numbers[2 + FIGURES] = {tolerance, (double)runs};
    for (size_t k = 0; k < FIGURES; ++k)
        numbers[2 + k] = figures[k] / (double)runs;
    lab_row(run, texts, 2 + FIGURES, numbers);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_result result = AUR_OK;
    const size_t tolerances = lab_run_options(run)->quick ? 1 : 2;
    for (size_t k = 0; k < tolerances; ++k)
        for (size_t f = 0; f < lab_family_count() && result == AUR_OK; ++f)
            if (lab_wants(run, lab_family_at(f)->name))
                result =
                    study(run, lab_family_at(f), lab_family_at(f)->tolerance * (k == 0 ? 1.0 : 0.1), error);
    return result;
}

const lab_experiment lab_integrate_coverage = {
    .name = "integrate-coverage",
    .reproduces = "docs/integrals.md",
    .summary =
        "how often intervals of integrals to a tolerance hold, and how often a wrong one has no warning",
    .rows = "function",
    .columns = columns,
    .takes_no_set = "it judges aur_integrate, which chooses its points",
    .seconds = 550,
    .quick_seconds = 10,
    .run = run,
};
