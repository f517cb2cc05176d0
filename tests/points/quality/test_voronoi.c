#include "check.h"

#include <float.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "points/quality/measure.h"
#include "points/quality/sphere/voronoi.h"
#include "sphere_sets.h"

static double measured(const char *metric, const test_points *points) {
    double value = NAN;
    aur_error error = {0};
    assert_int_equal(aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error),
                     AUR_OK);
    return value;
}

static void the_grid_finds_all_neighbours(void **state) {
    (void)state;
    test_points points = random_directions(700, 3);
    points.coordinates[0] = points.coordinates[1] = 0.0; /* a pole */
    points.coordinates[2] = 1.0;
    const aur_points_view view = seen(&points);
    aur_arena arena = {0};
    aur_sphere_grid grid;
    assert_int_equal(aur_sphere_grid_create(&view, AUR_PI, &arena, &grid, NULL), AUR_OK);
    aur_neighbours near = {0};
    for (size_t i = 0; i < points.count; i += 7) {
        const double angle = 0.01 * (double)(1 + i % 400);
        assert_int_equal(aur_sphere_grid_near(&grid, i, angle, &near), AUR_OK);
        size_t expected = 0;
        for (size_t j = 0; j < points.count; ++j) {
            double square = 0.0;
            for (size_t d = 0; d < 3; ++d) {
                const double apart = points.coordinates[3 * i + d] - points.coordinates[3 * j + d];
                square += apart * apart;
            }
            const double chord = angle < AUR_PI ? 2.0 * sin(0.5 * angle) : 3.0;
            expected += j != i && square <= chord * chord;
        }
        assert_int_equal(near.count, expected);
        for (size_t n = 1; n < near.count; ++n)
            assert_true(near.items[n - 1].square <= near.items[n].square);
    }
    free(near.items);
    aur_arena_release(&arena);
    release_points(&points);
}

static void regular_sets_have_regular_cells(void **state) {
    (void)state;
    test_points points = octahedron();
    assert_near(measured("covering", &points), acos(1.0 / sqrt(3.0)), 1e-9);
    assert_near(measured("mesh-ratio", &points), acos(1.0 / sqrt(3.0)) / (AUR_PI / 4.0), 1e-9);
    assert_near(measured("voronoi-min", &points), 1.0, 1e-9);
    assert_near(measured("voronoi-max", &points), 1.0, 1e-9);
    aur_series *series;
    assert_int_equal(
        aur_measure_series("voronoi", (const aur_points_view[]){seen(&points)}, NULL, &series, NULL), AUR_OK);
    assert_int_equal(aur_series_row_count(series), 6);
    assert_string_equal(aur_series_column(series, 3), "sides");
    for (size_t i = 0; i < 6; ++i)
        assert_near(aur_series_values(series)[4 * i + 3], 4.0, 0.0);
    aur_series_destroy(series);
    /* A corner of the octahedron twice: the two share a cell. */
    points.coordinates = realloc(points.coordinates, 21 * sizeof(double));
    memcpy(points.coordinates + 18, points.coordinates, 3 * sizeof(double));
    points.count = 7;
    assert_near(measured("voronoi-min", &points), 7.0 / 12.0, 1e-9);
    assert_near(measured("voronoi-max", &points), 7.0 / 6.0, 1e-9);
    release_points(&points);
}

/* Cells tile the sphere, or the hemisphere. */
static void areas_add_up(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 4; ++seed) {
        test_points points = random_directions(300, seed);
        if (seed % 2 == 1) {
            points.domain = AUR_DOMAIN_HEMISPHERE;
            for (size_t i = 0; i < points.count; ++i)
                points.coordinates[3 * i + 2] = fabs(points.coordinates[3 * i + 2]);
        }
        aur_series *series;
        assert_int_equal(
            aur_measure_series("voronoi", (const aur_points_view[]){seen(&points)}, NULL, &series, NULL),
            AUR_OK);
        double sum = 0.0;
        for (size_t i = 0; i < aur_series_row_count(series); ++i)
            sum += aur_series_values(series)[4 * i + 1];
        assert_relative(sum, (double)points.count, 1e-9);
        aur_series_destroy(series);
        release_points(&points);
    }
}

