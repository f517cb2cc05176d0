#include "check.h"

#include <string.h>

#include "square_sets.h"

/* By the definition: for each t, every elementary interval, counted from its edges. Base 2, two dimensions.
 */
static double net_by_definition(const test_points *points) {
    int m = 0;
    while ((size_t)1 << m < points->count)
        ++m;
    for (int t = 0; t <= m; ++t) {
        int good = 1;
        for (int a = 0; a <= m - t; ++a) {
            const int b = m - t - a;
            for (int i = 0; i < 1 << a; ++i)
                for (int j = 0; j < 1 << b; ++j) {
                    int inside = 0;
                    for (size_t k = 0; k < points->count; ++k) {
                        const double x = points->coordinates[2 * k] * (1 << a);
                        const double y = points->coordinates[2 * k + 1] * (1 << b);
                        inside += x >= i && x < i + 1 && y >= j && y < j + 1;
                    }
                    good &= inside == 1 << t;
                }
        }
        if (good)
            return t;
    }
    return m;
}

static void known_nets_have_their_parameters(void **state) {
    (void)state;
    static const struct {
        const char *set, *metric;
        size_t count, dimension;
        aur_scramble scramble;
        double t;
    } cases[] = {{"hammersley", "net", 64, 2, AUR_SCRAMBLE_NONE, 0.0},
                 {"larcher-pillichshammer", "net", 256, 2, AUR_SCRAMBLE_NONE, 0.0},
                 {"larcher-pillichshammer", "net", 256, 2, AUR_SCRAMBLE_DIGIT, 0.0},
                 {"sobol", "net", 64, 2, AUR_SCRAMBLE_OWEN, 0.0},
                 {"sobol", "net:2", 64, 3, AUR_SCRAMBLE_NONE, 1.0},
                 {"faure:base=3", "net:3", 243, 3, AUR_SCRAMBLE_NONE, 0.0},
                 {"faure:base=5", "net:5", 125, 4, AUR_SCRAMBLE_NONE, 0.0},
                 {"hammersley", "net", 1, 2, AUR_SCRAMBLE_NONE, 0.0}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
        test_points points =
            scrambled_set(cases[c].set, cases[c].count, cases[c].dimension, cases[c].scramble);
        assert_near(measured(cases[c].metric, &points), cases[c].t, 0.0);
        release_points(&points);
    }
}

static void the_parameter_agrees_with_its_definition(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        test_points points = random_points((size_t)1 << (seed % 6), 2, seed);
        assert_near(measured("net", &points), net_by_definition(&points), 0.0);
        release_points(&points);
        /* A net with two points exchanged in one coordinate retains part of its strength. */
        points = scrambled_set("hammersley", 64, 2, AUR_SCRAMBLE_NONE);
        const size_t i = 2 * (seed % 63);
        const double y = points.coordinates[i + 1];
        points.coordinates[i + 1] = points.coordinates[i + 3];
        points.coordinates[i + 3] = y;
        assert_near(measured("net", &points), net_by_definition(&points), 0.0);
        release_points(&points);
    }
}

static void a_net_has_a_power_of_the_base(void **state) {
    (void)state;
    test_points points = random_points(100, 2, 1);
    double value = 0.0;
    aur_error error = {0};
    assert_int_equal(aur_measure("net", (const aur_points_view[]){seen(&points)}, NULL, &value, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "power"));
    assert_int_equal(aur_measure("net:2.5", (const aur_points_view[]){seen(&points)}, NULL, &value, &error),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_measure("net:10", (const aur_points_view[]){seen(&points)}, NULL, &value, &error),
                     AUR_OK);
    release_points(&points);
}

/* A bound never exceeds the exact value, and comes near it; in many dimensions it is at least that of a
 * projection. */
static void star_bounds_are_bounds(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        test_points points = random_points(20 + 5 * seed, 2, seed);
        const double exact = measured("star", &points);
        const double bound = measured("star-bound:1024", &points);
        assert_true(bound <= exact + 1e-14);
        assert_true(bound >= 0.98 * exact);
        release_points(&points);
    }
    test_points points = random_points(64, 5, 2);
    test_points plane = random_points(64, 2, 2);
    for (size_t i = 0; i < 64; ++i)
        for (size_t d = 0; d < 2; ++d)
            plane.coordinates[2 * i + d] = points.coordinates[5 * i + d];
    assert_true(measured("star-bound", &points) >= 0.9 * measured("star", &plane));
    assert_true(measured("star-bound", &points) <= 1.0);
    double values[2];
    for (size_t threads = 1; threads <= 2; ++threads) {
        const aur_measure_options options = {.size = sizeof options, .threads = threads};
        assert_int_equal(aur_measure("star-bound:100", (const aur_points_view[]){seen(&points)}, &options,
                                     &values[threads - 1], NULL),
                         AUR_OK);
    }
    assert_memory_equal(&values[0], &values[1], sizeof values[0]);
    release_points(&points);
    release_points(&plane);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_nets_have_their_parameters),
        cmocka_unit_test(the_parameter_agrees_with_its_definition),
        cmocka_unit_test(a_net_has_a_power_of_the_base),
        cmocka_unit_test(star_bounds_are_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
