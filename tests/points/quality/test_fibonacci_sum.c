#include "check.h"

#include "points/quality/pairs/pair_sum.h"
#include "points/quality/sphere/fibonacci_sum.h"
#include "sphere_sets.h"

static double relative_difference(size_t count, aur_domain domain) {
    test_points points = spherical_fibonacci(count, domain);
    aur_axes axes;
    assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
    const aur_measure_options options = {.size = sizeof options};
    aur_twofold pairs, lags;
    assert_int_equal(aur_distance_sum(&axes, &options, &pairs, NULL), AUR_OK);
    assert_int_equal(aur_fibonacci_distance_sum(count, domain, &options, &lags, NULL), AUR_OK);
    aur_axes_release(&axes);
    release_points(&points);
    if (count == 1)
        return fabs(pairs.high) + fabs(lags.high);
    return fabs((lags.high - pairs.high) + (lags.low - pairs.low)) / pairs.high;
}

/* All small sizes, sizes at which the lags change their method, and one large. */
static void lags_agree_with_pairs(void **state) {
    (void)state;
    static const aur_domain domains[] = {AUR_DOMAIN_SPHERE, AUR_DOMAIN_HEMISPHERE};
    for (int d = 0; d < 2; ++d) {
        for (size_t count = 1; count < 200; ++count)
            assert_near(relative_difference(count, domains[d]), 0.0, 3e-16);
        static const size_t counts[] = {233, 377, 1000, 1597, 2584, 4097, 10000};
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c)
            assert_near(relative_difference(counts[c], domains[d]), 0.0, 1e-16);
    }
    assert_near(relative_difference(65536, AUR_DOMAIN_SPHERE), 0.0, 1e-16);
}

/* The limit of C = E^2 N^(3/2) is 0.8115, which needs the sum to 1e-16. */
static void large_sets_are_near_the_limit(void **state) {
    (void)state;
    const size_t count = 200000;
    test_points points = spherical_fibonacci(count, AUR_DOMAIN_SPHERE);
    assert_true(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    double energy = 0.0;
    assert_int_equal(aur_measure("energy", (const aur_points_view[]){seen(&points)}, NULL, &energy, NULL),
                     AUR_OK);
    assert_near(energy * energy * pow((double)count, 1.5), 0.8115, 1e-4);
    release_points(&points);
}

static void the_set_is_recognised(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(5000, AUR_DOMAIN_SPHERE);
    assert_true(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    for (size_t i = 0; i < points.count; ++i) { /* a rotation about z */
        double *const x = points.coordinates + 3 * i;
        const double old = x[0];
        x[0] = 0.6 * old - 0.8 * x[1];
        x[1] = 0.8 * old + 0.6 * x[1];
    }
    assert_true(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    points.coordinates[3 * 4000] += 1e-13;
    assert_false(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    points.coordinates[3 * 4000] -= 1e-13;
    points.domain = AUR_DOMAIN_HEMISPHERE;
    assert_false(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    release_points(&points);
    points = spherical_fibonacci(3000, AUR_DOMAIN_HEMISPHERE);
    assert_true(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    points.weights = malloc(points.count * sizeof(double));
    for (size_t i = 0; i < points.count; ++i)
        points.weights[i] = 1.0;
    assert_false(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    release_points(&points);
    points = random_directions(100, 1);
    assert_false(aur_is_spherical_fibonacci((const aur_points_view[]){seen(&points)}));
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lags_agree_with_pairs),
        cmocka_unit_test(large_sets_are_near_the_limit),
        cmocka_unit_test(the_set_is_recognised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
