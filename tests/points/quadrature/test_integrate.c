/* Integrals to a tolerance: closed forms on every domain, products with an axis, reasons of stopping, and
 * what the function and the options may do wrong. */
#include <aureole/integrate.h>
#include <string.h>

#include "check.h"
#include "points/base/vector.h"

typedef struct integrand {
    double (*value)(const double u[3], double x);
    uint64_t calls, points;
    size_t fail_after; /* calls; 0: never */
} integrand;

static aur_result evaluate(void *user, size_t count, const double *directions, const double *along,
                           double *values, aur_error *error) {
    integrand *const f = user;
    assert_true(count > 0 && count <= AUR_INTEGRAND_POINTS);
    f->points += count;
    if (++f->calls == f->fail_after)
        return aur_fail(error, AUR_ERROR_OPEN, "the function's own reason");
    for (size_t i = 0; i < count; ++i)
        values[i] = f->value(directions + 3 * i, along != NULL ? along[i] : 0.0);
    return AUR_OK;
}

static double smooth(const double u[3], double x) {
    (void)x;
    return exp(u[0] + 2.0 * u[1] - u[2]);
}

static double half(const double u[3], double x) {
    (void)x;
    return u[0] + 0.3 * u[1] > 0.2 ? 1.0 : 0.0;
}

static double height(const double u[3], double x) {
    (void)x;
    return u[2] * u[2];
}

static double radial(const double u[3], double x) {
    return exp(-x) * x * x * (1.0 + u[2]);
}

static double broken(const double u[3], double x) {
    (void)x;
    return u[2] > 0.9 ? (double)NAN : 1.0;
}

static double zero(const double u[3], double x) {
    (void)u;
    (void)x;
    return 0.0;
}

/* Within the interval with a probability of .95 or so: three times the error wanted is out of reach for 8
 * replicates but in one of 10^4 runs, and the seeds are fixed. */
static void closed_forms(void **state) {
    (void)state;
    const double length = sqrt(6.0), cap = cos(AUR_PI / 6.0), sphere = 4.0 * AUR_PI;
    const struct {
        double (*value)(const double u[3], double x);
        aur_domain domain;
        double cap, exponent, from, to, expected;
    } cases[] = {
        {smooth, AUR_DOMAIN_SPHERE, 0.0, 0.0, 0.0, 0.0, sphere * sinh(length) / length},
        {half, AUR_DOMAIN_SPHERE, 0.0, 0.0, 0.0, 0.0, 0.5 * sphere * (1.0 - 0.2 / sqrt(1.09))},
        {height, AUR_DOMAIN_HEMISPHERE, 0.0, 0.0, 0.0, 0.0, 2.0 * AUR_PI / 3.0},
        {height, AUR_DOMAIN_HEMISPHERE, 0.0, 1.0, 0.0, 0.0, 2.0 * AUR_PI / 4.0},
        {height, AUR_DOMAIN_HEMISPHERE, 0.0, 20.0, 0.0, 0.0, 2.0 * AUR_PI / 23.0},
        {height, AUR_DOMAIN_HEMISPHERE, 30.0, 0.0, 0.0, 0.0, 2.0 * AUR_PI * (1.0 - cap * cap * cap) / 3.0},
        {radial, AUR_DOMAIN_SPHERE, 0.0, 0.0, 0.0, 2.0, sphere * (2.0 - 10.0 * exp(-2.0))},
    };
    aur_error error;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        integrand f = {.value = cases[k].value};
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(cases[k].domain, &options, NULL);
        options.cap_degrees = cases[k].cap;
        options.exponent = cases[k].exponent;
        options.has_axis = cases[k].to > cases[k].from;
        options.axis_from = cases[k].from;
        options.axis_to = cases[k].to;
        options.relative = 1e-3;
        aur_integral integral = {.size = sizeof integral};
        assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
        assert_int_equal(integral.reason, AUR_INTEGRATE_TOLERANCE);
        assert_true(integral.error <= 1e-3 * fabs(integral.value) && integral.interval <= integral.error);
        assert_true(integral.evaluations == f.points && integral.levels > 1);
        assert_relative(integral.value, cases[k].expected, 3e-3);
    }
}

