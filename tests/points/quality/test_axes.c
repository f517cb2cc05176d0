#include "check.h"

#include <float.h>

#include <string.h>

#include "sphere_sets.h"

static test_points axes(size_t count, const double *xyz) {
    test_points points = sphere_points(count);
    points.domain = AUR_DOMAIN_AXES;
    memcpy(points.coordinates, xyz, 3 * count * sizeof *xyz);
    return points;
}

static double measured(const char *metric, const test_points *points) {
    double value = NAN;
    aur_error error = {0};
    if (aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error) != AUR_OK)
        fail_msg("%s: %s", metric, error.message);
    return value;
}

static const double frame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* Three orthogonal axes are the six corners of the octahedron. Cells are cut from a square whose corners are
 * 1e6 away, so angles and areas of few points are good to 1e-10. */
static void a_frame_has_the_figures_of_the_octahedron(void **state) {
    (void)state;
    test_points three = axes(3, frame), six = octahedron();
    static const char *const metrics[] = {"energy", "scd", "cap", "covering", "voronoi-max", "mesh-ratio"};
    for (size_t m = 0; m < sizeof metrics / sizeof metrics[0]; ++m)
        assert_near(measured(metrics[m], &three), measured(metrics[m], &six), 1e-10);
    assert_near(measured("min-angle", &three), 0.5 * AUR_PI, 1e-15);
    assert_near(measured("min-distance", &three), sqrt(2.0), 1e-15);
    assert_near(measured("covering", &three), acos(1.0 / sqrt(3.0)), 1e-10);
    /* Six ordered pairs of axes, whose ends are 2^1/2 apart; no term of an axis with itself. */
    assert_near(measured("riesz:1", &three), 6.0 * 2.0 / sqrt(2.0), 1e-14);
    assert_near(measured("riesz:-1", &three), 6.0 * 2.0 * sqrt(2.0), 1e-14);
    assert_near(measured("riesz:0", &three), -6.0 * log(2.0), 1e-14);
    release_points(&three);
    release_points(&six);
}

static void the_ends_do_not_matter(void **state) {
    (void)state;
    test_points some = random_directions(50, 7), turned = random_directions(50, 7);
    some.domain = turned.domain = AUR_DOMAIN_AXES;
    some.weights = malloc(50 * sizeof(double));
    turned.weights = malloc(50 * sizeof(double));
    for (size_t i = 0; i < 50; ++i) {
        some.weights[i] = turned.weights[i] = 1.0 + 0.01 * (double)i;
        for (size_t d = 0; d < 3 && i % 3 == 0; ++d)
            turned.coordinates[3 * i + d] *= -1.0;
    }
    static const char *const metrics[] = {"energy",   "riesz:1",     "cap-bound",        "min-angle",
                                          "covering", "voronoi-min", "voronoi-deviation"};
    for (size_t m = 0; m < sizeof metrics / sizeof metrics[0]; ++m)
        assert_relative(measured(metrics[m], &some), measured(metrics[m], &turned), 1e-12);
    release_points(&some);
    release_points(&turned);
}

/* Axes in one plane leave its normal a right angle away, and so does a single axis. */
static void flat_axes_are_covered_at_a_right_angle(void **state) {
    (void)state;
    static const double flat[9] = {1, 0, 0, 0.6, 0.8, 0, 0, -1, 0};
    for (size_t count = 1; count <= 3; ++count) {
        test_points points = axes(count, flat);
        assert_near(measured("covering", &points), 0.5 * AUR_PI, DBL_EPSILON);
        assert_true(measured("energy", &points) > 0.0);
        release_points(&points);
    }
    test_points twice = axes(2, (const double[]){0, 0, 1, 0, 0, -1});
    assert_near(measured("min-angle", &twice), 0.0, 0.0);
    release_points(&twice);
}

static void tables_are_of_axes(void **state) {
    (void)state;
    test_points points = random_directions(400, 9);
    points.domain = AUR_DOMAIN_AXES;
    const aur_points_view view = seen(&points);
    aur_series *series;
    assert_int_equal(aur_measure_series("voronoi", &view, NULL, &series, NULL), AUR_OK);
    assert_int_equal(aur_series_row_count(series), 400);
    double area = 0.0;
    for (size_t i = 0; i < 400; ++i)
        area += aur_series_values(series)[4 * i + 1];
    assert_relative(area, 400.0, 1e-10);
    aur_series_destroy(series);
    /* Random axes have the power 1 at even degrees, (2l + 1) samples of chi^2 each: the mean over l = 2 .. 40
     * has a standard deviation of (2 / sum of 2l + 1)^1/2 = 0.05; and odd degrees vanish. */
    assert_int_equal(aur_measure_series("spectrum:40", &view, NULL, &series, NULL), AUR_OK);
    double power = 0.0, terms = 0.0;
    for (size_t l = 1; l <= 40; ++l) {
        const double value = aur_series_values(series)[2 * (l - 1) + 1];
        if (l % 2 == 1)
            assert_near(value, 0.0, 1e-20);
        power += l % 2 == 0 ? (2.0 * (double)l + 1.0) * value : 0.0;
        terms += l % 2 == 0 ? 2.0 * (double)l + 1.0 : 0.0;
    }
    assert_near(power / terms, 1.0, 0.2);
    aur_series_destroy(series);
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_has_the_figures_of_the_octahedron),
        cmocka_unit_test(the_ends_do_not_matter),
        cmocka_unit_test(flat_axes_are_covered_at_a_right_angle),
        cmocka_unit_test(tables_are_of_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
