/* The position of a mesh changes nothing: factors, sky, radiosities, areas and files. */
#include <aureole/statistics.h>
#include <string.h>

#include "lighting/viewfactors/covers.h"
#include "moved_mesh.h"
#include "points/base/text.h"

static const double offsets[][3] = {
    {1e5, 1e5, 0}, {2600000, 1200000, 450.25}, {500000.37, 5400000.11, 45.2}, {1e7, 1e7, 1e7}};
enum { OFFSETS = sizeof offsets / sizeof offsets[0], SEEDS = 32 };

/* A table in a room, and two blocks at a street in strips. */
static aur_facets *load_room(const double offset[3], bool group) {
    const mesh_pose pose = move_to(offset[0], offset[1], offset[2]);
    mesh_file file;
    mesh_begin(&file, "place-room");
    moved_box(&file, &pose, "room", (double[3]){0, 0, 0}, (double[3]){4, 3, 2.5}, true);
    moved_box(&file, &pose, "table", (double[3]){1, 1.2, 0.7}, (double[3]){2.2, 2, 0.72}, false);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = group;
    return mesh_load(&file, &options);
}

static aur_facets *load_street(const double offset[3], bool both_sides) {
    const mesh_pose pose = move_to(offset[0], offset[1], offset[2]);
    mesh_file file;
    mesh_begin(&file, "place-street");
    for (int i = 0; i < 3; ++i) {
        fprintf(file.stream, "g strip%d\n", i);
        moved_polygon(
            &file, &pose, 4,
            (const double[4][3]){
                {2.0 * i - 3, -20, 0}, {2.0 * i - 1, -20, 0}, {2.0 * i - 1, 20, 0}, {2.0 * i - 3, 20, 0}});
    }
    moved_box(&file, &pose, "west", (double[3]){-13, -20, 0}, (double[3]){-3, 20, 10}, false);
    moved_box(&file, &pose, "east", (double[3]){3, -20, 0}, (double[3]){13, 20, 14}, false);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = true;
    options.both_sides = both_sides;
    return mesh_load(&file, &options);
}

static aur_view_factors_options target_of(uint64_t seed, bool rays_only) {
    aur_view_factors_options requested = {.size = sizeof requested};
    aur_view_factors_options_init(&requested, NULL);
    requested.rays = 256;
    requested.half_planes = 64;
    requested.seed = seed;
    requested.rays_only = rays_only;
    requested.threads = 1;
    return requested;
}

/* Numbers of many seeds; those of all positions are compared with those of the first one. */
typedef struct sample {
    size_t count;
    double *sums, *squares;
} sample;

static sample new_sample(size_t count) {
    sample s = {count, calloc(count, sizeof(double)), calloc(count, sizeof(double))};
    assert_non_null(s.sums);
    assert_non_null(s.squares);
    return s;
}

static void add(sample *s, size_t at, double value) {
    s->sums[at] += value;
    s->squares[at] += value * value;
}

/* Student's two-sample test of each number, at a rate of 1e-6 for all of them together: a test of 32 and 32
 * numbers has 62 degrees of freedom. Numbers without variance must be equal but for rounding. */
static void compare(const sample *a, const sample *b, double rounding) {
    const double limit = aur_student_quantile(2 * SEEDS - 2, 1.0 - 0.5e-6 / (double)(a->count + 1));
    for (size_t i = 0; i < a->count; ++i) {
        const double mean[2] = {a->sums[i] / SEEDS, b->sums[i] / SEEDS};
        const double variance[2] = {a->squares[i] / SEEDS - mean[0] * mean[0],
                                    b->squares[i] / SEEDS - mean[1] * mean[1]};
        const double error = sqrt(fmax(0.0, variance[0] + variance[1]) / (SEEDS - 1));
        assert_near(mean[1], mean[0], rounding + limit * error);
    }
}

static void add_factors(sample *s, const aur_facets *facets, uint64_t seed, bool rays_only, double *exact) {
    const aur_view_factors_options requested = target_of(seed, rays_only);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, &requested, &m);
    check_physics(&m);
    for (size_t i = 0; i < m.rows; ++i) {
        for (size_t k = 0; k < m.rows; ++k) {
            double width;
            add(s, m.rows * i + k, factor_at(&m, i, k, &width));
            if (exact != NULL)
                exact[m.rows * i + k] = width == 0.0 ? factor_at(&m, i, k, NULL) : -1.0;
        }
        add(s, m.rows * m.rows + i, m.sky[i]);
        add(s, m.rows * m.rows + m.rows + i, m.back[i]);
    }
    aur_view_factors_destroy(factors);
}

