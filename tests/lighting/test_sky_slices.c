/* Sky factors by half planes against closed forms with one polygon: it hides the sky, or is the only sky. */
#include <math.h>
#include <string.h>

#include "lighting/viewfactors/sky_slices.h"
#include "mesh_text.h"
#include "points/base/simd.h"

enum { SLICES = 512, RANDOMIZATIONS = 8 };

/* Cells of half planes have a bias of (1/128)^2 / 12 times the slope of a weight, which is 2 at most. */
static const double BIAS = 2e-5;

/* Turned about an axis that is none of the mesh's. */
static void turn(const double angle, const double from[3], double to[3]) {
    const double c = cos(angle), s = sin(angle);
    const double x = c * from[0] - s * from[1], y = s * from[0] + c * from[1];
    to[0] = c * x - s * from[2];
    to[1] = y;
    to[2] = s * x + c * from[2];
}

static void put(mesh_file *file, double angle, size_t count, const double (*corners)[3]) {
    double turned[8][3];
    for (size_t i = 0; i < count; ++i)
        turn(angle, corners[i], turned[i]);
    mesh_polygon(file, count, (const double(*)[3])turned);
}

static double *measure(const aur_facets *facets, size_t threads) {
    double *const sky = malloc(facets->patch_count * RANDOMIZATIONS * sizeof *sky);
    aur_sky_slices *slices;
    const aur_parallel_options parallel = {.threads = threads};
    assert_non_null(sky);
    assert_int_equal(aur_sky_slices_create(facets, "sobol", SLICES, RANDOMIZATIONS, 7, &slices, NULL),
                     AUR_OK);
    assert_int_equal(aur_sky_slices_measure(slices, &parallel, sky, NULL), AUR_OK);
    aur_sky_slices_destroy(slices);
    return sky;
}

/* The mean, and its error estimated from the randomisations: with Student's 7 degrees of freedom 9 such
 * errors are exceeded once in 20,000 numbers. */
static void check_sky(const double *sky, double exact) {
    double mean = 0.0, squares = 0.0;
    for (size_t r = 0; r < RANDOMIZATIONS; ++r)
        mean += sky[r] / RANDOMIZATIONS;
    for (size_t r = 0; r < RANDOMIZATIONS; ++r)
        squares += (sky[r] - mean) * (sky[r] - mean) / RANDOMIZATIONS;
    const double error = sqrt(squares / (RANDOMIZATIONS - 1));
    assert_true(error < 3e-3);
    assert_near(mean, exact, 9.0 * error + BIAS);
}

/* Each facet's sky factor, from its view factor to `other` (the visible sky, or its complement). */
static void check_facets(const aur_facets *facets, size_t count, const double (*other)[3], bool is_sky) {
    double *const sky = measure(facets, 1);
    for (size_t i = 0; i < facets->count; ++i) {
        double exact = 0.0;
        assert_int_equal(
            aur_view_factor_polygons(3, &facets->corners[i][0][0], count, &other[0][0], &exact, NULL),
            AUR_OK);
        check_sky(&sky[RANDOMIZATIONS * i], is_sky ? exact : 1.0 - exact);
    }
    free(sky);
}

