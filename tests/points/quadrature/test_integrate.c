/* Integrals to a tolerance: closed forms on every domain, products with an axis, stopping reasons, and
 * invalid functions and options. */
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
    return u[2] > 0.9 ? -(double)NAN : 1.0;
}

static double zero(const double u[3], double x) {
    (void)u;
    (void)x;
    return 0.0;
}

/* Within the interval with a probability of about .95: three times the target error is exceeded for 8
 * replicates once in 10^4 runs, and the seeds are fixed. */
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

/* Exact weights make a polynomial exact at the first level: the third, of 8192 values, ends the work. */
static void polynomials(void **state) {
    (void)state;
    integrand f = {.value = height};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.relative = 1e-13;
    options.resolution = 1.0;
    aur_integral integral = {.size = sizeof integral}, again = {.size = sizeof again};
    aur_error error;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_int_equal(integral.levels, 3);
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
    options.evaluations = 10000; /* 16 * 512 are the largest level */
    aur_integral integral = {.size = sizeof integral};
    aur_error error;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_int_equal(integral.reason, AUR_INTEGRATE_EVALUATIONS);
    assert_true(integral.evaluations == 8192 && f.points == 8192 && integral.error > 1e-9);
    /* For a constant only its value is determined, however many evaluations there are. */
    f = (integrand){.value = zero};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_true(integral.value == 0.0 && integral.reason == AUR_INTEGRATE_EVALUATIONS);
    assert_true(isinf(integral.interval) && isinf(integral.error));
    options.evaluations = UINT64_C(1) << 20;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_true(integral.reason == AUR_INTEGRATE_CONSTANT && integral.evaluations == 1 << 19);
    assert_true(isinf(integral.error) && integral.doubts == AUR_INTEGRATE_ALL_EQUAL);
    options.resolution = 1.0;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_OK);
    assert_true(integral.reason == AUR_INTEGRATE_CONSTANT && integral.evaluations == 65536);
    f = (integrand){.value = smooth, .fail_after = 3};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_ERROR_OPEN);
    assert_string_equal(error.message, "the function's own reason");
    f = (integrand){.value = broken};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "the function is nan in the direction ("));
}

/* One level of a discontinuous function: of 1000 intervals the stated fraction covers the integral. Student's
 * t assumes normal values, which these nearly are; five standard deviations of the binomial count give a
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
            options.relative = 0.0;
            options.first = 64;
            aur_integral integral = {.size = sizeof integral};
            assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
            held += fabs(integral.value - expected) <= integral.interval;
        }
        const double expected_hits = confidences[k] * SEEDS,
                     deviation = sqrt(expected_hits * (1.0 - confidences[k]));
        print_message("confidence %g: %zu of %d hold the integral\n", confidences[k], held, (int)SEEDS);
        assert_in_range(held, expected_hits - 5.0 * deviation, expected_hits + 5.0 * deviation);
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
        options.relative = k == 0 ? 0.0 : 1e-12;
        options.first = 128;
        options.evaluations = (uint64_t)(2048 << k);
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
    bad.region = (aur_region)9;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.domain = AUR_DOMAIN_DISK;
    bad.peak_count = 1;
    bad.peaks = &(aur_integrate_peak){.centre = (const double[2]){0.0, 0.0}, .radius = 0.1};
    refuse(&bad, AUR_ERROR_UNSUPPORTED);
    bad.domain = AUR_DOMAIN_HEMISPHERE;
    bad.peaks = &(aur_integrate_peak){.centre = (const double[3]){0.0, 0.0, 2.0}, .radius = 1.0};
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad.peaks = &(aur_integrate_peak){.centre = (const double[3]){0.0, 0.0, 1.0}, .exponent = 2.0};
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.domain = AUR_DOMAIN_CUBE;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.set = "sobol";
    refuse(&bad, AUR_ERROR_ARGUMENT);
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
    bad.relative = -1.0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.confidence = 1.0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.replicates = 3;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.evaluations = 31;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.resolution = 1.5;
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad.resolution = 1e-7; /* 3e7 points, and 2^22 are allowed */
    refuse(&bad, AUR_ERROR_ARGUMENT);
    bad = good;
    bad.size = 0;
    refuse(&bad, AUR_ERROR_ARGUMENT);
}