/* The least and greatest area and the standard deviation, by the table of all areas. */
static void figures_are_those_of_the_table(void **state) {
    (void)state;
    test_points points = random_directions(50, 9);
    aur_series *series;
    assert_int_equal(
        aur_measure_series("voronoi", (const aur_points_view[]){seen(&points)}, NULL, &series, NULL), AUR_OK);
    double least = INFINITY, greatest = 0.0, squares = 0.0, farthest = 0.0;
    for (size_t i = 0; i < points.count; ++i) {
        const double *const row = aur_series_values(series) + 4 * i;
        least = fmin(least, row[1]);
        greatest = fmax(greatest, row[1]);
        squares += (row[1] - 1.0) * (row[1] - 1.0);
        farthest = fmax(farthest, row[2]);
    }
    assert_near(measured("voronoi-min", &points), least, 1e-12);
    assert_near(measured("voronoi-max", &points), greatest, 1e-12);
    assert_relative(measured("voronoi-deviation", &points), sqrt(squares / 50.0), 1e-12);
    assert_near(measured("covering", &points), farthest, 1e-12);
    aur_series_destroy(series);
    release_points(&points);
}

/* Twice the area of the flat triangle, with the sign of its sense of turning as seen from outside. */
static double turn(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* A corner is computed from two great circles: it is off by their rounding over the sine of their angle. */
static const double corner_error = 1e-12;

/* No point is nearer to a corner than the cell's own, and two others are as near; the corners turn
 * counter-clockwise about the point, and the triangles between make the cell's area. */
static void check_corners(const test_points *points, aur_domain domain, size_t threads) {
    aur_points_view view = seen(points);
    view.domain = domain;
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    options.threads = threads;
    aur_series *cells, *corners;
    assert_int_equal(aur_measure_series("voronoi", &view, &options, &cells, NULL), AUR_OK);
    assert_int_equal(aur_measure_series("voronoi-cells", &view, &options, &corners, NULL), AUR_OK);
    const double *const figures = aur_series_values(cells), *row = aur_series_values(corners);
    const double mean = (domain == AUR_DOMAIN_SPHERE ? 4.0 : 2.0) * AUR_PI / (double)points->count;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const x = points->coordinates + 3 * i;
        const size_t sides = (size_t)figures[4 * i + 3];
        double area = 0.0;
        for (size_t k = 0; k < sides; ++k) {
            const double *const corner = row + 4 * k + 1, *const next = row + 4 * ((k + 1) % sides) + 1;
            assert_true(row[4 * k] == (double)(i + 1));
            const double to_center = aur_dot3(corner, x);
            size_t as_near = domain == AUR_DOMAIN_HEMISPHERE && fabs(corner[2]) < corner_error;
            for (size_t j = 0; j < points->count; ++j) {
                const double other = aur_dot3(corner, points->coordinates + 3 * j);
                const double near = domain == AUR_DOMAIN_AXES ? fabs(other) : other;
                assert_true(near < to_center + corner_error);
                as_near += j != i && near > to_center - corner_error;
            }
            assert_true(as_near >= 2);
            assert_true(turn(x, corner, next) > -corner_error);
            area += 2.0 * atan2(turn(x, corner, next),
                                1.0 + to_center + aur_dot3(next, x) + aur_dot3(corner, next));
        }
        assert_relative(area, figures[4 * i + 1] * mean, corner_error);
        row += 4 * sides;
    }
    assert_true(row == aur_series_values(corners) + 4 * aur_series_row_count(corners));
    aur_series_destroy(cells);
    aur_series_destroy(corners);
}

static void corners_are_as_far_from_three_points(void **state) {
    (void)state;
    test_points points = random_directions(300, 5);
    check_corners(&points, AUR_DOMAIN_SPHERE, 1);
    check_corners(&points, AUR_DOMAIN_SPHERE, 3);
    check_corners(&points, AUR_DOMAIN_AXES, 1);
    for (size_t i = 0; i < points.count; ++i)
        points.coordinates[3 * i + 2] = fabs(points.coordinates[3 * i + 2]);
    check_corners(&points, AUR_DOMAIN_HEMISPHERE, 1);
    points.count = 3;
    aur_series *corners;
    assert_int_equal(
        aur_measure_series("voronoi-cells", (const aur_points_view[]){seen(&points)}, NULL, &corners, NULL),
        AUR_ERROR_UNSUPPORTED);
    release_points(&points);
}

