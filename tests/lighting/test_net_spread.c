/* The error of a set estimated from its parts: numbers with variances that fall with a known power of the
 * size. */
#include "lighting/viewfactors/sky_slices.h"

#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "points/base/random.h"

enum { COUNT = 4000, PARTS = 8 };

/* Sums of twelve uniform numbers are near enough to a normal distribution. */
static double normal(uint64_t a, uint64_t b) {
    double sum = -6.0;
    for (uint64_t k = 0; k < 12; ++k)
        sum += aur_unit_double(aur_hash3(a, b, k));
    return sum;
}

/* Parts of one set: its error plus deviations of halves, quarters and eighths, so that the mean of PARTS /
 * 2^level parts has the variance 2^(rate level). */
static void make(double rate, double *values) {
    for (size_t i = 0; i < COUNT; ++i)
        for (size_t p = 0; p < PARTS; ++p) {
            double sum = normal(i, 0);
            for (size_t level = 1; level <= 3; ++level) {
                const double wide =
                    sqrt(pow(2.0, rate * (double)level) - pow(2.0, rate * (double)(level - 1)));
                const size_t part = p >> (3 - level);
                const double value = normal(i, (1u << level) + part / 2);
                sum += wide * (part % 2 == 0 ? value : -value);
            }
            values[PARTS * i + p] = sum;
        }
}

/* The rate is estimated (4,000 numbers give it to .02), means are unchanged, and Student's intervals of 95 %
 * (2.3646 for 7 degrees of freedom) have a coverage of 94 to 96 %, three standard deviations of 4,000. */
static void test_rates(void **state) {
    (void)state;
    static const double rates[] = {1.0, 1.5, 2.0};
    double *const values = malloc(COUNT * PARTS * sizeof *values);
    assert_non_null(values);
    for (size_t k = 0; k < sizeof rates / sizeof rates[0]; ++k) {
        make(rates[k], values);
        assert_near(aur_net_spread_settle(COUNT, PARTS, values), rates[k], 0.1);
        size_t held = 0;
        for (size_t i = 0; i < COUNT; ++i) {
            double mean = 0.0, squares = 0.0;
            for (size_t p = 0; p < PARTS; ++p)
                mean += values[PARTS * i + p] / PARTS;
            for (size_t p = 0; p < PARTS; ++p)
                squares += (values[PARTS * i + p] - mean) * (values[PARTS * i + p] - mean);
            assert_near(mean, normal(i, 0), 1e-12 * pow(8.0, rates[k]));
            held += fabs(mean) <= 2.3646 * sqrt(squares / (PARTS * (PARTS - 1)));
        }
        assert_true(held > COUNT * 94 / 100 && held < COUNT * 96 / 100);
    }
    free(values);
}

/* Two parts, or an odd number, determine no rate; constants are unchanged. */
static void test_little(void **state) {
    (void)state;
    double two[2] = {0.25, 0.75}, same[4] = {0.5, 0.5, 0.5, 0.5};
    assert_near(aur_net_spread_settle(1, 2, two), 1.5, 1e-12);
    assert_near(two[1] - two[0], 0.5 * sqrt(1.0 / (pow(2.0, 1.5) - 1.0)), 1e-12);
    aur_net_spread_settle(1, 4, same);
    for (size_t p = 0; p < 4; ++p)
        assert_near(same[p], 0.5, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rates), cmocka_unit_test(test_little)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
