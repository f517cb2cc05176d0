#include "check.h"

#include <stdio.h>
#include <string.h>

#include "sphere_sets.h"

static void the_table_is_consistent(void **state) {
    (void)state;
    for (size_t i = 0; i < aur_measure_count(); ++i) {
        const aur_measure_description *const row = aur_measure_at(i);
        assert_true(strlen(row->row.name) > 0 && strlen(row->row.summary) > 0 && strlen(row->domains) > 0 &&
                    strlen(row->row.source) > 0);
        const aur_measure_description *found = NULL;
        char name[64];
        snprintf(name, sizeof name, "%s%s", row->row.name,
                 row->parameter != NULL && row->parameter[0] == ':' ? ":1" : "");
        assert_int_equal(aur_measure_find(name, &found, NULL), AUR_OK);
        assert_ptr_equal(found, row);
    }
    assert_null(aur_measure_at(aur_measure_count()));
}

static void refused(const char *metric, const test_points *points, aur_result expected, const char *words) {
    double value = 0.0;
    aur_error error = {0};
    assert_int_equal(aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error),
                     expected);
    if (strstr(error.message, words) == NULL) {
        print_error("'%s' does not say '%s'\n", error.message, words);
        fail();
    }
}

static void bad_input_is_refused_with_the_reason(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(5, AUR_DOMAIN_SPHERE);
    refused("enrgy", &points, AUR_ERROR_NAME, "energy");
    refused("qqqqqqqqq", &points, AUR_ERROR_NAME, "qqqqqqqqq");
    refused("energy:2", &points, AUR_ERROR_ARGUMENT, "no parameter");
    refused("riesz", &points, AUR_ERROR_ARGUMENT, "riesz:S");
    refused("riesz:x", &points, AUR_ERROR_ARGUMENT, "not a number");
    refused("riesz:nan", &points, AUR_ERROR_ARGUMENT, "not a number");
    points.count = 1;
    refused("min-distance", &points, AUR_ERROR_ARGUMENT, "at least 2");
    points.count = 0;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "at least 1");
    points.count = 5;
    points.coordinates[7] = NAN;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "point 3");
    points.coordinates[7] = 2.0;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "point 3 has the length");
    release_points(&points);
    points = spherical_fibonacci(5, AUR_DOMAIN_SPHERE);
    points.domain = AUR_DOMAIN_HEMISPHERE;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "point 4 has z");
    points.domain = AUR_DOMAIN_SQUARE;
    points.dimension = 2;
    refused("energy", &points, AUR_ERROR_UNSUPPORTED, "sphere, hemisphere");
    points.domain = AUR_DOMAIN_SPHERE;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "2 coordinates");
    points.dimension = 3;
    double weights[5] = {1, 1, INFINITY, 1, 1};
    points.weights = weights;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "point 3 has a weight");
    for (size_t i = 0; i < 5; ++i)
        weights[i] = i == 0 ? 4.0 : -1.0;
    refused("energy", &points, AUR_ERROR_ARGUMENT, "add up to 0");
    points.weights = NULL;
    release_points(&points);
}

/* Points of seven digits are scaled to the sphere: the energy is right to their rounding, squared. */
static void nearly_unit_points_are_scaled(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(100, AUR_DOMAIN_SPHERE);
    double exact = 0.0, scaled = 0.0;
    assert_int_equal(aur_measure("energy", (const aur_points_view[]){seen(&points)}, NULL, &exact, NULL),
                     AUR_OK);
    for (size_t i = 0; i < 300; ++i)
        points.coordinates[i] *= 1.0 + 9e-7 * (double)(i / 3 % 3) - 9e-7;
    assert_int_equal(aur_measure("energy", (const aur_points_view[]){seen(&points)}, NULL, &scaled, NULL),
                     AUR_OK);
    assert_relative(scaled, exact, 1e-12);
    release_points(&points);
}

static int stop(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)user;
    assert_non_null(what);
    assert_true(done <= total);
    return 1;
}

static void work_can_be_cancelled(void **state) {
    (void)state;
    test_points points = random_directions(4000, 1);
    const aur_measure_options options = {.size = sizeof options, .progress = {stop, NULL}};
    double value = 0.0;
    aur_error error = {0};
    assert_int_equal(
        aur_measure("energy", (const aur_points_view[]){seen(&points)}, &options, &value, &error),
        AUR_ERROR_CANCELLED);
    assert_true(strlen(error.message) > 0);
    release_points(&points);
}

static void count_warning(void *user, const char *message) {
    (void)message;
    ++*(int *)user;
}