/* A function's values as they come, of any number of coordinates. */
typedef struct general {
    void (*value)(const double *x, double *values);
    size_t coordinates, values;
    double sums[4];
} general;

static aur_result evaluate_general(void *user, size_t count, const double *points, const double *along,
                                   double *values, aur_error *error) {
    general *const f = user;
    (void)along;
    (void)error;
    for (size_t i = 0; i < count; ++i)
        f->value(points + f->coordinates * i, values + f->values * i);
    return AUR_OK;
}

static void last_squared_2(const double *x, double *values) {
    values[0] = x[1] * x[1];
}

static void last_squared_3(const double *x, double *values) {
    values[0] = x[2] * x[2];
}

static void last_squared_4(const double *x, double *values) {
    values[0] = x[3] * x[3];
}

/* The integral of the square of the last coordinate over each domain. */
static void domains(void **state) {
    (void)state;
    const struct {
        aur_domain domain;
        aur_region region;
        size_t dimension, coordinates;
        void (*value)(const double *x, double *values);
        double expected, measure;
    } cases[] = {
        {AUR_DOMAIN_SQUARE, AUR_REGION_DOMAIN, 0, 2, last_squared_2, 1.0 / 3.0, 1.0},
        {AUR_DOMAIN_CUBE, AUR_REGION_DOMAIN, 4, 4, last_squared_4, 1.0 / 3.0, 1.0},
        {AUR_DOMAIN_DISK, AUR_REGION_DOMAIN, 0, 2, last_squared_2, AUR_PI / 4.0, AUR_PI},
        {AUR_DOMAIN_AXES, AUR_REGION_DOMAIN, 0, 3, last_squared_3, AUR_PI * 2.0 / 3.0, 2.0 * AUR_PI},
        {AUR_DOMAIN_ROTATIONS, AUR_REGION_DOMAIN, 0, 4, last_squared_4, 0.25, 1.0},
        {AUR_DOMAIN_CUBE, AUR_REGION_BALL, 0, 3, last_squared_3, AUR_PI * 4.0 / 15.0, AUR_PI * 4.0 / 3.0},
        {AUR_DOMAIN_CUBE, AUR_REGION_TRIANGLE, 0, 2, last_squared_2, 1.0 / 12.0, 0.5},
        {AUR_DOMAIN_CUBE, AUR_REGION_TETRAHEDRON, 0, 3, last_squared_3, 1.0 / 60.0, 1.0 / 6.0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(cases[k].domain, &options, NULL);
        options.region = cases[k].region;
        options.dimension = cases[k].dimension;
        options.relative = 1e-4;
        assert_int_equal(aur_integrate_coordinates(&options), cases[k].coordinates);
        general f = {.value = cases[k].value, .coordinates = cases[k].coordinates, .values = 1};
        for (size_t mean = 0; mean < 2; ++mean) {
            aur_integral integral = {.size = sizeof integral};
            options.mean = mean > 0;
            assert_int_equal(aur_integrate(evaluate_general, &f, &options, &integral, NULL), AUR_OK);
            assert_int_equal(integral.reason, AUR_INTEGRATE_TOLERANCE);
            assert_relative(integral.value, cases[k].expected / (mean > 0 ? cases[k].measure : 1.0), 3e-4);
        }
    }
}

static double band(const double u[3], double x) {
    (void)x;
    return u[2] < 0.05 ? 1.0 : 0.0;
}

/* Replicates of a stratified set agree on the count of an edge along its boxes: no interval is 0, and no
 * result that claims 1 % is off by 3. */
static void agreement(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        integrand f = {.value = band};
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
        options.seed = seed;
        aur_integral integral = {.size = sizeof integral};
        assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
        /* One point more in one replicate. */
        assert_true(integral.interval >= 2.0 * AUR_PI / (double)integral.evaluations);
        assert_relative(integral.value, 0.1 * AUR_PI, 0.03);
    }
}

static const double sun_axis[3] = {0.6, 0.0, 0.8};
static const double sun_degrees = 0.2666;

static double sun_and_sky(const double u[3], double x) {
    (void)x;
    const double half = sin(0.5 * sun_degrees / 180.0 * AUR_PI);
    const double depth = 1.0 - (u[0] * sun_axis[0] + u[2] * sun_axis[2]);
    assert_true(u[2] >= 0.0);
    return 1000.0 * u[2] + (depth < 2.0 * half * half ? 2e7 : 0.0);
}