/* The covering radius against circumcentres of all triples: those of empty caps are the corners of the cells.
 */
static void covering_agrees_with_all_triples(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        test_points points = random_directions(4 + 3 * seed, seed);
        const double *const x = points.coordinates;
        double best = 1.0;
        for (size_t i = 0; i < points.count; ++i)
            for (size_t j = 0; j < i; ++j)
                for (size_t k = 0; k < j; ++k) {
                    double p[3], q[3];
                    for (size_t d = 0; d < 3; ++d) {
                        p[d] = x[3 * j + d] - x[3 * i + d];
                        q[d] = x[3 * k + d] - x[3 * i + d];
                    }
                    double w[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                                   p[0] * q[1] - p[1] * q[0]};
                    const double length = sqrt(aur_dot3(w, w));
                    for (int side = 0; side < 2; ++side) {
                        for (size_t d = 0; d < 3; ++d)
                            w[d] /= side == 0 ? length : -1.0;
                        const double height = aur_dot3(w, x + 3 * i);
                        int empty = 1;
                        for (size_t m = 0; m < points.count; ++m)
                            empty &= aur_dot3(w, x + 3 * m) <= height + 1e-12;
                        if (empty)
                            best = fmin(best, height);
                    }
                }
        assert_near(measured("covering", &points), acos(best), 1e-8);
        release_points(&points);
    }
}

/* One point, two points, and points of one hemisphere only. */
static void covering_beyond_ninety_degrees(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(200, AUR_DOMAIN_HEMISPHERE);
    points.domain = AUR_DOMAIN_SPHERE;
    for (size_t i = 0; i < points.count; ++i) /* all within a cap of 60 degrees, the rim at z = 1/2 + 1/800 */
        set_direction(&points, i, 0.5 + 0.5 * points.coordinates[3 * i + 2],
                      atan2(points.coordinates[3 * i + 1], points.coordinates[3 * i]));
    const double covering = measured("covering", &points);
    assert_true(covering > AUR_PI - acos(0.5) && covering < AUR_PI - acos(0.5) + 0.05);
    points.count = 1;
    assert_near(measured("covering", &points), AUR_PI, 1e-7);
    points.count = 2;
    const double angle = acos(aur_dot3(points.coordinates, points.coordinates + 3));
    assert_near(measured("covering", &points), AUR_PI - 0.5 * angle, 1e-9);
    assert_near(measured("voronoi-min", &points), 1.0, 1e-15);
    assert_near(measured("voronoi-max", &points), 1.0, 1e-15);
    release_points(&points);
}

/* Sides of every cell, of `of` different counts at most, and the areas' sum. */
static void check_sides(const test_points *points, size_t least, size_t most) {
    const aur_points_view view = seen(points);
    aur_series *cells;
    assert_int_equal(aur_measure_series("voronoi", &view, NULL, &cells, NULL), AUR_OK);
    double sum = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const row = aur_series_values(cells) + 4 * i;
        sum += row[1];
        assert_in_range(row[3], least, most);
    }
    assert_relative(sum, (double)points->count, 1e-12);
    aur_series_destroy(cells);
}

static void rotate(test_points *points, double a, double b) {
    for (size_t i = 0; i < points->count; ++i) {
        double *const p = points->coordinates + 3 * i;
        const double x = p[0] * cos(a) - p[1] * sin(a), y = p[0] * sin(a) + p[1] * cos(a);
        p[0] = x;
        p[1] = y * cos(b) - p[2] * sin(b);
        p[2] = y * sin(b) + p[2] * cos(b);
        const double length = sqrt(aur_dot3(p, p));
        for (size_t d = 0; d < 3; ++d)
            p[d] /= length;
    }
}

