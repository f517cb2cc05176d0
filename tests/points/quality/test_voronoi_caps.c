/* Voronoi cells within caps. */
#include "check.h"

#include <float.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "points/quality/measure.h"
#include "points/quality/sphere/voronoi.h"
#include "sphere_sets.h"

static test_points random_in_cap(size_t count, double degrees, uint64_t seed) {
    test_points points = sphere_points(count);
    const double half = sin(degrees * (AUR_PI / 360.0));
    for (size_t j = 0; j < count; ++j) {
        /* By half the polar angle, which preserves the digits of small caps. */
        const double sine = half * sqrt(aur_unit_double(aur_hash3(seed, j, 0)));
        const double phi = 2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, j, 1));
        const double r = 2.0 * sine * sqrt(1.0 - sine * sine);
        points.coordinates[3 * j] = r * cos(phi);
        points.coordinates[3 * j + 1] = r * sin(phi);
        points.coordinates[3 * j + 2] = 1.0 - 2.0 * sine * sine;
    }
    return points;
}

static aur_series *cells_of_cap(const test_points *points, double degrees, size_t threads) {
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    options.cap_degrees = degrees;
    options.threads = threads;
    aur_series *series;
    aur_error error = {0};
    if (aur_measure_series("voronoi", (const aur_points_view[]){seen(points)}, &options, &series, &error) !=
        AUR_OK)
        fail_msg("%s", error.message);
    return series;
}

/* Cells tile caps of every size, from a grain to nearly all of the sphere, with the same bits on any number
 * of threads. */
static void areas_of_caps_add_up(void **state) {
    (void)state;
    static const double caps[] = {1e-6, 1e-3, 0.5, 20.0, 34.0, 60.0, 89.9999, 90.0, 90.0001, 120.0, 179.0};
    for (size_t c = 0; c < sizeof caps / sizeof caps[0]; ++c) {
        test_points points = random_in_cap(300, caps[c], c);
        aur_series *const series = cells_of_cap(&points, caps[c], 1), *const other =
                                                                          cells_of_cap(&points, caps[c], 3);
        assert_memory_equal(aur_series_values(series), aur_series_values(other), 1200 * sizeof(double));
        double sum = 0.0;
        for (size_t i = 0; i < 300; ++i)
            sum += aur_series_values(series)[4 * i + 1];
        assert_relative(sum, 300.0, 1e-9);
        aur_series_destroy(series);
        aur_series_destroy(other);
        release_points(&points);
    }
}

/* Against a spiral of `samples` points in the cap, each assigned to its nearest point: areas to the spiral's
 * error along the cells' edges, radii to its covering radius. */
static void cells_of_caps_hold_what_is_nearest(void **state) {
    (void)state;
    enum { COUNT = 24, SAMPLES = 100000 };
    static const double caps[] = {5.0, 50.0, 90.0, 130.0};
    for (size_t c = 0; c < sizeof caps / sizeof caps[0]; ++c) {
        test_points points = random_in_cap(COUNT, caps[c], 7 + c);
        aur_series *const series = cells_of_cap(&points, caps[c], 1);
        double share[COUNT] = {0.0}, farthest[COUNT] = {0.0};
        const double half = sin(caps[c] * (AUR_PI / 360.0));
        for (size_t k = 0; k < SAMPLES; ++k) {
            const double z = 1.0 - 2.0 * half * half * ((double)k + 0.5) / SAMPLES,
                         r = sqrt((1.0 - z) * (1.0 + z));
            const double phi = 2.0 * AUR_PI * fmod(0.6180339887498949 * (double)k, 1.0);
            const double y[3] = {r * cos(phi), r * sin(phi), z};
            size_t nearest = 0;
            for (size_t i = 1; i < COUNT; ++i)
                if (aur_dot3(y, points.coordinates + 3 * i) > aur_dot3(y, points.coordinates + 3 * nearest))
                    nearest = i;
            share[nearest] += (double)COUNT / SAMPLES;
            farthest[nearest] =
                fmax(farthest[nearest], acos(fmin(aur_dot3(y, points.coordinates + 3 * nearest), 1.0)));
        }
        /* Twice the mean distance of the spiral's points: a cell's edge is off by no more. */
        const double spacing = 2.0 * half * sqrt(4.0 * AUR_PI / SAMPLES);
        for (size_t i = 0; i < COUNT; ++i) {
            const double *const row = aur_series_values(series) + 4 * i;
            assert_near(row[1], share[i], 0.01);
            assert_true(row[2] > farthest[i] - 1e-7 && row[2] < farthest[i] + spacing);
        }
        aur_series_destroy(series);
        release_points(&points);
    }
}

enum { WALK = 20000 };

/* The number of times that a walk around a circle enters the region where `there` is true. */
static size_t arcs_of(const bool *there) {
    size_t arcs = 0;
    for (size_t k = 0; k < WALK; ++k)
        arcs += there[k] && !there[k > 0 ? k - 1 : WALK - 1];
    return arcs == 0 && there[0] ? 1 : arcs;
}