static void options_can_grow(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(5, AUR_DOMAIN_SPHERE);
    struct {
        aur_measure_options current;
        int option;
    } newer;
    memset(&newer, 0, sizeof newer);
    newer.current.size = sizeof newer;
    double value = 0.0;
    assert_int_equal(
        aur_measure("energy", (const aur_points_view[]){seen(&points)}, &newer.current, &value, NULL),
        AUR_OK);
    newer.option = 1;
    assert_int_equal(
        aur_measure("energy", (const aur_points_view[]){seen(&points)}, &newer.current, &value, NULL),
        AUR_ERROR_UNSUPPORTED);
    const aur_measure_options unset = {.size = 0};
    assert_int_equal(aur_measure("energy", (const aur_points_view[]){seen(&points)}, &unset, &value, NULL),
                     AUR_ERROR_ARGUMENT);
    aur_series *series;
    assert_int_equal(
        aur_measure_series("spectrum", (const aur_points_view[]){seen(&points)}, &unset, &series, NULL),
        AUR_ERROR_ARGUMENT);
    release_points(&points);
}

static void coincident_points_have_infinite_riesz_energy(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(5, AUR_DOMAIN_SPHERE);
    memcpy(points.coordinates, points.coordinates + 3, 3 * sizeof(double));
    int warnings = 0;
    const aur_measure_options options = {.size = sizeof options, .warnings = {count_warning, &warnings}};
    double value = 0.0;
    assert_int_equal(aur_measure("riesz:0", (const aur_points_view[]){seen(&points)}, &options, &value, NULL),
                     AUR_OK);
    assert_true(isinf(value) && value > 0.0);
    assert_int_equal(warnings, 1);
    assert_int_equal(
        aur_measure("riesz:-2", (const aur_points_view[]){seen(&points)}, &options, &value, NULL), AUR_OK);
    assert_true(isfinite(value));
    assert_int_equal(
        aur_measure("min-distance", (const aur_points_view[]){seen(&points)}, &options, &value, NULL),
        AUR_OK);
    assert_near(value, 0.0, 0.0);
    release_points(&points);
}

/* Points inside a caller's wider rows are measured as if they lay one after another. */
static void views_have_strides(void **state) {
    (void)state;
    enum { COUNT = 64, STRIDE = 5 };
    static const char *const of_the_sphere[] = {"energy",  "cap",      "min-distance", "wce:1.5",
                                                "riesz:1", "covering", "mesh-ratio",   "voronoi-max"};
    static const char *const of_the_square[] = {"star", "l2-star", "wraparound", "min-distance",
                                                "star-bound:50"};
    for (size_t flat = 0; flat < 2; ++flat) {
        const size_t dimension = flat ? 2 : 3;
        test_points points = random_directions(COUNT, 3);
        points.domain = flat ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_SPHERE;
        points.dimension = dimension;
        double wide[COUNT * STRIDE];
        for (size_t i = 0; i < COUNT * STRIDE; ++i)
            wide[i] = NAN;
        for (size_t i = 0; i < COUNT; ++i)
            for (size_t d = 0; d < dimension; ++d) {
                if (flat)
                    points.coordinates[i * dimension + d] = aur_unit_double(aur_hash3(2, i, d));
                wide[i * STRIDE + d] = points.coordinates[i * dimension + d];
            }
        aur_points_view view = aur_points_view_of(points.domain, COUNT, dimension, wide);
        view.stride = STRIDE;
        const char *const *const metrics = flat ? of_the_square : of_the_sphere;
        for (size_t m = 0; m < (flat ? 5 : 8); ++m) {
            double dense = 0.0, strided = 1.0;
            const aur_points_view same = seen(&points);
            assert_int_equal(aur_measure(metrics[m], &same, NULL, &dense, NULL), AUR_OK);
            assert_int_equal(aur_measure(metrics[m], &view, NULL, &strided, NULL), AUR_OK);
            assert_memory_equal(&dense, &strided, sizeof dense);
        }
        double value;
        view.stride = dimension - 1;
        assert_int_equal(aur_measure(metrics[0], &view, NULL, &value, NULL), AUR_ERROR_ARGUMENT);
        view.stride = STRIDE;
        view.size = 0;
        assert_int_equal(aur_measure(metrics[0], &view, NULL, &value, NULL), AUR_ERROR_ARGUMENT);
        release_points(&points);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_have_strides),
        cmocka_unit_test(the_table_is_consistent),
        cmocka_unit_test(bad_input_is_refused_with_the_reason),
        cmocka_unit_test(nearly_unit_points_are_scaled),
        cmocka_unit_test(work_can_be_cancelled),
        cmocka_unit_test(options_can_grow),
        cmocka_unit_test(coincident_points_have_infinite_riesz_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