/* Each point twice, at one position or a few roundings apart: pairs share their cells. */
static void doubled_points_share_their_cells(void **state) {
    (void)state;
    test_points once = random_directions(40, 12), twice = sphere_points(80);
    for (size_t shift = 0; shift < 3; ++shift) {
        for (size_t i = 0; i < 240; ++i)
            twice.coordinates[i] =
                once.coordinates[i % 120] * (i < 120 ? 1.0 : 1.0 + (double)shift * DBL_EPSILON);
        for (size_t count = 41; count <= 80; count += 13) {
            aur_series *cells, *single;
            const aur_points_view view = seen(&once);
            aur_points_view more = seen(&twice);
            more.count = count;
            assert_int_equal(aur_measure_series("voronoi", &view, NULL, &single, NULL), AUR_OK);
            assert_int_equal(aur_measure_series("voronoi", &more, NULL, &cells, NULL), AUR_OK);
            const double *const a = aur_series_values(single), *const b = aur_series_values(cells);
            for (size_t i = 0; i < count; ++i) {
                const double share = i % 40 < count - 40 ? 0.5 : 1.0;
                assert_relative(b[4 * i + 1] / (double)count, share * a[4 * (i % 40) + 1] / 40.0, 1e-12);
            }
            aur_series_destroy(single);
            aur_series_destroy(cells);
        }
    }
    for (size_t i = 0; i < 9; ++i) /* all but one at one position */
        twice.coordinates[i] = i == 0 || i == 4 || i == 7 ? 1.0 : 0.0;
    twice.count = 3;
    aur_series *cells;
    const aur_points_view view = seen(&twice);
    assert_int_equal(aur_measure_series("voronoi", &view, NULL, &cells, NULL), AUR_OK);
    static const double shares[] = {1.5, 0.75, 0.75};
    for (size_t i = 0; i < 3; ++i)
        assert_relative(aur_series_values(cells)[4 * i + 1], shares[i], 1e-15);
    aur_series_destroy(cells);
    release_points(&once);
    release_points(&twice);
}

/* Where more than three points are as far from a corner, it is one corner: cells of the corners of a cube are
 * triangles, those of an octahedron's, and of rings above each other, quadrilaterals. */
static void symmetric_sets_have_their_sides(void **state) {
    (void)state;
    for (uint64_t turn_index = 0; turn_index < 8; ++turn_index) {
        const double a = 0.37 * (double)turn_index, b = 0.71 * (double)turn_index;
        test_points cube = sphere_points(8);
        for (size_t i = 0; i < 24; ++i)
            cube.coordinates[i] = (i / 3 >> i % 3 & 1 ? 1.0 : -1.0) / sqrt(3.0);
        rotate(&cube, a, b);
        check_sides(&cube, 3, 3);
        test_points six = octahedron();
        rotate(&six, a, b);
        check_sides(&six, 4, 4);
        enum { RINGS = 9, RING = 16 };
        test_points rings = sphere_points(RINGS * RING);
        for (size_t i = 0; i < RINGS * RING; ++i)
            set_direction(&rings, i, cos(AUR_PI * ((double)(i / RING) + 0.5) / RINGS),
                          2.0 * AUR_PI * (double)(i % RING) / RING);
        rotate(&rings, a, b);
        check_sides(&rings, 3, 4);
        test_points circle = sphere_points(7); /* cells are lunes */
        for (size_t i = 0; i < 7; ++i)
            set_direction(&circle, i, 0.0, 2.0 * AUR_PI * (double)(3 * i % 7) / 7.0);
        rotate(&circle, a, b);
        check_sides(&circle, 2, 2);
        release_points(&cube);
        release_points(&six);
        release_points(&rings);
        release_points(&circle);
    }
    test_points one = octahedron();
    one.count = 1;
    check_sides(&one, 0, 0);
    one.count = 2; /* opposite each other */
    check_sides(&one, 1, 1);
    release_points(&one);
}

/* Cells of points of one hemisphere reach beyond 90 degrees. Areas against counts of random directions: five
 * standard deviations, a false alarm in two million a cell. */