static void check_factors(aur_facets *(*load)(const double *, bool), bool flag, bool rays_only) {
    aur_facets *const here = load((const double[3]){0, 0, 0}, flag);
    const size_t rows = aur_facets_rows(here), numbers = rows * rows + 2 * rows;
    double *const exact = malloc(2 * rows * rows * sizeof *exact);
    assert_non_null(exact);
    sample first = new_sample(numbers);
    for (uint64_t seed = 0; seed < SEEDS; ++seed)
        add_factors(&first, here, seed, rays_only, exact);
    for (size_t p = 0; p < OFFSETS; ++p) {
        aur_facets *const there = load(offsets[p], flag);
        const mesh_pose pose = move_to(offsets[p][0], offsets[p][1], offsets[p][2]);
        const double rounding = 16.0 * pose_rounding(&pose);
        sample other = new_sample(numbers);
        for (uint64_t seed = 0; seed < SEEDS; ++seed)
            add_factors(&other, there, 1000 * (p + 1) + seed, rays_only, exact + rows * rows);
        compare(&first, &other, 1e-7 + rounding);
        for (size_t i = 0; i < rows; ++i) /* areas of a few hundred, closed forms */
            assert_near(aur_facets_areas(there)[i], aur_facets_areas(here)[i], 1000.0 * rounding);
        size_t closed = 0;
        for (size_t i = 0; i < rows * rows; ++i)
            if (exact[i] > 0.0 && exact[rows * rows + i] > 0.0) {
                assert_near(exact[rows * rows + i], exact[i], 1e-12 + rounding);
                ++closed;
            }
        assert_true(rays_only || closed > rows);
        free(other.sums);
        free(other.squares);
        aur_facets_destroy(there);
    }
    free(exact);
    free(first.sums);
    free(first.squares);
    aur_facets_destroy(here);
}

static void test_room(void **state) {
    (void)state;
    check_factors(load_room, true, false);
    check_factors(load_room, true, true);
}

static void test_street(void **state) {
    (void)state;
    check_factors(load_street, false, false);
    check_factors(load_street, true, false);
    check_factors(load_street, false, true);
}

static void add_radiosities(sample *s, const aur_facets *facets, uint64_t seed, bool matrix, bool sun) {
    const size_t rows = aur_facets_rows(facets);
    const aur_view_factors_options requested = target_of(seed, false);
    aur_facets_light light = {.size = sizeof light};
    aur_facets_light_init(&light, NULL);
    light.reflectance = 0.3;
    light.sky = 1.0;
    for (int d = 0; sun && d < 3; ++d)
        light.sun[d] = d + 0.5;
    double *const found = malloc(2 * rows * sizeof *found);
    assert_non_null(found);
    aur_view_factors *factors = NULL;
    if (matrix)
        assert_int_equal(aur_view_factors_create(facets, &requested, &factors, NULL), AUR_OK);
    assert_int_equal(
        aur_view_factors_radiosity(facets, factors, &requested, &light, found, NULL, found + rows, NULL),
        AUR_OK);
    for (size_t i = 0; i < 2 * rows; ++i)
        add(s, i, found[i]);
    aur_view_factors_destroy(factors);
    free(found);
}

static void test_radiosities(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; ++kind) {
        aur_facets *const here = load_street((const double[3]){0, 0, 0}, false);
        sample first = new_sample(2 * aur_facets_rows(here));
        for (uint64_t seed = 0; seed < SEEDS; ++seed)
            add_radiosities(&first, here, seed, kind % 2 == 0, kind >= 2);
        for (size_t p = 0; p < OFFSETS; ++p) {
            aur_facets *const there = load_street(offsets[p], false);
            sample other = new_sample(first.count);
            for (uint64_t seed = 0; seed < SEEDS; ++seed)
                add_radiosities(&other, there, 1000 * (p + 1) + seed, kind % 2 == 0, kind >= 2);
            compare(&first, &other, 1e-7);
            free(other.sums);
            free(other.squares);
            aur_facets_destroy(there);
        }
        free(first.sums);
        free(first.squares);
        aur_facets_destroy(here);
    }
}

