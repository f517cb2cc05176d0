/* Estimates of functionals: closed forms, target errors, and invalid functionals and options. */
#include <aureole/estimate.h>
#include <aureole/statistics.h>
#include <string.h>

#include "check.h"

/* The mean of u v^2, and of whether u < .3. */
static aur_result means(void *user, const aur_estimate_points *points, double *values, aur_error *error) {
    uint64_t *const evaluations = user;
    double sum = 0.0;
    (void)error;
    assert_int_equal(points->dimension, 2);
    values[0] = values[1] = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const u = points->points + 2 * i;
        assert_true(u[0] >= 0.0 && u[0] < 1.0 && u[1] >= 0.0 && u[1] < 1.0);
        sum += points->weights[i];
        values[0] += points->weights[i] * u[0] * u[1] * u[1];
        values[1] += points->weights[i] * (u[0] < 0.3 ? 1.0 : 0.0);
    }
    assert_true(fabs(sum - 1.0) < 1e-12);
    *evaluations += points->count;
    return AUR_OK;
}

static void test_means(void **state) {
    (void)state;
    static const char *const sets[] = {NULL, "fibonacci-lattice", "halton", "random"};
    for (size_t k = 0; k < 4; ++k) {
        aur_estimate_options options = {.size = sizeof options};
        aur_estimate_options_init(2, 2, &options, NULL);
        aur_estimated found[2];
        aur_estimate_report report = {.size = sizeof report};
        uint64_t evaluations = 0;
        aur_error error;
        options.set = sets[k];
        options.relative = 0.005;
        assert_int_equal(aur_estimate(means, &evaluations, &options, found, &report, &error), AUR_OK);
        assert_true(report.reached);
        assert_int_equal(report.evaluations, evaluations);
        assert_true(found[0].half_width <= 0.005 * found[0].value);
        /* Six standard errors of 16 randomisations: Student's t exceeds 6 once in 10^5 times. */
        assert_true(fabs(found[0].value - 1.0 / 6.0) <= 6.0 * found[0].error);
        assert_true(fabs(found[1].value - 0.3) <= 6.0 * found[1].error + 0.01);
    }
}

/* Without a target error: one level of all points; with an unreachable target: as many levels as fit. */
static void test_reasons(void **state) {
    (void)state;
    aur_estimate_options options = {.size = sizeof options};
    aur_estimate_options_init(2, 2, &options, NULL);
    aur_estimated found[2];
    aur_estimate_report report = {.size = sizeof report};
    uint64_t evaluations = 0;
    aur_error error;
    options.relative = 0.0;
    options.evaluations = 1600;
    assert_int_equal(aur_estimate(means, &evaluations, &options, found, &report, &error), AUR_OK);
    assert_true(!report.reached && report.levels == 1 && report.evaluations == 1600);
    options.absolute = 1e-12;
    options.first = 16;
    assert_int_equal(aur_estimate(means, &evaluations, &options, found, &report, &error), AUR_OK);
    assert_true(!report.reached && report.levels == 2 && report.evaluations == 16 * (16 + 32));
}

/* Of 1000 intervals the stated fraction covers the mean, and standard errors are those of the values' spread:
 * five standard deviations of the binomial count give a false alarm in two million. Means of independent
 * random points are nearly normal. */
static void test_coverage(void **state) {
    (void)state;
    enum { SEEDS = 1000 };
    static const double confidences[] = {0.8, 0.95};
    for (size_t k = 0; k < 2; ++k) {
        size_t held = 0;
        aur_moments values = {0};
        double squares = 0.0;
        for (uint64_t seed = 0; seed < SEEDS; ++seed) {
            aur_estimate_options options = {.size = sizeof options};
            aur_estimate_options_init(2, 2, &options, NULL);
            aur_estimated found[2];
            uint64_t evaluations = 0;
            options.set = "random";
            options.relative = 0.0;
            options.evaluations = 64 * options.replicates;
            options.confidence = confidences[k];
            options.seed = seed;
            assert_int_equal(aur_estimate(means, &evaluations, &options, found, NULL, NULL), AUR_OK);
            held += fabs(found[0].value - 1.0 / 6.0) <= found[0].half_width;
            aur_moments_add(&values, found[0].value);
            squares += found[0].error * found[0].error / SEEDS;
        }
        const double expected = confidences[k] * SEEDS, deviation = sqrt(expected * (1.0 - confidences[k]));
        print_message("confidence %g: %zu of %d hold the mean\n", confidences[k], held, (int)SEEDS);
        assert_in_range(held, expected - 5.0 * deviation, expected + 5.0 * deviation);
        /* The variance of 1000 values errs by 4.5 %. */
        assert_relative(squares, aur_moments_variance(&values), 0.25);
    }
}