static double narrow(const double u[3], double x) {
    (void)x;
    assert_true(u[2] >= 0.0);
    return exp(2e4 * (fabs(u[0] * sun_axis[0] + u[2] * sun_axis[2]) - 1.0));
}

static double one_over_r(const double u[3], double x) {
    (void)x;
    double squared = 0.0;
    for (size_t d = 0; d < 3; ++d)
        squared += (u[d] - sun_axis[d]) * (u[d] - sun_axis[d]);
    return 1.0 / sqrt(squared);
}

static void root_of_first(const double *x, double *values) {
    values[0] = pow(x[0], -0.9);
}

/* A sun with a separate stratum; singularities that the points' density cancels are constants. */
static void peaks(void **state) {
    (void)state;
    aur_integrate_peak peak = {.centre = sun_axis, .radius = 0.3};
    integrand f = {.value = sun_and_sky};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.exponent = 1.0;
    options.peak_count = 1;
    options.peaks = &peak;
    aur_integral integral = {.size = sizeof integral};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    const double sine = sin(sun_degrees / 180.0 * AUR_PI);
    assert_relative(integral.value, 2000.0 * AUR_PI / 3.0 + 2e7 * AUR_PI * sine * sine * sun_axis[2], 0.01);
    assert_true(integral.reason == AUR_INTEGRATE_TOLERANCE && integral.evaluations == f.points);
    /* A peak that reaches below the horizon, a part of another one. */
    const aur_integrate_peak two[] = {{.centre = (const double[3]){1.0, 0.0, 0.0}, .radius = 30.0}, peak};
    options.peak_count = 2;
    options.peaks = two;
    f = (integrand){.value = sun_and_sky};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_relative(integral.value, 2000.0 * AUR_PI / 3.0 + 2e7 * AUR_PI * sine * sine * sun_axis[2], 0.03);

    /* Where the rest of the domain is 0, tiny values raise no warning; and for 0 nothing can be estimated. */
    f = (integrand){.value = narrow};
    aur_integrate_options_init(AUR_DOMAIN_AXES, &options, NULL);
    options.peak_count = 1;
    options.peaks = &peak;
    peak.radius = 3.0;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_true(integral.reason == AUR_INTEGRATE_TOLERANCE && integral.doubts == 0);
    assert_relative(integral.value, 2.0 * AUR_PI / 2e4, 0.03);
    assert_true(integral.evaluations < 100000);
    peak.radius = 0.0; /* all axes, each once */
    options.evaluations = 1 << 17;
    f = (integrand){.value = height};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_relative(integral.value, 2.0 * AUR_PI / 3.0, 0.03);
    f = (integrand){.value = zero};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_true(isinf(integral.interval) && integral.doubts == AUR_INTEGRATE_ALL_EQUAL);

    /* The integral of 1/|u - a| over the sphere is 4 pi; of x^-.9 on [0,1] it is 10. */
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.relative = 1e-7;
    options.peak_count = 1;
    options.peaks = &peak;
    peak = (aur_integrate_peak){.centre = sun_axis, .exponent = 1.0};
    f = (integrand){.value = one_over_r};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_true(integral.reason == AUR_INTEGRATE_TOLERANCE);
    assert_relative(integral.value, 4.0 * AUR_PI, 1e-6);
    general g = {.value = root_of_first, .coordinates = 1, .values = 1};
    options.domain = AUR_DOMAIN_CUBE;
    options.dimension = 1;
    peak = (aur_integrate_peak){.centre = (const double[1]){0.0}, .exponent = 0.9};
    assert_int_equal(aur_integrate(evaluate_general, &g, &options, &integral, NULL), AUR_OK);
    assert_relative(integral.value, 10.0, 1e-12);
}

static double spot(const double u[3], double x) {
    (void)x;
    return u[2] + (sun_axis[0] * u[0] + sun_axis[2] * u[2] > 1.0 - 5e-5
                       ? 3000.0
                       : 0.0); /* pi and 3000 times 2 pi 5e-5 */
}

/* A spot of a share of 5e-5 of the hemisphere over a varying sky: without a resolution the sky converges;
 * with it a result without the spot has the probability .05, so that more than 9 of 60 have .001. */