static void sets_of_one_hemisphere_have_cells(void **state) {
    (void)state;
    enum { COUNT = 12, TRIALS = 200000 };
    for (uint64_t seed = 0; seed < 6; ++seed) {
        test_points points = random_directions(COUNT, 40 + seed);
        for (size_t i = 0; i < COUNT; ++i)
            set_direction(&points, i, 0.1 + 0.8 * fabs(points.coordinates[3 * i + 2]),
                          0.5 * (double)i + (double)seed);
        const aur_points_view view = seen(&points);
        aur_series *cells;
        assert_int_equal(aur_measure_series("voronoi", &view, NULL, &cells, NULL), AUR_OK);
        size_t hits[COUNT] = {0};
        double farthest[COUNT] = {0.0};
        for (size_t t = 0; t < TRIALS; ++t) {
            const double z = 1.0 - 2.0 * aur_unit_double(aur_hash3(seed, t, 5)), r = sqrt(1.0 - z * z);
            const double phi = 2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, t, 6));
            const double way[3] = {r * cos(phi), r * sin(phi), z};
            size_t best = 0;
            for (size_t i = 1; i < COUNT; ++i)
                if (aur_dot3(way, points.coordinates + 3 * i) > aur_dot3(way, points.coordinates + 3 * best))
                    best = i;
            ++hits[best];
            farthest[best] = fmax(farthest[best], acos(aur_dot3(way, points.coordinates + 3 * best)));
        }
        double sum = 0.0;
        for (size_t i = 0; i < COUNT; ++i) {
            const double *const row = aur_series_values(cells) + 4 * i;
            const double share = row[1] / COUNT;
            sum += share;
            assert_near((double)hits[i], share * TRIALS, 5.0 * sqrt(share * (1.0 - share) * TRIALS));
            assert_true(farthest[i] <= row[2] + 1e-12 && farthest[i] > row[2] - 0.2);
        }
        assert_relative(sum, 1.0, 1e-13);
        aur_series_destroy(cells);
        check_corners(&points, AUR_DOMAIN_SPHERE, 1);
        release_points(&points);
    }
}

static void smallest_distance_agrees_with_all_pairs(void **state) {
    (void)state;
    for (size_t dimension = 1; dimension < 5; ++dimension) {
        const size_t count = 200;
        test_points points = {.domain = AUR_DOMAIN_CUBE,
                              .count = count,
                              .dimension = dimension,
                              .coordinates = malloc(count * dimension * sizeof(double))};
        for (size_t i = 0; i < count * dimension; ++i)
            points.coordinates[i] = aur_unit_double(aur_hash2(dimension, i));
        double best = 1e9;
        for (size_t i = 0; i < count; ++i)
            for (size_t j = 0; j < i; ++j) {
                double square = 0.0;
                for (size_t d = 0; d < dimension; ++d) {
                    const double apart =
                        points.coordinates[i * dimension + d] - points.coordinates[j * dimension + d];
                    square += apart * apart;
                }
                best = fmin(best, square);
            }
        double found = 0.0;
        const aur_points_view view = seen(&points);
        aur_arena arena = {0};
        const aur_measure_request request = {.points = &view, .arena = &arena};
        assert_int_equal(aur_smallest_distance(&request, &found, NULL), AUR_OK);
        aur_arena_release(&arena);
        assert_near(found, sqrt(best), 1e-15);
        release_points(&points);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_grid_finds_all_neighbours),
                                       cmocka_unit_test(regular_sets_have_regular_cells),
                                       cmocka_unit_test(areas_add_up),
                                       cmocka_unit_test(figures_are_those_of_the_table),
                                       cmocka_unit_test(corners_are_as_far_from_three_points),
                                       cmocka_unit_test(covering_agrees_with_all_triples),
                                       cmocka_unit_test(covering_beyond_ninety_degrees),
                                       cmocka_unit_test(doubled_points_share_their_cells),
                                       cmocka_unit_test(symmetric_sets_have_their_sides),
                                       cmocka_unit_test(sets_of_one_hemisphere_have_cells),
                                       cmocka_unit_test(smallest_distance_agrees_with_all_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