/* Whether the first coordinate is below the number that `user` points to. */
static aur_result below(void *user, const aur_estimate_points *points, double *values, aur_error *error) {
    (void)error;
    values[0] = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        values[0] += points->points[i] < *(const double *)user ? points->weights[i] : 0.0;
    return AUR_OK;
}

/* Randomisations of a stratified set agree: no interval is 0. */
static void test_agreement(void **state) {
    (void)state;
    double bound = 0.3;
    size_t held = 0;
    for (uint64_t seed = 0; seed < 100; ++seed) {
        aur_estimate_options options = {.size = sizeof options};
        aur_estimate_options_init(1, 1, &options, NULL);
        options.seed = seed;
        aur_estimated found;
        aur_estimate_report report = {.size = sizeof report};
        assert_int_equal(aur_estimate(below, &bound, &options, &found, &report, NULL), AUR_OK);
        assert_true(report.reached && report.levels > 1 && !report.constant && found.half_width > 0.0);
        held += fabs(found.value - bound) <= found.half_width;
    }
    print_message("%zu of 100 hold\n", held);
    assert_true(held >= 87); /* fewer than 87 of 100 with .95 come once in 800 */
    bound = 1e-7;
    aur_estimate_options options = {.size = sizeof options};
    aur_estimate_options_init(1, 1, &options, NULL);
    aur_estimated found;
    aur_estimate_report report = {.size = sizeof report};
    assert_int_equal(aur_estimate(below, &bound, &options, &found, &report, NULL), AUR_OK);
    assert_true(!report.reached && report.constant && isinf(found.half_width) && found.value == 0.0);
    assert_true(report.evaluations >= 65536 && report.evaluations < 131072);
    assert_true(report.resolution == 3.0 / (double)report.evaluations);
}

static aur_result wrong(void *user, const aur_estimate_points *points, double *values, aur_error *error) {
    values[0] = NAN;
    return *(const bool *)user && points->replicate == 3
               ? aur_fail(error, AUR_ERROR_OPEN, "its own reason")
               : (values[0] = *(const bool *)user ? 1.0 : NAN, AUR_OK);
}

static void test_refusals(void **state) {
    (void)state;
    aur_estimated found;
    aur_error error;
    bool fails = true;
    aur_estimate_options options = {.size = sizeof options};
    aur_estimate_options_init(1, 1, &options, NULL);
    assert_int_equal(aur_estimate(wrong, &fails, &options, &found, NULL, &error), AUR_ERROR_OPEN);
    assert_string_equal(error.message, "its own reason");
    fails = false;
    assert_int_equal(aur_estimate(wrong, &fails, &options, &found, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "value 0 of the functional is"));
    aur_estimate_options bad[6];
    for (size_t i = 0; i < 6; ++i)
        bad[i] = options;
    bad[0].dimension = 0;
    bad[1].values = 0;
    bad[2].relative = -1.0;
    bad[3].confidence = 0.0;
    bad[4].replicates = 3;
    bad[5].evaluations = 15;
    for (size_t i = 0; i < 6; ++i)
        assert_int_equal(aur_estimate(wrong, &fails, &bad[i], &found, NULL, &error), AUR_ERROR_ARGUMENT);
    options.set = "sobool";
    assert_int_equal(aur_estimate(wrong, &fails, &options, &found, NULL, &error), AUR_ERROR_NAME);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_means), cmocka_unit_test(test_reasons),
                                       cmocka_unit_test(test_coverage), cmocka_unit_test(test_agreement),
                                       cmocka_unit_test(test_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
