/* How often the intervals of aur_integrate hold the integral, and the differences of its levels the error. */
#include <aureole/integrate.h>
#include <math.h>

#include "integrands.h"
#include "program/lab/lab.h"

static const char *const columns[] = {
    "domain", "integrand",   "tolerance",          "runs", "interval", "difference",
    "error",  "evaluations", "rms_over_tolerance", NULL};

static aur_result evaluate(void *user, size_t count, const double *directions, const double *along,
                           double *values, aur_error *error) {
    (void)error;
    (void)along;
    for (size_t i = 0; i < count; ++i)
        values[i] = lab_integrand_value(user, directions + 3 * i);
    return AUR_OK;
}

/* On the hemisphere the integral is that of f(u) + f(-u) on it: over the whole sphere. */
static aur_result evaluate_folded(void *user, size_t count, const double *directions, const double *along,
                                  double *values, aur_error *error) {
    (void)error;
    (void)along;
    for (size_t i = 0; i < count; ++i) {
        const double *const u = directions + 3 * i;
        values[i] =
            lab_integrand_value(user, u) + lab_integrand_value(user, (const double[3]){-u[0], -u[1], -u[2]});
    }
    return AUR_OK;
}

static aur_result study(lab_run *run, aur_domain domain, lab_class kind, double tolerance, aur_error *error) {
    const size_t runs = lab_run_options(run)->quick ? 50 : 400;
    size_t held[3] = {0};
    double evaluations = 0.0, squares = 0.0;
    for (size_t seed = 0; seed < runs; ++seed) {
        lab_integrand integrand = lab_integrand_make(kind, seed);
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(domain, &options, NULL);
        options.relative = tolerance;
        options.seed = seed;
        aur_integral integral = {.size = sizeof integral};
        const aur_integrand function = domain == AUR_DOMAIN_SPHERE ? evaluate : evaluate_folded;
        const aur_result result = aur_integrate(function, &integrand, &options, &integral, error);
        if (result != AUR_OK)
            return result;
        const double expected = lab_integrand_integral(&integrand), off = fabs(integral.value - expected);
        held[0] += off <= integral.interval;
        held[1] += off <= integral.difference;
        held[2] += off <= integral.error;
        evaluations += (double)integral.evaluations / (double)runs;
        squares += off * off / (expected * expected * (double)runs);
    }
    lab_text(run, aur_domain_name(domain));
    lab_text(run, lab_class_name(kind));
    lab_number(run, tolerance);
    lab_number(run, (double)runs);
    for (size_t k = 0; k < 3; ++k)
        lab_number(run, (double)held[k] / (double)runs);
    lab_number(run, evaluations);
    lab_number(run, sqrt(squares) / tolerance);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_result result = AUR_OK;
    const aur_domain domains[] = {AUR_DOMAIN_SPHERE, AUR_DOMAIN_HEMISPHERE};
    for (size_t d = 0; d < 2; ++d)
        for (lab_class kind = LAB_SMOOTH; kind < LAB_CLASSES; ++kind)
            for (double tolerance = 1e-2;
                 tolerance > (lab_run_options(run)->quick ? 5e-3 : 5e-4) && result == AUR_OK;
                 tolerance *= 0.1)
                result = study(run, domains[d], kind, tolerance, error);
    return result;
}

const lab_experiment lab_integrate_coverage = {
    .name = "integrate-coverage",
    .reproduces = "docs/choosing.md",
    .summary = "how often intervals and differences of levels hold the error of integrals to a tolerance",
    .columns = columns,
    .takes_no_set = "it judges aur_integrate, which has its own points",
    .seconds = 60,
    .quick_seconds = 4.1,
    .run = run,
};
