#include "check.h"

#include <aureole/rotations.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector.h"
#include "test_points.h"

static test_points rotations(size_t count) {
    return (test_points){.domain = AUR_DOMAIN_ROTATIONS,
                         .count = count,
                         .dimension = 4,
                         .coordinates = calloc(4 * count, sizeof(double))};
}

static test_points random_rotations(size_t count, uint64_t seed) {
    test_points points = rotations(count);
    for (size_t i = 0; i < count; ++i) {
        aur_rotation rotation;
        aur_rotation_uniform(aur_hash2(seed, i), &rotation);
        aur_rotation_to_quaternion(&rotation, points.coordinates + 4 * i);
    }
    return points;
}

static double measured(const char *metric, const test_points *points) {
    double value = NAN;
    aur_error error = {0};
    if (aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error) != AUR_OK)
        fail_msg("%s: %s", metric, error.message);
    return value;
}

/* The largest angle to a group's rotations is the greatest disorientation of two of its crystals (Mackenzie
 * 1958 for cubes, Heinz and Neumann 1991): cos of its half is (2 + sqrt 2)/4, (1 + sqrt 3)/4, 1/2, ... */
static void groups_have_the_known_covering(void **state) {
    (void)state;
    static const struct {
        aur_symmetry symmetry;
        double degrees, nearest;
    } published[] = {{AUR_SYMMETRY_432, 62.799, 90}, {AUR_SYMMETRY_622, 93.841, 60},
                     {AUR_SYMMETRY_422, 98.421, 90}, {AUR_SYMMETRY_222, 120.0, 180.0},
                     {AUR_SYMMETRY_23, 90.0, 120},   {AUR_SYMMETRY_32, 104.478, 120}};
    for (size_t k = 0; k < sizeof published / sizeof published[0]; ++k) {
        test_points group = rotations(AUR_SYMMETRY_ORDER_MAX);
        group.count = aur_symmetry_group(published[k].symmetry, group.coordinates);
        assert_near(measured("covering", &group) * 180.0 / AUR_PI, published[k].degrees, 1e-3);
        assert_near(measured("min-angle", &group) * 180.0 / AUR_PI, published[k].nearest, 1e-6);
        release_points(&group);
    }
}

static void one_rotation_has_the_closed_forms(void **state) {
    (void)state;
    test_points one = rotations(1);
    one.coordinates[2] = -1.0;
    /* The quaternion and its opposite are 2 apart, and each from itself 0: 1 on average. */
    assert_near(measured("energy", &one), sqrt(64.0 / (15.0 * AUR_PI) - 1.0), 1e-15);
    assert_near(measured("covering", &one), AUR_PI, 0.0);
    assert_near(measured("riesz:1", &one), 0.0, 0.0);
    release_points(&one);
    test_points two = rotations(2);
    two.coordinates[0] = two.coordinates[4] = 1.0;
    assert_near(measured("min-angle", &two), 0.0, 0.0);
    assert_true(isinf(measured("riesz:1", &two)));
    two.coordinates[4] = two.coordinates[5] = sqrt(0.5); /* a quarter of a turn */
    const double near = sqrt(2.0 - sqrt(2.0)), far = sqrt(2.0 + sqrt(2.0));
    assert_near(measured("min-angle", &two), 0.5 * AUR_PI, 1e-15);
    assert_near(measured("riesz:1", &two), 2.0 * (1.0 / near + 1.0 / far), 1e-14);
    release_points(&two);
}

/* Random rotations have E^2 = (64/(15 pi) - 1)/N on average. */
static void random_rotations_have_the_mean_energy(void **state) {
    (void)state;
    enum { COUNT = 200, SEEDS = 40 };
    double mean = 0.0;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        test_points points = random_rotations(COUNT, seed);
        const double value = measured("energy", &points);
        mean += value * value / SEEDS;
        release_points(&points);
    }
    /* The sum of some ten squares of about equal strength: 30 % in one, 5 % in the mean of 40; four of those.
     */
    assert_relative(mean, (64.0 / (15.0 * AUR_PI) - 1.0) / COUNT, 0.2);
}

static void signs_and_equal_weights_do_not_matter(void **state) {
    (void)state;
    test_points some = random_rotations(300, 9), other = random_rotations(300, 9);
    other.weights = malloc(300 * sizeof(double));
    for (size_t i = 0; i < 300; ++i) {
        other.weights[i] = 0.5;
        for (size_t d = 0; d < 4 && i % 3 == 0; ++d)
            other.coordinates[4 * i + d] *= -1.0;
    }
    static const char *const metrics[] = {"energy", "riesz:1", "min-angle", "covering", "mesh-ratio"};
    for (size_t m = 0; m < sizeof metrics / sizeof metrics[0]; ++m)
        assert_relative(measured(metrics[m], &some), measured(metrics[m], &other), 1e-12);
    release_points(&some);
    release_points(&other);
}

/* No tested rotation is farther away than the covering radius, and one comes near it. */
static void the_covering_is_the_largest_hole(void **state) {
    (void)state;
    test_points some = random_rotations(100, 5), tried = random_rotations(40000, 6);
    const double covering = measured("covering", &some);
    double worst = 1.0;
    for (size_t t = 0; t < tried.count; ++t) {
        double best = 0.0;
        for (size_t i = 0; i < some.count; ++i) {
            double product = 0.0;
            for (size_t d = 0; d < 4; ++d)
                product += some.coordinates[4 * i + d] * tried.coordinates[4 * t + d];
            best = fmax(best, fabs(product));
        }
        worst = fmin(worst, best);
    }
    assert_true(2.0 * acos(worst) <= covering + 1e-12);
    assert_true(2.0 * acos(worst) > 0.9 * covering);
    release_points(&some);
    release_points(&tried);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_have_the_known_covering),
        cmocka_unit_test(one_rotation_has_the_closed_forms),
        cmocka_unit_test(random_rotations_have_the_mean_energy),
        cmocka_unit_test(signs_and_equal_weights_do_not_matter),
        cmocka_unit_test(the_covering_is_the_largest_hole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