static void resolution(void **state) {
    (void)state;
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.evaluations = 1 << 17;
    const double expected = AUR_PI + 3000.0 * 2.0 * AUR_PI * 5e-5;
    size_t blind = 0, wrong = 0;
    for (options.seed = 0; options.seed < 60; ++options.seed)
        for (size_t k = 0; k < 2; ++k) {
            options.resolution = k == 0 ? 1.0 : 5e-5;
            integrand f = {.value = spot};
            aur_integral integral = {.size = sizeof integral};
            assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
            const bool silent = integral.reason == AUR_INTEGRATE_TOLERANCE && integral.doubts == 0 &&
                                fabs(integral.value - expected) > 0.03 * expected;
            *(k == 0 ? &blind : &wrong) += silent;
            assert_true(k == 0 || (integral.evaluations >= 60000 && integral.resolution <= 5e-5));
        }
    assert_true(blind > 15 && wrong <= 9);
    /* By default a spot of 1e-5 or more is sampled. Fewer evaluations than that takes raise a doubt, unless
     * the caller knows better. */
    options.resolution = 0.0;
    for (options.seed = 0; options.seed < 10; ++options.seed)
        for (size_t k = 0; k < 2; ++k) {
            options.evaluations = UINT64_C(1) << (k == 0 ? 19 : 15);
            integrand f = {.value = spot};
            aur_integral integral = {.size = sizeof integral};
            assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
            const bool right = fabs(integral.value - expected) < 0.03 * expected;
            assert_true(right || integral.reason == AUR_INTEGRATE_EVALUATIONS);
            assert_true(k == 0 || (integral.doubts & AUR_INTEGRATE_UNRESOLVED) != 0);
            /* 3/N of 2 pi steradians. */
            const double radius = acos(1.0 - 3.0 / (double)integral.evaluations) * 180.0 / AUR_PI;
            assert_relative(integral.resolution_degrees, radius, 1e-9);
        }
    options.first = 64;
    integrand flat = {.value = height};
    aur_integral early = {.size = sizeof early};
    assert_int_equal(aur_integrate(evaluate, &flat, &options, &early, NULL), AUR_OK);
    assert_true(early.reason == AUR_INTEGRATE_TOLERANCE && early.evaluations < 8192 && early.doubts == 0);
    /* Equal values are believed as late. */
    integrand f = {.value = zero};
    aur_integral integral = {.size = sizeof integral};
    options.first = 0;
    options.evaluations = 1 << 17;
    options.resolution = 3e-5;
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_true(integral.evaluations >= 100000 && integral.doubts == AUR_INTEGRATE_ALL_EQUAL);
}

static void several(const double *x, double *values) {
    values[0] = 1000.0 * x[0];
    values[1] = x[1] < 0.3 ? 1.0 : 0.0;
    values[2] = 0.0;
}

/* Components of one integral share a target; separate ones have individual targets, also a constant. */
static void vectors(void **state) {
    (void)state;
    general f = {.value = several, .coordinates = 2, .values = 3};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SQUARE, &options, NULL);
    options.values = 3;
    options.relative = 1e-5;
    aur_estimated results[3];
    aur_integral integral = {.size = sizeof integral};
    assert_int_equal(aur_integrate_values(evaluate_general, &f, &options, results, &integral, NULL), AUR_OK);
    assert_int_equal(integral.reason, AUR_INTEGRATE_TOLERANCE);
    assert_relative(results[0].value, 500.0, 3e-5);
    assert_true(fabs(results[1].value - 0.3) < 3e-5 * 500.0 && results[2].value == 0.0);
    assert_true(results[0].value == integral.value && results[0].half_width == integral.interval);
    options.separate = true;
    options.evaluations = 16384;
    assert_int_equal(aur_integrate_values(evaluate_general, &f, &options, results, &integral, NULL), AUR_OK);
    assert_true(integral.reason == AUR_INTEGRATE_EVALUATIONS && isinf(results[2].half_width));
    assert_true((integral.doubts & AUR_INTEGRATE_ALL_EQUAL) != 0 && isfinite(results[1].half_width));
}

static double small_cap(const double u[3], double x) {
    (void)x;
    return u[2] > 0.9995 ? 1.0 : 0.0; /* a share of 2.5e-4 */
}

