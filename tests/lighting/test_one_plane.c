/* Facets in one plane: the first in the file wins. */
#include "lighting/viewfactors/facets.h"

#include <string.h>

#include "moved_mesh.h"
#include "points/base/random.h"
#include "points/base/text.h"
#include "render/scene/scene_data.h"

typedef struct triangle {
    double corners[3][2];
} triangle;

static bool contains(const triangle *t, const double point[2], double slack) {
    const double(*const c)[2] = t->corners;
    const double area = (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    for (int i = 0; i < 3; ++i) {
        const double *const a = c[i], *const b = c[(i + 1) % 3];
        const double side = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
        if (side * (area < 0.0 ? -1.0 : 1.0) < slack)
            return false;
    }
    return true;
}

static double dice(uint64_t seed, uint64_t number) {
    return aur_unit_double(aur_hash2(seed, number));
}

/* Brute force: every point of the plane that is not near an edge is covered once, by the first triangle that
 * contains it. */
static void check_plane(uint64_t seed, size_t count, const mesh_pose *pose, const char *digits) {
    enum { MOST = 24, POINTS = 400 };
    triangle triangles[MOST];
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.both_sides = true;
    mesh_file file;
    mesh_begin(&file, "plane");
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 6; ++k)
            triangles[i].corners[k / 2][k % 2] = 4.0 * dice(seed, 6 * i + k);
        if (i % 5 == 4) /* a copy, with a different order of corners */
            for (size_t k = 0; k < 3; ++k)
                memcpy(triangles[i].corners[k], triangles[i - 3].corners[(k + 1) % 3], 2 * sizeof(double));
        for (size_t c = 0; c < 3; ++c) {
            double p[3];
            for (int d = 0; d < 3; ++d)
                p[d] = pose->turn[d][0] * triangles[i].corners[c][0] +
                       pose->turn[d][1] * triangles[i].corners[c][1] + pose->offset[d];
            fprintf(file.stream, digits, p[0], p[1], p[2]);
        }
        fprintf(file.stream, "f %zu %zu %zu\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    aur_facets *const facets = mesh_load(&file, &options);
    const double *const origin = aur_scene_origin(facets->scene);
    size_t looked = 0;
    for (size_t n = 0; n < POINTS; ++n) {
        const double point[2] = {4.0 * dice(seed + 1, 2 * n), 4.0 * dice(seed + 1, 2 * n + 1)};
        size_t expected = SIZE_MAX;
        bool clear = true;
        for (size_t i = count; i-- > 0;) {
            if (contains(&triangles[i], point, 2e-4))
                expected = i;
            clear = clear && contains(&triangles[i], point, 2e-4) == contains(&triangles[i], point, -2e-4);
        }
        if (!clear)
            continue;
        ++looked;
        size_t found = 0, source = SIZE_MAX;
        for (size_t f = 0; f < facets->count; ++f) {
            triangle left = {0};
            for (size_t c = 0; c < 3; ++c)
                for (int axis = 0; axis < 2; ++axis)
                    for (int d = 0; d < 3; ++d)
                        left.corners[c][axis] +=
                            pose->turn[d][axis] * (facets->corners[f][c][d] + origin[d] - pose->offset[d]);
            if (contains(&left, point, 0.0)) {
                ++found;
                source = facets->sources[f];
            }
        }
        assert_int_equal(found, expected == SIZE_MAX ? 0 : 1);
        assert_int_equal(source, expected);
    }
    assert_true(looked > POINTS / 2);
    assert_int_equal(aur_facets_rows(facets), 2 * count);
    aur_facets_destroy(facets);
}

static void test_brute_force(void **state) {
    (void)state;
    static const char *const exact = "v %.17g %.17g %.17g\n", *const rounded = "v %.6f %.6f %.6f\n";
    for (uint64_t seed = 0; seed < 12; ++seed) {
        const double angle = seed % 3 == 0 ? 0.0 : 0.3 * (double)seed;
        const mesh_pose near = turned_pose(angle, 0.1, 0.2, -3),
                        far = turned_pose(angle, 500000.37, 5400000.11, 45.2);
        check_plane(seed, 2 + 2 * (seed % 12), &near, exact);
        check_plane(seed, 10, &near, rounded);
        check_plane(seed, 10, &far, exact);
        check_plane(seed, 10, &far, rounded);
    }
}

/* How many facets are cut of a square and one that comes later, moved by `height`, turned over or shifted. */
static size_t count_cut(double height, double shift, bool over, bool both_sides) {
    mesh_file file;
    mesh_begin(&file, "pair");
    mesh_polygon(&file, 4, (const double[4][3]){{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const double a[4][3] = {
        {shift, 0, height}, {1 + shift, 0, height}, {1 + shift, 1, height}, {shift, 1, height}};
    const double b[4][3] = {
        {shift, 0, height}, {shift, 1, height}, {1 + shift, 1, height}, {1 + shift, 0, height}};
    mesh_polygon(&file, 4, over ? b : a);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.both_sides = both_sides;
    aur_facets *const facets = mesh_load(&file, &options);
    const size_t count = facets->scene->overlap.count;
    double area = 0.0;
    for (size_t i = 0; i < facets->count; ++i)
        area += facets->areas[i];
    assert_near(area, count > 0 ? 2.0 - fmax(0.0, 1.0 - fabs(shift)) : 2.0, 1e-6);
    aur_facets_destroy(facets);
    return count;
}

static void test_rule(void **state) {
    (void)state;
    for (int over = 0; over < 2; ++over) {
        assert_int_equal(count_cut(0.0, 0.0, over, true), 2);
        assert_int_equal(count_cut(0.0, 0.25, over, true), 2);
        assert_int_equal(count_cut(0.0, 1.0, over, true), 0);        /* neighbours */
        assert_int_equal(count_cut(0.0, 1.0 - 1e-7, over, true), 0); /* but for rounding */
        assert_int_equal(count_cut(1e-6, 0.0, over, true), 0);       /* a rug */
        assert_int_equal(count_cut(-1e-6, 0.25, over, true), 0);
    }
    assert_int_equal(count_cut(0.0, 0.0, false, false), 2);
    assert_int_equal(count_cut(0.0, 0.0, true, false), 0);  /* a sheet */
    assert_int_equal(count_cut(1e-8, 0.0, true, true), 0);  /* a gap, which both sides face */
    assert_int_equal(count_cut(-1e-8, 0.0, true, true), 0); /* a thin plate: double-precision rays distinguish
                                                             * its sides */
    assert_int_equal(count_cut(1e-8, 0.0, false, true), 0);
}

/* Each side of a sheet sees what is in front of it, though rays hit either of its two facets. */
static void test_sheet(void **state) {
    (void)state;
    for (int shifted = 0; shifted < 2; ++shifted) {
        mesh_file file;
        mesh_begin(&file, "sheet");
        const double s = 0.25 * shifted;
        mesh_group(&file, "up");
        mesh_polygon(&file, 4, (const double[4][3]){{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        mesh_group(&file, "down");
        mesh_polygon(&file, 4, (const double[4][3]){{s, s, 0}, {s, 1, 0}, {1, 1, 0}, {1, s, 0}});
        mesh_group(&file, "above");
        mesh_polygon(&file, 4, (const double[4][3]){{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
        mesh_group(&file, "below");
        mesh_polygon(&file, 4, (const double[4][3]){{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}});
        aur_facets_options options = {.size = sizeof options};
        aur_facets_options_init(&options, NULL);
        options.group = true;
        aur_facets *const facets = mesh_load(&file, &options);
        aur_view_factors_options requested = {.size = sizeof requested};
        aur_view_factors_options_init(&requested, NULL);
        requested.rays = 1 << 16;
        requested.rays_only = true;
        aur_view_factors_matrix exact, m;
        aur_view_factors *const closed = factors_of(facets, NULL, &exact);
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        for (size_t i = 0; i < 4; ++i) {
            double width;
            const size_t k = i ^ 2;
            const double expected = factor_at(&exact, i, k, NULL), measured = factor_at(&m, i, k, &width);
            assert_true(expected > 0.1);
            assert_near(measured, expected, 3.0 * width); /* 6 standard errors and more */
        }
        assert_near(m.back[2], 0.0, 1e-12);
        aur_view_factors_destroy(closed);
        aur_view_factors_destroy(factors);
        aur_facets_destroy(facets);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_brute_force), cmocka_unit_test(test_rule),
                                       cmocka_unit_test(test_sheet)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