/* Intervals have their stated coverage there: see test_intervals of test_view_factors.c. */
static void test_coverage(void **state) {
    (void)state;
    const double *const offset = offsets[2];
    aur_facets *const facets = load_room(offset, true);
    aur_view_factors_options many = target_of(77, false);
    many.rays = 1 << 18;
    many.threads = 0;
    aur_view_factors_matrix reference_matrix, m;
    aur_view_factors *const reference = factors_of(facets, &many, &reference_matrix);
    size_t held = 0, all = 0;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        const aur_view_factors_options requested = target_of(seed, true);
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        for (size_t i = 0; i < m.rows; ++i)
            for (size_t k = 0; k < i; ++k) {
                double width, expected_width;
                const double measured = factor_at(&m, i, k, &width);
                const double expected = factor_at(&reference_matrix, i, k, &expected_width);
                if (expected < 0.02)
                    continue; /* a few rays of 256 */
                held += fabs(measured - expected) <= width + expected_width;
                ++all;
            }
        aur_view_factors_destroy(factors);
    }
    print_message("%zu of %zu intervals hold the factor\n", held, all);
    assert_true((double)held >= 0.91 * (double)all && (double)held <= 0.99 * (double)all);
    aur_view_factors_destroy(reference);
    aur_facets_destroy(facets);
}

/* The sky factor of two squares of side 1 at distance 1 is 1 less Howell's C-11; rays only. Five standard
 * deviations of the binomial count give a false alarm in two million. Evenly distributed rays are not quite
 * normal: here as at the origin some 2 % fewer intervals cover the value. */
static void test_sky_coverage(void **state) {
    (void)state;
    enum { RUNS = 400 };
    const double expected = 1.0 - 0.19982489569838732, *const o = offsets[2];
    mesh_file file;
    mesh_begin(&file, "sky-coverage");
    mesh_group(&file, "below");
    mesh_polygon(&file, 4,
                 (const double[4][3]){{o[0], o[1], o[2]},
                                      {o[0] + 1.0, o[1], o[2]},
                                      {o[0] + 1.0, o[1] + 1.0, o[2]},
                                      {o[0], o[1] + 1.0, o[2]}});
    mesh_group(&file, "above");
    mesh_polygon(&file, 4,
                 (const double[4][3]){{o[0], o[1], o[2] + 1.0},
                                      {o[0], o[1] + 1.0, o[2] + 1.0},
                                      {o[0] + 1.0, o[1] + 1.0, o[2] + 1.0},
                                      {o[0] + 1.0, o[1], o[2] + 1.0}});
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = true;
    aur_facets *const facets = mesh_load(&file, &options);
    static const double confidences[] = {0.8, 0.95};
    for (size_t c = 0; c < 2; ++c) {
        size_t held = 0;
        for (uint64_t seed = 0; seed < RUNS; ++seed) {
            aur_view_factors_options requested = target_of(seed, true);
            requested.confidence = confidences[c];
            aur_view_factors_matrix m;
            aur_view_factors *const factors = factors_of(facets, &requested, &m);
            held += fabs(m.sky[0] - expected) <= m.sky_half_widths[0];
            aur_view_factors_destroy(factors);
        }
        const double expected_hits = confidences[c] * RUNS,
                     deviation = sqrt(expected_hits * (1.0 - confidences[c]));
        print_message("%zu of %d intervals of confidence %g hold the sky\n", held, (int)RUNS, confidences[c]);
        assert_in_range(held, expected_hits - 5.0 * deviation, fmin(expected_hits + 5.0 * deviation, RUNS));
    }
    aur_facets_destroy(facets);
}

/* Regression: facets small relative to their distance from the origin vanished when they were merged. */
static void test_small_facets(void **state) {
    (void)state;
    aur_box_tree tree;
    assert_int_equal(aur_box_tree_create(0, NULL, &tree, NULL), AUR_OK);
    assert_true(tree.node_count == 0);
    aur_box_tree_release(&tree);
    for (size_t p = 0; p < OFFSETS; ++p)
        for (double size = 1.0; size > 1e-3; size /= 8.0) {
            const double *const o = offsets[p];
            mesh_file file;
            mesh_begin(&file, "far-plates");
            mesh_polygon(&file, 4,
                         (const double[4][3]){{o[0], o[1], o[2]},
                                              {o[0] + size, o[1], o[2]},
                                              {o[0] + size, o[1] + size, o[2]},
                                              {o[0], o[1] + size, o[2]}});
            mesh_polygon(&file, 4,
                         (const double[4][3]){{o[0], o[1], o[2] + size},
                                              {o[0], o[1] + size, o[2] + size},
                                              {o[0] + size, o[1] + size, o[2] + size},
                                              {o[0] + size, o[1], o[2] + size}});
            aur_facets_options options = {.size = sizeof options};
            aur_facets_options_init(&options, NULL);
            aur_facets *const facets = mesh_load(&file, &options);
            const aur_view_factors_options requested = target_of(1, false);
            aur_view_factors_matrix m;
            aur_view_factors *const factors = factors_of(facets, &requested, &m);
            const double rounding = 64.0 * 0x1p-53 * (o[0] + o[1] + o[2]) / size;
            double seen = 0.0;
            for (size_t k = 2; k < 4; ++k)
                seen += factor_at(&m, 0, k, NULL) / 2.0 + factor_at(&m, 1, k, NULL) / 2.0;
            assert_near(seen, 0.19982489569838732, 1e-12 + rounding); /* Howell C-11 */
            aur_view_factors_destroy(factors);
            aur_facets_destroy(facets);
        }
}