static double spike(const double u[3], double x) {
    (void)x;
    return 1.0 + 1e9 * exp(3e4 * (u[2] - 1.0));
}

static double singular(const double u[3], double x) {
    (void)x;
    return pow(1.0 - u[2], -0.9);
}

static void count_message(void *user, const char *message) {
    assert_true(message[0] != '\0');
    ++*(size_t *)user;
}

/* Suspicious values are reported, in the result and in a message, and do not stop the evaluations. */
static void doubts(void **state) {
    (void)state;
    const struct {
        double (*value)(const double u[3], double x);
        unsigned expected;
    } cases[] = {{small_cap, AUR_INTEGRATE_SPARSE},
                 {spike, AUR_INTEGRATE_DOMINATED},
                 {singular, AUR_INTEGRATE_HEAVY_TAIL}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        size_t messages = 0;
        integrand f = {.value = cases[k].value};
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
        options.relative = 10.0; /* which any interval is within */
        options.evaluations = 16384;
        options.warnings = (aur_warnings){count_message, &messages};
        aur_integral integral = {.size = sizeof integral};
        assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
        assert_true((integral.doubts & cases[k].expected) != 0);
        assert_true(integral.reason == AUR_INTEGRATE_EVALUATIONS && messages >= 2);
        assert_true(integral.resolution == 3.0 / (double)integral.evaluations);
    }
}

/* One level's error of a smooth function: to 1024 points weights are exact to a high degree. Beyond, equal
 * weights would leave 1e-2 at 2048 points, as the grid is uneven there; weights to degree 6 do not. */
static void grids(void **state) {
    (void)state;
    const double expected = 4.0 * AUR_PI * sinh(sqrt(6.0)) / sqrt(6.0);
    double errors[2] = {0.0, 0.0};
    for (size_t k = 0; k < 2; ++k)
        for (uint64_t seed = 0; seed < 20; ++seed) {
            integrand f = {.value = smooth};
            aur_integrate_options options = {.size = sizeof options};
            aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
            options.relative = 0.0;
            options.first = (size_t)(1024 << k);
            options.replicates = 4;
            options.seed = seed;
            aur_integral integral = {.size = sizeof integral};
            assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
            errors[k] = fmax(errors[k], fabs(integral.value - expected));
        }
    print_message("largest errors of 20: %g with 1024 points, %g with 2048\n", errors[0], errors[1]);
    assert_true(errors[0] < 1e-9 && errors[1] < 1e-4);
}

static double tenth_power(const double u[3], double x) {
    (void)x;
    return pow(u[2], 10.0);
}

/* A named set has one level of any number of points. */
static void sets(void **state) {
    (void)state;
    static const char *const names[] = {"spherical-fibonacci", "electrostatic", "sobol"};
    for (size_t k = 0; k < 3; ++k) {
        integrand f = {.value = height};
        aur_integrate_options options = {.size = sizeof options};
        aur_integrate_options_init(AUR_DOMAIN_AXES, &options, NULL);
        options.set = names[k];
        options.relative = 0.0;
        options.first = 50;
        options.mean = true;
        aur_integral integral = {.size = sizeof integral};
        assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
        assert_true(integral.levels == 1 && integral.evaluations == 50 * 16);
        assert_relative(integral.value, 1.0 / 3.0, 1e-13); /* exact weights */
    }
    /* 50 points of Lebedev are exact to degree 11, but only with their native weights. */
    integrand f = {.value = tenth_power};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.set = "lebedev";
    options.relative = 0.0;
    options.first = 50;
    aur_integral integral = {.size = sizeof integral};
    assert_int_equal(aur_integrate(evaluate, &f, &options, &integral, NULL), AUR_OK);
    assert_relative(integral.value, 4.0 * AUR_PI / 11.0, 1e-13);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms), cmocka_unit_test(polynomials), cmocka_unit_test(ends),
        cmocka_unit_test(bad_options),  cmocka_unit_test(coverage),    cmocka_unit_test(difference),
        cmocka_unit_test(domains),      cmocka_unit_test(agreement),   cmocka_unit_test(peaks),
        cmocka_unit_test(vectors),      cmocka_unit_test(doubts),      cmocka_unit_test(grids),
        cmocka_unit_test(sets),         cmocka_unit_test(resolution)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
