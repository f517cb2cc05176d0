/* Coverage of the intervals of aur_integrate, and the rate of wrong results without a warning. */
#include <aureole/integrate.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "families.h"
#include "program/lab/lab.h"

static const char *const columns[] = {"domain",  "function",    "variance",  "tolerance", "resolution",
                                      "runs",    "holds",       "converged", "silent",    "zero",
                                      "doubted", "evaluations", NULL};

/* A caller who excludes narrow features, and one who tells nothing. */
typedef struct caller_kind {
    double resolution; /* of the options */
    uint64_t evaluations;
    size_t runs, quick_runs;
} caller_kind;

static const caller_kind callers[] = {{1.0, UINT64_C(1) << 18, 500, 20}, {0.0, UINT64_C(1) << 19, 200, 2}};

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

static aur_result tally_of(const lab_family *family, const caller_kind *caller, size_t runs, tally *t,
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
        options.relative = family->tolerance;
        options.evaluations = caller->evaluations;
        options.resolution = caller->resolution;
        options.seed = seed;
        options.peak_count = family->peak != 0.0 ? 1 : 0;
        options.peaks = &peak;
        aur_integral found = {.size = sizeof found};
        const aur_result result = aur_integrate(lab_family_evaluate, &function, &options, &found, error);
        if (result != AUR_OK)
            return result;
        count(&found, family->integral(family), family->tolerance, t);
    }
    return AUR_OK;
}

static aur_result study(lab_run *run, const lab_family *family, const caller_kind *caller, aur_error *error) {
    const size_t runs = lab_run_options(run)->quick ? caller->quick_runs : caller->runs;
    char key[128];
    snprintf(key, sizeof key, "%s %g", family->name, caller->resolution);
    double figures[FIGURES];
    if (!lab_recall(run, key, FIGURES, figures)) {
        tally t;
        aur_result result = tally_of(family, caller, runs, &t, error);
        memcpy(figures, &t, sizeof figures);
        if (result == AUR_OK)
            result = lab_save(run, key, FIGURES, figures, error);
        if (result != AUR_OK)
            return result;
    }
    const char *const texts[] = {aur_domain_name(family->domain), family->name,
                                 family->infinite ? "infinite" : "finite", NULL};
    double numbers[3 + FIGURES] = {family->tolerance, caller->resolution, (double)runs};
    for (size_t k = 0; k < FIGURES; ++k)
        numbers[3 + k] = figures[k] / (double)runs;
    lab_row(run, texts, 3 + FIGURES, numbers);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t k = 0; k < sizeof callers / sizeof *callers; ++k)
        for (size_t f = 0; f < lab_family_count() && result == AUR_OK; ++f) {
            const lab_family *const family = lab_family_at(f);
            const bool again = k > 0 && family->peak != 0.0; /* peaks replace the default resolution */
            if (!again && lab_row_requested(run, family->name))
                result = study(run, family, &callers[k], error);
        }
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
