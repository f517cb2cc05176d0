/* The distribution of samples: at the optimum, all pixels with additional samples have equal marginal gain
 * (Lagrange), and the variance falls to the target. */
#include "check.h"

#include <math.h>
#include <string.h>

#include "render/adaptive/candidate.h"

static double sum_after(size_t count, const double *variances, const uint32_t *before,
                        const uint32_t *after) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += variances[i] * before[i] / after[i];
    return sum;
}

/* A round to a target certainly exceeded uses the samples of the square law, and at most five percent more.
 */
static void test_rounds_to_an_error_take_what_it_needs(void **state) {
    (void)state;
    for (double error = 0.01; error < 0.04; error *= 1.1) {
        aur_candidate candidate = {.bound = 0.05, .rate = 1.0};
        candidate.intervals[candidate.error_measure] = (aur_error_interval){.estimate = 0.05, .high = 0.05};
        const aur_goal goal = {.error = error, .noise = error};
        const double needs = 0.05 * 0.05 / (error * error);
        const double takes = 1.0 / aur_candidate_factor(&candidate, &goal);
        assert_true(takes >= needs && takes <= 1.05 * needs);
    }
}

/* On the way to a goal that leaves room for a bias, rounds lead to each level of the noise first, so that the
 * rounds of a smaller goal begin with those of a larger one. */
static void test_rounds_pause_at_levels(void **state) {
    (void)state;
    const double error = 0.04, noise = 0.5 * error;
    double level = AUR_NOISE_LEVEL;
    for (double bound = 0.05; level * error * error > noise * noise; level *= AUR_NEXT_NOISE_LEVEL) {
        aur_candidate candidate = {.bound = bound, .rate = 1.0};
        candidate.intervals[candidate.error_measure] = (aur_error_interval){.estimate = bound, .high = bound};
        const aur_goal goal = {.error = error, .noise = noise}, paused = {error, error * sqrt(level), 0};
        const double factor = aur_candidate_factor(&candidate, &goal);
        assert_true(fabs(factor / aur_candidate_factor(&candidate, &paused) - 1.0) < 1e-12);
        bound = 0.99 * paused.noise;
        assert_true(factor < bound * bound / (candidate.bound * candidate.bound));
    }
    assert_true(level < 0.25);
}

static void test_reaches_the_factor_at_equal_gains(void **state) {
    (void)state;
    enum { PIXELS = 6 };
    static const double variances[PIXELS] = {1.0, 2.0, 3.0, 2.5, 0.0, 1.5};
    static const uint32_t before[PIXELS] = {1000, 1000, 1000, 4000, 1000, 1000};
    uint32_t after[PIXELS];
    memcpy(after, before, sizeof after);
    assert_true(aur_raise_targets(PIXELS, variances, 0.5, 1 << 24, after));
    /* Rounding up to whole samples can only lower the sum: by less than one sample in a thousand of each. */
    const double sum = sum_after(PIXELS, variances, before, after);
    assert_true(sum <= 5.0 && sum > 5.0 * (1.0 - 1e-3));
    assert_int_equal(after[4], before[4]);
    for (size_t i = 0; i < PIXELS; ++i)
        for (size_t j = 0; j < PIXELS; ++j) {
            const bool inner = after[i] > before[i] && after[i] < 4 * before[i] && after[j] > before[j] &&
                               after[j] < 4 * before[j];
            const double gain_i = variances[i] * before[i] / ((double)after[i] * after[i]);
            const double gain_j = variances[j] * before[j] / ((double)after[j] * after[j]);
            if (inner)
                assert_true(fabs(gain_i / gain_j - 1.0) < 4e-3); /* twice two samples in a thousand */
        }
}

/* No pixel grows more than fourfold or beyond the maximum; a round without samples is reported. */
static void test_limits(void **state) {
    (void)state;
    static const double variances[3] = {1e6, 1.0, 0.0};
    uint32_t targets[3] = {1, 1, 1};
    assert_true(aur_raise_targets(3, variances, 1e-9, 3, targets));
    assert_int_equal(targets[0], 3);
    assert_int_equal(targets[2], 1);
    uint32_t full[3] = {3, 3, 3};
    assert_false(aur_raise_targets(3, variances, 0.5, 3, full));
    static const double none[3] = {0};
    uint32_t ones[3] = {1, 1, 1};
    assert_false(aur_raise_targets(3, none, 0.5, 1 << 24, ones));
}

/* A pixel with zero estimated variance gets half the mean up to 32 samples, then a quarter, and at most
 * fourfold per round. */
static void test_nobody_is_left_behind(void **state) {
    (void)state;
    static const double variances[4] = {1.0, 1.0, 1.0, 0.0};
    uint32_t targets[4] = {1, 1, 1, 1};
    for (size_t round = 0; round < 4; ++round)
        assert_true(aur_raise_targets(4, variances, 1.0 / 16, 1 << 24, targets));
    assert_int_equal(targets[0], 256);
    assert_int_equal(targets[3], 49); /* 1, 4, 16, and then (3 * 256 + 16) / 16 */
    uint32_t some[3] = {40, 20, 40};  /* half of (80 + 20 + 80) / 3 */
    assert_true(aur_raise_targets(3, (const double[3]){1.0, 0.0, 1.0}, 0.5, 1 << 24, some));
    assert_int_equal(some[1], 30);
    uint32_t behind[4] = {100, 100, 100, 1};
    assert_true(aur_raise_targets(4, variances, 0.999, 1 << 24, behind));
    assert_int_equal(behind[3], 4);
}

/* In closed form: where all variances are equal, all samples by one over the factor; where one has nearly
 * all, it alone gets samples, until it has what the factor leaves beside the others. */
static void test_few_samples_are_left_where_noise_is_concentrated(void **state) {
    (void)state;
    enum { PIXELS = 100 };
    const double factor = 0.1, high = 1e6;
    double variances[PIXELS];
    uint32_t targets[PIXELS];
    for (size_t i = 0; i < PIXELS; ++i) {
        variances[i] = 1.0;
        targets[i] = 4;
    }
    assert_relative(aur_samples_left(PIXELS, variances, factor, targets), 4 * PIXELS * (1.0 / factor - 1.0),
                    1e-9);
    variances[17] = high;
    const double rest = factor * (high + PIXELS - 1) - (PIXELS - 1);
    assert_relative(aur_samples_left(PIXELS, variances, factor, targets), 4.0 * (high / rest - 1.0), 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rounds_to_an_error_take_what_it_needs),
        cmocka_unit_test(test_rounds_pause_at_levels),
        cmocka_unit_test(test_reaches_the_factor_at_equal_gains),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_nobody_is_left_behind),
        cmocka_unit_test(test_few_samples_are_left_where_noise_is_concentrated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
