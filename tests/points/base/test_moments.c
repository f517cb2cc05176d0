#include "check.h"

#include <aureole/statistics.h>

/* Tables of the t distribution (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2), and closed forms
 * for one and two degrees of freedom. */
static void has_published_quantiles(void **state) {
    (void)state;
    static const struct {
        size_t degrees;
        double probability, quantile;
    } rows[] = {{1, 0.975, 12.706}, {2, 0.975, 4.303},   {3, 0.9, 1.638},   {3, 0.975, 3.182},
                {4, 0.995, 4.604},  {5, 0.95, 2.015},    {7, 0.975, 2.365}, {10, 0.99, 2.764},
                {30, 0.975, 2.042}, {100, 0.975, 1.984}, {9, 0.999, 4.297}, {1000000000, 0.975, 1.960}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        assert_near(aur_student_quantile(rows[i].degrees, rows[i].probability), rows[i].quantile, 0.0005001);
        assert_near(aur_student_quantile(rows[i].degrees, 1.0 - rows[i].probability), -rows[i].quantile,
                    0.0005001);
    }
    for (double p = 0.501; p < 1.0 - 1e-7; p += 0.0131) {
        assert_relative(aur_student_quantile(1, p), tan(acos(-1.0) * (p - 0.5)), 1e-9);
        assert_relative(aur_student_quantile(2, p), (2 * p - 1) / sqrt(2 * p * (1 - p)), 1e-9);
    }
    assert_near(aur_student_quantile(5, 0.5), 0.0, 1e-15);
    assert_true(isnan(aur_student_quantile(0, 0.9)));
    assert_true(isnan(aur_student_quantile(3, 1.0)));
}

static void adds_moments(void **state) {
    (void)state;
    aur_moments moments = {0};
    assert_near(aur_moments_interval(&moments, 0.95), 0.0, 0.0);
    static const double values[] = {1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 6};
    for (size_t i = 0; i < 4; ++i)
        aur_moments_add(&moments, values[i]);
    assert_near(moments.mean, 1e9 + 3, 1e-6);
    assert_near(aur_moments_variance(&moments), 14.0 / 3.0, 1e-6);
    assert_near(aur_moments_standard_error(&moments), sqrt(14.0 / 12.0), 1e-6);
    assert_near(aur_moments_interval(&moments, 0.95), 3.1824463 * sqrt(14.0 / 12.0), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(has_published_quantiles),
                                       cmocka_unit_test(adds_moments)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