/* A room without its lid: all that is seen through the opening is sky. Upright, and turned. */
static void test_open_room(void **state) {
    (void)state;
    static const double lid[4][3] = {{0, 0, 2}, {0, 3, 2}, {4, 3, 2}, {4, 0, 2}};
    static const double sides[5][4][3] = {{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
                                          {{0, 0, 0}, {0, 0, 2}, {4, 0, 2}, {4, 0, 0}},
                                          {{4, 0, 0}, {4, 0, 2}, {4, 3, 2}, {4, 3, 0}},
                                          {{4, 3, 0}, {4, 3, 2}, {0, 3, 2}, {0, 3, 0}},
                                          {{0, 3, 0}, {0, 3, 2}, {0, 0, 2}, {0, 0, 0}}};
    static const double angles[] = {0.0, 0.4, 1.5707963267948966, 2.5};
    for (size_t a = 0; a < sizeof angles / sizeof angles[0]; ++a) {
        mesh_file file;
        mesh_begin(&file, "open-room");
        for (size_t i = 0; i < 5; ++i)
            put(&file, angles[a], 4, sides[i]);
        double opening[4][3];
        for (size_t i = 0; i < 4; ++i)
            turn(angles[a], lid[i], opening[i]);
        aur_facets *const facets = mesh_load(&file, NULL);
        check_facets(facets, 4, (const double(*)[3])opening, true);
        aur_facets_destroy(facets);
    }
}

/* Ground below a plate in the air: in a half plane there is sky above and below the occluder. */
static void test_plate(void **state) {
    (void)state;
    static const double ground[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const double plate[4][3] = {
        {-0.3, -0.1, 0.5}, {-0.3, 0.8, 0.5}, {0.6, 0.8, 0.5}, {0.6, -0.1, 0.5}};
    for (size_t a = 0; a < 3; ++a) {
        mesh_file file;
        mesh_begin(&file, "plate");
        put(&file, 0.7 * (double)a, 4, ground);
        put(&file, 0.7 * (double)a, 4, plate);
        double turned[4][3];
        for (size_t i = 0; i < 4; ++i)
            turn(0.7 * (double)a, plate[i], turned[i]);
        aur_facets *const facets = mesh_load(&file, NULL);
        double *const sky = measure(facets, 1);
        for (size_t i = 0; i < 2; ++i) {
            double seen;
            assert_int_equal(
                aur_view_factor_polygons(3, &facets->corners[i][0][0], 4, &turned[0][0], &seen, NULL),
                AUR_OK);
            assert_true(seen > 0.05);
            check_sky(&sky[RANDOMIZATIONS * i], 1.0 - seen);
        }
        free(sky);
        aur_facets_destroy(facets);
    }
}

/* A grid of squares becomes one rectangle, and one with a hole covers the same area. */
static void test_merging(void **state) {
    (void)state;
    for (int hole = 0; hole < 2; ++hole) {
        mesh_file file;
        mesh_begin(&file, "grid");
        for (int x = 0; x < 8; ++x)
            for (int y = 0; y < 5; ++y)
                if (!hole || x != 3 || y != 2)
                    mesh_polygon(
                        &file, 4,
                        (const double[4][3]){{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
        aur_facets *const facets = mesh_load(&file, NULL);
        aur_merged_facet *merged;
        size_t count;
        assert_int_equal(aur_merge_facets(facets, &count, &merged, NULL), AUR_OK);
        assert_true(hole ? count <= 8 : count == 1);
        double area = 0.0;
        for (size_t i = 0; i < count; ++i) {
            aur_plane plane;
            area += aur_polygon_plane(merged[i].count, (const double(*)[3])merged[i].corners, &plane);
            assert_near(plane.normal[2], 1.0, 1e-12);
        }
        assert_near(area, hole ? 39.0 : 40.0, 1e-9);
        free(merged);
        aur_facets_destroy(facets);
    }
}

/* The same bits by every instruction set and on three threads. */
static void test_same_bits(void **state) {
    (void)state;
    mesh_file file;
    mesh_begin(&file, "towers");
    put(&file, 0.3, 4, (const double[4][3]){{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}});
    mesh_sphere(&file, (const double[3]){0.5, 0.2, 1.5}, 1.0, 6, 0.0, false);
    mesh_box(&file, "tower", (const double[3]){-3, -2, 0}, (const double[3]){-1, 1, 3}, false, false);
    aur_facets *const facets = mesh_load(&file, NULL);
    double *const expected = measure(facets, 1);
    static const char *const sets[] = {"portable", "avx2", "avx512"};
    const char *const before = getenv("AUREOLE_ISA");
    for (size_t i = 0; i < 3; ++i) {
        if (aur_isa_check(sets[i], NULL) != AUR_OK)
            continue;
        setenv("AUREOLE_ISA", sets[i], 1);
        aur_isa_reset();
        double *const found = measure(facets, 3);
        assert_memory_equal(found, expected, facets->patch_count * RANDOMIZATIONS * sizeof *found);
        free(found);
    }
    if (before != NULL)
        setenv("AUREOLE_ISA", before, 1);
    else
        unsetenv("AUREOLE_ISA");
    aur_isa_reset();
    free(expected);
    aur_facets_destroy(facets);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_open_room), cmocka_unit_test(test_plate),
                                       cmocka_unit_test(test_merging), cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