static size_t nearest_of(const test_points *points, const double way[3]) {
    size_t best = 0;
    for (size_t i = 1; i < points->count; ++i)
        if (aur_dot3(way, points->coordinates + 3 * i) > aur_dot3(way, points->coordinates + 3 * best))
            best = i;
    return best;
}

/* Arcs of the cell of point i: along the rim, and along the great circles between it and other points. */
static size_t walked_sides(const test_points *points, double radians, size_t i) {
    static bool there[WALK];
    const double *const x = points->coordinates + 3 * i;
    for (size_t k = 0; k < WALK; ++k) {
        const double phi = 2.0 * AUR_PI * (double)k / WALK;
        const double way[3] = {sin(radians) * cos(phi), sin(radians) * sin(phi), cos(radians)};
        there[k] = nearest_of(points, way) == i;
    }
    size_t sides = arcs_of(there);
    for (size_t j = 0; j < points->count; ++j) {
        const double *const y = points->coordinates + 3 * j;
        double normal[3], first[3], second[3];
        if (j == i)
            continue;
        for (size_t d = 0; d < 3; ++d)
            normal[d] = x[d] - y[d];
        aur_normalize3(normal);
        aur_frame3(normal, first, second);
        for (size_t k = 0; k < WALK; ++k) {
            const double phi = 2.0 * AUR_PI * (double)k / WALK;
            double way[3];
            for (size_t d = 0; d < 3; ++d)
                way[d] = cos(phi) * first[d] + sin(phi) * second[d];
            const size_t nearest = nearest_of(points, way);
            there[k] = way[2] >= cos(radians) &&
                       (nearest == i || nearest == j ||
                        aur_dot3(way, points->coordinates + 3 * nearest) <= aur_dot3(way, x) + 1e-12);
        }
        sides += arcs_of(there);
    }
    return sides;
}

/* The number of sides of cells that a cap's rim cuts against walks around all circles. */
static void sides_of_caps_are_counted(void **state) {
    (void)state;
    static const double caps[] = {25.0, 60.0, 90.0, 130.0};
    for (size_t c = 0; c < sizeof caps / sizeof caps[0]; ++c) {
        test_points points = random_in_cap(16, caps[c], 70 + c);
        aur_series *const series = cells_of_cap(&points, caps[c], 1);
        for (size_t i = 0; i < points.count; ++i)
            assert_int_equal((int)aur_series_values(series)[4 * i + 3],
                             walked_sides(&points, caps[c] * (AUR_PI / 180.0), i));
        aur_series_destroy(series);
        release_points(&points);
    }
}

/* One point has all of its cap; a cap of 90 degrees is the hemisphere; measures without caps report that. */
static void caps_agree_with_known_values(void **state) {
    (void)state;
    test_points points = random_in_cap(200, 90.0, 1), one = octahedron();
    memcpy(one.coordinates, one.coordinates + 12, 3 * sizeof(double));
    one.count = 1;
    aur_series *series = cells_of_cap(&one, 40.0, 1);
    const double *const row = aur_series_values(series);
    assert_near(row[1], 1.0, 1e-14);
    assert_near(row[2], 40.0 * AUR_PI / 180.0, 1e-14);
    assert_true(row[3] == 1.0);
    aur_series_destroy(series);
    series = cells_of_cap(&points, 90.0, 1);
    points.domain = AUR_DOMAIN_HEMISPHERE;
    aur_series *whole = cells_of_cap(&points, 0.0, 1);
    assert_memory_equal(aur_series_values(series), aur_series_values(whole), 800 * sizeof(double));
    aur_series_destroy(series);
    aur_series_destroy(whole);
    static const struct {
        const char *metric, *text;
        double cap;
    } refused[] = {
        {"energy", "measure 'energy' is for the sphere, hemisphere, axes, rotations, not for caps", 90.0},
        {"covering", "above 0 and at most 90 degrees, not 91: wider ones are for the domain sphere", 91.0},
        {"covering", "above 0 and at most 90 degrees, not nan", NAN},
        {"covering", "degrees from +z, outside the cap of 10 degrees", 10.0}};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        aur_measure_options options = {.size = sizeof options};
        aur_measure_options_init(&options, NULL);
        options.cap_degrees = refused[i].cap;
        aur_error error = {0};
        double value;
        assert_int_not_equal(aur_measure(refused[i].metric, (const aur_points_view[]){seen(&points)},
                                         &options, &value, &error),
                             AUR_OK);
        if (strstr(error.message, refused[i].text) == NULL)
            fail_msg("%s", error.message);
    }
    release_points(&points);
    release_points(&one);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_of_caps_add_up), cmocka_unit_test(cells_of_caps_hold_what_is_nearest),
        cmocka_unit_test(caps_agree_with_known_values), cmocka_unit_test(sides_of_caps_are_counted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