/* Exact weights make a polynomial exact at the first level: the second confirms it, and the work ends. */
static void polynomials(void **state) {
    (void)state;
    integrand f = {.value = height};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.relative = 1e-13;
    aur_integral integral = {.size = sizeof integral}, again = {.size = sizeof again};
    aur_error error;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_int_equal(integral.levels, 2);
    assert_relative(integral.value, 4.0 * AUR_PI / 3.0, 1e-14);
    assert_int_equal(aur_integrate(evaluate, &f, &options, &again, &error), AUR_OK);
    assert_memory_equal(&integral, &again, sizeof again);
}

static void ends(void **state) {
    (void)state;
    integrand f = {.value = half};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.relative = 1e-9;
    options.evaluations = 10000; /* 8 * 1024 are the largest level */
    aur_integral integral = {.size = sizeof integral};
    aur_error error;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_int_equal(integral.reason, AUR_INTEGRATE_EVALUATIONS);
    assert_true(integral.evaluations == 8192 && f.points == 8192 && integral.error > 1e-9);
    f = (integrand){.value = zero}; /* zero is found to any relative error */
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_true(integral.value == 0.0 && integral.reason == AUR_INTEGRATE_TOLERANCE);
    f = (integrand){.value = smooth, .fail_after = 3};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_ERROR_OPEN);
    assert_string_equal(error.message, "the function's own reason");
    f = (integrand){.value = broken};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "the function is nan in the direction ("));
}

/* One level of a discontinuous function: of 1000 intervals as many hold the integral as they say. Student's
 * assumes normal values, which these nearly are, and five standard deviations of the binomial count are a
 * false alarm in two million. */
static void coverage(void **state) {
    (void)state;
    enum { SEEDS = 1000 };
    const double expected = 2.0 * AUR_PI * (1.0 - 0.2 / sqrt(1.09));
    static const double confidences[] = {0.8, 0.95};
    for (size_t k = 0; k < 2; ++k) {
        size_t held = 0;
        for (uint64_t seed = 0; seed < SEEDS; ++seed) {
            integrand f = {.value = half};
            aur_integrate_options options = {.size = sizeof options};
            aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
            options.confidence = confidences[k];
            options.seed = seed;
            options.evaluations = 64 * options.replicates;
            aur_integral integral = {.size = sizeof integral};
            assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
            held += fabs(integral.value - expected) <= integral.interval;
        }
        const double wanted = confidences[k] * SEEDS, deviation = sqrt(wanted * (1.0 - confidences[k]));
        print_message("confidence %g: %zu of %d hold the integral\n", confidences[k], held, (int)SEEDS);
        assert_in_range(held, wanted - 5.0 * deviation, wanted + 5.0 * deviation);
    }
}

/* The difference is between values that are reported with fewer and with more evaluations. */
static void difference(void **state) {
    (void)state;
    aur_integral levels[2];
    for (size_t k = 0; k < 2; ++k) {
        integrand f = {.value = half};
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
        options.relative = 1e-12;
        options.evaluations = (uint64_t)(512 << k);
        levels[k] = (aur_integral){.size = sizeof levels[k]};
        assert_int_equal(aur_integrate(evaluate, &f, &options, &levels[k], NULL), AUR_OK);
    }
    assert_true(isinf(levels[0].difference) && levels[1].difference > 0.0);
    assert_true(levels[1].difference == fabs(levels[1].value - levels[0].value));
}

static void refuse(const aur_integrate_options *options, aur_result result) {
    integrand f = {.value = smooth};
    aur_integral integral = {.size = sizeof integral};
    aur_error error;
    assert_int_equal(aur_integrate(evaluate, &f, options, &integral, &error), result);
    assert_int_equal(f.calls, 0);
    assert_true(error.message[0] != '\0');
}

static void bad_options(void **state) {
    (void)state;
    aur_integrate_options good = {.size = sizeof good};
    aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &good, NULL);
    aur_integrate_options bad = good;
    bad.domain = AUR_DOMAIN_SQUARE;
    refuse(&bad, AUR_ERROR_UNSUPPORTED);
    bad = good;
    bad.cap_degrees = 91.0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.exponent = NAN;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad.exponent = 2.0;
    bad.cap_degrees = 20.0;
    refuse(&bad, AUR_ERROR_UNSUPPORTED);
    bad = good;
    bad.has_axis = true;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.relative = 0.0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.confidence = 1.0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.replicates = 3;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.evaluations = 511;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.size = 0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(closed_forms), cmocka_unit_test(polynomials),
                                       cmocka_unit_test(ends),         cmocka_unit_test(bad_options),
                                       cmocka_unit_test(coverage),     cmocka_unit_test(difference)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
