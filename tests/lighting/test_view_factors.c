/* View factors of meshes: closed forms, physics, intervals, threads. */
#include <aureole/statistics.h>
#include <string.h>

#include "mesh_text.h"

#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/view_factors.h"

static aur_facets_options grouped(void) {
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = true;
    return options;
}

/* Howell C-11 for a unit cube's opposite sides; the four others share the rest. */
static void test_cube(void **state) {
    (void)state;
    mesh_file file;
    mesh_begin(&file, "cube");
    mesh_box(&file, "side", (double[3]){0, 0, 0}, (double[3]){1, 1, 1}, true, true);
    const aur_facets_options options = grouped();
    aur_facets *const facets = mesh_load(&file, &options);
    assert_int_equal(aur_facets_rows(facets), 6);
    assert_string_equal(aur_facets_name(facets, 4), "side4");
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    const double root = sqrt(2.0);
    const double opposite = 2.0 / PI * (0.5 * log(4.0 / 3.0) + 2.0 * root * atan(1.0 / root) - 0.5 * PI);
    for (size_t i = 0; i < 6; ++i)
        for (size_t k = 0; k < 6; ++k) {
            double width;
            const double expected = i == k ? 0.0 : (i + 3) % 6 == k ? opposite : (1.0 - opposite) / 4.0;
            const double measured = factor_at(&m, i, k, &width);
            assert_near(measured, expected, 1e-12);
            assert_true(width == 0.0);
        }
    check_physics(&m);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* A sphere in a box: all its light arrives at the box; the reverse factor follows from the areas. Much of the
 * box is hidden from itself. */
static void test_sphere_in_enclosure(void **state) {
    (void)state;
    mesh_file file;
    mesh_begin(&file, "enclosure");
    mesh_box(&file, "room", (double[3]){-1, -1, -1}, (double[3]){1, 2, 1}, true, false);
    mesh_group(&file, "ball");
    mesh_sphere(&file, (double[3]){0.1, 0.2, -0.1}, 0.6, 8, 0.0, false);
    const aur_facets_options options = grouped();
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    const double *const areas = aur_facets_areas(facets);
    assert_near(areas[0], 32.0, 1e-12);
    assert_near(factor_at(&m, 1, 0, NULL), 1.0, 1e-12);
    assert_near(factor_at(&m, 0, 1, NULL), areas[1] / areas[0], 1e-12);
    assert_true(m.sky[0] == 0.0 && m.sky[1] == 0.0);
    check_physics(&m);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* Coaxial cylinders of the radii 1 and x and the length y (Howell C-91, C-92), as prisms of n sides:
 * polygons' radii differ from the circle's by up to 1 - cos(pi / n), .1 % for 72. */
static void test_cylinders(void **state) {
    (void)state;
    enum { N = 72 };
    const double x = 2.0, y = 3.0;
    mesh_file file;
    mesh_begin(&file, "cylinders");
    for (int inner = 0; inner < 2; ++inner) {
        mesh_group(&file, inner ? "inner" : "outer");
        const double scale = sqrt(2.0 * PI / N / sin(2.0 * PI / N)); /* the circle's area */
        for (size_t k = 0; k < N; ++k) {
            const double a = 2.0 * PI * (double)k / N, b = 2.0 * PI * (double)((k + 1) % N) / N;
            const double r = scale * (inner ? 1.0 : x);
            const double outward[4][3] = {{r * cos(a), r * sin(a), 0},
                                          {r * cos(b), r * sin(b), 0},
                                          {r * cos(b), r * sin(b), y},
                                          {r * cos(a), r * sin(a), y}};
            double corners[4][3];
            for (size_t c = 0; c < 4; ++c)
                memcpy(corners[c], outward[inner ? c : 3 - c], sizeof corners[c]);
            mesh_polygon(&file, 4, (const double(*)[3])corners);
        }
    }
    const aur_facets_options options = grouped();
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    const double a = y * y + x * x - 1.0, b = y * y - x * x + 1.0;
    const double inwards =
        1.0 / x *
        (1.0 - 1.0 / PI *
                   (acos(b / a) - 0.5 / y *
                                      (sqrt((a + 2.0) * (a + 2.0) - 4.0 * x * x) * acos(b / (x * a)) +
                                       b * asin(1.0 / x) - 0.5 * PI * a)));
    const double root = sqrt(4.0 * x * x + y * y);
    const double itself = 1.0 - 1.0 / x + 2.0 / (PI * x) * atan(2.0 * sqrt(x * x - 1.0) / y) -
                          y / (2.0 * PI * x) *
                              (root / y *
                                   asin((4.0 * (x * x - 1.0) + y * y / (x * x) * (x * x - 2.0)) /
                                        (y * y + 4.0 * (x * x - 1.0))) -
                               asin((x * x - 2.0) / (x * x)) + 0.5 * PI * (root / y - 1.0));
    double width;
    const double measured = factor_at(&m, 0, 1, &width);
    assert_near(measured, inwards, 2e-3 * inwards + 2.0 * width);
    const double diagonal = factor_at(&m, 0, 0, &width);
    assert_near(diagonal, itself, 2e-3 * itself + 2.0 * width);
    assert_near(factor_at(&m, 1, 1, NULL), 0.0, 0.0);
    check_physics(&m);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* Sparrow's spherical cavity: every part of a sphere sees every other in proportion to its area, so that the
 * radiosity of an isothermal cavity is uniform (Sparrow and Jonsson 1962). */
static void test_cavity(void **state) {
    (void)state;
    const double opening = PI / 4.0, emittance = 0.5;
    mesh_file file;
    mesh_begin(&file, "cavity");
    mesh_sphere(&file, (double[3]){0, 0, 0}, 1.0, 12, opening, true);
    aur_facets *const facets = mesh_load(&file, NULL);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    check_physics(&m);
    double *const light = malloc(3 * m.rows * sizeof *light);
    assert_non_null(light);
    double *const next = light + m.rows, *const sum = next + m.rows;
    for (size_t i = 0; i < m.rows; ++i)
        sum[i] = light[i] = emittance;
    for (size_t step = 0; step < 60; ++step) {
        for (size_t i = 0; i < m.rows; ++i) {
            next[i] = 0.0;
            for (uint64_t e = m.starts[i]; e < m.starts[i + 1]; ++e)
                next[i] += (1.0 - emittance) * m.values[e] * light[m.columns[e]];
        }
        for (size_t i = 0; i < m.rows; ++i)
            sum[i] += light[i] = next[i];
    }
    /* The opening is flat for the polyhedron, too: the view of the cavity differs by the second power of a
     * facet's angle, 2 pi / 24. */
    const double seen = 0.5 * (1.0 + cos(opening));
    const double radiosity = emittance / (1.0 - (1.0 - emittance) * seen);
    double mean = 0.0, area = 0.0;
    for (size_t i = 0; i < m.rows; ++i) {
        assert_relative(sum[i], radiosity, 0.03);
        mean += m.areas[i] * sum[i];
        area += m.areas[i];
    }
    assert_relative(mean / area, radiosity, 0.003);
    free(light);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* Some light goes to the sky, a block stops some. */
static aur_facets *load_yard(const aur_facets_options *options) {
    mesh_file file;
    mesh_begin(&file, "yard");
    mesh_group(&file, "ground");
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y) {
            const double corners[4][3] = {{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}};
            mesh_polygon(&file, 4, corners);
        }
    mesh_box(&file, "low", (double[3]){1.2, 1.3, 0.25}, (double[3]){1.7, 2.5, 0.75}, false, false);
    mesh_box(&file, "high", (double[3]){2.5, 0.5, 0.25}, (double[3]){3.5, 1.5, 2}, false, false);
    return mesh_load(&file, options);
}

static void test_physics_and_threads(void **state) {
    (void)state;
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    for (int variant = 0; variant < 4; ++variant) {
        options.group = variant == 1;
        options.both_sides = variant == 2;
        aur_facets *const facets = load_yard(&options);
        aur_view_factors_options requested = {.size = sizeof requested};
        aur_view_factors_options_init(&requested, NULL);
        requested.rays = 512;
        requested.rays_only = variant == 3;
        requested.seed = 5;
        requested.threads = 1;
        aur_view_factors_matrix one, three;
        aur_view_factors *const first = factors_of(facets, &requested, &one);
        requested.threads = 3;
        aur_view_factors *const second = factors_of(facets, &requested, &three);
        check_physics(&one);
        assert_int_equal(one.rows, three.rows);
        const size_t entries = one.starts[one.rows];
        assert_memory_equal(one.starts, three.starts, (one.rows + 1) * sizeof *one.starts);
        assert_memory_equal(one.columns, three.columns, entries * sizeof *one.columns);
        assert_memory_equal(one.values, three.values, entries * sizeof *one.values);
        assert_memory_equal(one.half_widths, three.half_widths, entries * sizeof *one.half_widths);
        assert_memory_equal(one.sky, three.sky, one.rows * sizeof *one.sky);
        aur_view_factors_destroy(first);
        aur_view_factors_destroy(second);
        aur_facets_destroy(facets);
    }
}

/* Rays agree with closed forms, and their intervals have the stated coverage: 15 factors of a room's walls,
 * 60 seeds. They are correlated (rows sum to 1): if a third were independent, three standard deviations would
 * be 4 %. */
static void test_intervals(void **state) {
    (void)state;
    mesh_file file;
    mesh_begin(&file, "intervals");
    mesh_box(&file, "side", (double[3]){0, 0, 0}, (double[3]){3, 4, 2.5}, true, true);
    const aur_facets_options options = grouped();
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix exact, m;
    aur_view_factors *const closed = factors_of(facets, NULL, &exact);
    size_t held = 0, all = 0;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        aur_view_factors_options requested = {.size = sizeof requested};
        aur_view_factors_options_init(&requested, NULL);
        requested.rays_only = true;
        requested.rays = 256;
        requested.seed = seed;
        aur_view_factors *const factors = factors_of(facets, &requested, &m);
        check_physics(&m);
        for (size_t i = 0; i < 6; ++i)
            for (size_t k = 0; k < i; ++k) {
                double width;
                const double expected = factor_at(&exact, i, k, NULL);
                const double measured = factor_at(&m, i, k, &width);
                held += fabs(measured - expected) <= width;
                ++all;
            }
        aur_view_factors_destroy(factors);
    }
    print_message("%zu of %zu intervals hold the factor\n", held, all);
    assert_true((double)held >= 0.91 * (double)all && (double)held <= 0.99 * (double)all);
    aur_view_factors_destroy(closed);
    aur_facets_destroy(facets);
}

/* Products without the matrix: the same rays, so the same rows where nothing is closed or balanced. */
static void test_product(void **state) {
    (void)state;
    aur_facets *const facets = load_yard(NULL);
    const size_t rows = aur_facets_rows(facets);
    aur_view_factors_options requested = {.size = sizeof requested};
    aur_view_factors_options_init(&requested, NULL);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, &requested, &m);
    double *const numbers = malloc(3 * rows * sizeof *numbers);
    assert_non_null(numbers);
    double *const x = numbers, *const y = x + rows, *const sky = y + rows;
    aur_view_factors_options options;
    assert_int_equal(aur_view_factors_read_options(&requested, &options, NULL), AUR_OK);
    aur_facet_pattern pattern = {0};
    const aur_parallel_options parallel = {.threads = 0};
    assert_int_equal(aur_facet_pattern_create(options.set, options.rays / options.randomizations,
                                              options.seed, &pattern, NULL),
                     AUR_OK);
    for (size_t i = 0; i < rows; ++i)
        x[i] = 1.0;
    assert_int_equal(
        aur_facet_product(facets, &pattern, 0, options.randomizations, &parallel, NULL, x, y, sky, NULL),
        AUR_OK);
    for (size_t i = 0; i < rows; ++i) {
        assert_near(y[i] + sky[i] + m.back[i], 1.0, 0.05);
        assert_near(sky[i], m.sky[i], 0.03);
    }
    for (size_t i = 0; i < rows; ++i)
        x[i] = (double)(i % 7);
    assert_int_equal(
        aur_facet_product(facets, &pattern, 0, options.randomizations, &parallel, NULL, x, y, NULL, NULL),
        AUR_OK);
    for (size_t i = 0; i < rows; ++i) {
        double sum = 0.0;
        for (uint64_t e = m.starts[i]; e < m.starts[i + 1]; ++e)
            sum += m.values[e] * x[m.columns[e]];
        assert_near(y[i], sum, 0.1);
    }
    aur_facet_pattern_release(&pattern);
    free(numbers);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

static void test_errors(void **state) {
    (void)state;
    aur_facets *const facets = load_yard(NULL);
    aur_view_factors *factors;
    aur_error error;
    aur_view_factors_options requested = {.size = sizeof requested};
    aur_view_factors_options_init(&requested, NULL);
    requested.rays = 4;
    assert_int_equal(aur_view_factors_create(facets, &requested, &factors, &error), AUR_ERROR_ARGUMENT);
    requested.rays = 0;
    requested.randomizations = 1;
    assert_int_equal(aur_view_factors_create(facets, &requested, &factors, &error), AUR_ERROR_ARGUMENT);
    requested.randomizations = 0;
    requested.set = "no-such-set";
    assert_int_equal(aur_view_factors_create(facets, &requested, &factors, &error), AUR_ERROR_NAME);
    requested.set = "van-der-corput";
    assert_int_not_equal(aur_view_factors_create(facets, &requested, &factors, &error), AUR_OK);
    requested.set = NULL;
    requested.confidence = 1.5;
    assert_int_equal(aur_view_factors_create(facets, &requested, &factors, &error), AUR_ERROR_ARGUMENT);
    aur_facets_destroy(facets);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube),
        cmocka_unit_test(test_sphere_in_enclosure),
        cmocka_unit_test(test_cylinders),
        cmocka_unit_test(test_cavity),
        cmocka_unit_test(test_physics_and_threads),
        cmocka_unit_test(test_intervals),
        cmocka_unit_test(test_product),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