/* A speck or a plane far away changes nothing that is near. */
static void test_far_speck(void **state) {
    (void)state;
    double found[2];
    for (int far = 0; far < 2; ++far) {
        mesh_file file;
        mesh_begin(&file, "speck");
        mesh_box(&file, "low", (double[3]){0, 0, 0}, (double[3]){1, 1, 0.25}, false, true);
        mesh_box(&file, "high", (double[3]){0, 0, 0.251}, (double[3]){1, 1, 1}, false, true);
        mesh_group(&file, "speck");
        if (far)
            mesh_polygon(&file, 3, (const double[3][3]){{3e6, 0, 9}, {3e6, 1, 9}, {3e6, 0, 8}});
        aur_facets_options options = {.size = sizeof options};
        aur_facets_options_init(&options, NULL);
        options.group = true;
        aur_facets *const facets = mesh_load(&file, &options);
        const aur_view_factors_options requested = target_of(3, false);
        aur_view_factors_matrix m;
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        found[far] = factor_at(&m, 5, 8, NULL);
        aur_view_factors_destroy(factors);
        aur_facets_destroy(facets);
    }
    assert_near(found[1], found[0], 1e-9);
}

/* The underside of a small table sees only the ground, whether that is 100 m or 100 km wide: the ray offsets
 * of large facets must not exceed the gap, nor those of small ones be too small. */
static void test_wide_ground(void **state) {
    (void)state;
    for (double h = 50.0; h < 1e5; h *= 1000.0) {
        mesh_file file;
        mesh_begin(&file, "ground");
        mesh_group(&file, "ground");
        mesh_polygon(&file, 4, (const double[4][3]){{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}});
        mesh_box(&file, "table", (double[3]){0.1, 0.2, 0.01}, (double[3]){0.11, 0.21, 0.02}, false, true);
        aur_facets_options options = {.size = sizeof options};
        aur_facets_options_init(&options, NULL);
        options.group = true;
        aur_facets *const facets = mesh_load(&file, &options);
        aur_view_factors_options requested = target_of(1, true);
        requested.rays = 1 << 14;
        aur_view_factors_matrix m;
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        assert_near(factor_at(&m, 3, 0, NULL), 1.0, 2e-4);
        assert_near(m.back[0] + m.back[3], 0.0, 1e-12);
        aur_view_factors_destroy(factors);
        aur_facets_destroy(facets);
    }
}

/* A tilted square about the origin is large relative to the coordinates of its centre, which determined the
 * ray offset once. */
static void test_tilted_square(void **state) {
    (void)state;
    for (int i = 1; i < 8; ++i) {
        const mesh_pose pose = turned_pose(0.4 * i, 0, 0, 0);
        mesh_file file;
        mesh_begin(&file, "tilted");
        moved_polygon(&file, &pose, 4, (const double[4][3]){{-7, -6, 0}, {8, -6, 0}, {8, 9, 0}, {-7, 9, 0}});
        aur_facets *const facets = mesh_load(&file, NULL);
        aur_view_factors_options requested = target_of(1, true);
        requested.rays = 1 << 16;
        aur_view_factors_matrix m;
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        for (size_t k = 0; k < 2; ++k)
            assert_true(m.back[k] == 0.0 && fabs(m.sky[k] - 1.0) < 1e-12);
        aur_view_factors_destroy(factors);
        aur_facets_destroy(facets);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_room),          cmocka_unit_test(test_street),
        cmocka_unit_test(test_radiosities),   cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_sky_coverage),  cmocka_unit_test(test_small_facets),
        cmocka_unit_test(test_tilted_square), cmocka_unit_test(test_wide_ground),
        cmocka_unit_test(test_far_speck),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
