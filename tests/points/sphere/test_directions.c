#include "sphere_check.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static aur_directions *open_set(const char *set, aur_directions_options options) {
    aur_directions *directions;
    aur_error error = {0};
    if (aur_directions_create(set, &options, &directions, &error) != AUR_OK)
        fail_msg("%s: %s", set, error.message);
    return directions;
}

static aur_lobe lobe_of(const char *text) {
    aur_lobe lobe;
    assert_int_equal(aur_lobe_parse(text, &lobe, NULL), AUR_OK);
    return lobe;
}

/* Sets of the square are lifted point by point. */
static void squares_are_lifted_by_the_map(void **state) {
    (void)state;
    enum { COUNT = 300 };
    static const aur_map maps[] = {AUR_MAP_LAMBERT, AUR_MAP_CONCENTRIC, AUR_MAP_AZIMUTHAL, AUR_MAP_POLAR};
    for (size_t m = 0; m < 4; ++m) {
        aur_pointset *square;
        const aur_pointset_options requested = {
            .size = sizeof requested, .count = COUNT, .scramble = AUR_SCRAMBLE_DIGIT, .seed = 9};
        assert_int_equal(aur_pointset_create("sobol", &requested, &square, NULL), AUR_OK);
        double uv[2 * COUNT];
        assert_int_equal(aur_pointset_points(square, 0, COUNT, 2 * COUNT, uv, NULL), AUR_OK);
        aur_pointset_destroy(square);
        double *const xyz =
            check_directions("sobol", (aur_directions_options){.size = sizeof(aur_directions_options),
                                                               .count = COUNT,
                                                               .domain = AUR_DOMAIN_SPHERE,
                                                               .map = maps[m],
                                                               .scramble = AUR_SCRAMBLE_DIGIT,
                                                               .seed = 9});
        for (size_t i = 0; i < COUNT; ++i) {
            double expected[3];
            aur_map_to_cap(maps[m], AUR_CAP_SPHERE, 1, uv + 2 * i, expected, NULL);
            assert_memory_equal(expected, xyz + 3 * i, sizeof expected);
        }
        free(xyz);
    }
}

/* Every layout has the same numbers, rounded for floats, for any requested part. */
static void layouts_agree(void **state) {
    (void)state;
    enum { COUNT = 700, FIRST = 133, PART = 451 };
    static const char *const sets[] = {"sobol", "spherical-fibonacci", "esfg:base=7",
                                       "spherical-fibonacci:region=octant"};
    for (size_t s = 0; s < 4; ++s) {
        const aur_directions_options options = {.size = sizeof options,
                                                .count = COUNT,
                                                .domain = AUR_DOMAIN_HEMISPHERE,
                                                .lobe = lobe_of(s == 2 ? "uniform" : "phong:9"),
                                                .optimal_density = true,
                                                .scramble = AUR_SCRAMBLE_ROTATE,
                                                .seed = 3};
        aur_directions *const directions = open_set(sets[s], options);
        static double xyz[3 * COUNT], w[COUNT], axes[3][COUNT], w2[COUNT];
        static float fxyz[3 * COUNT], fw[COUNT], faxes[3][COUNT], fw2[COUNT];
        const aur_output arrays = {AUR_LAYOUT_ARRAYS, COUNT, 3 * COUNT, axes[0], NULL};
        const aur_output rows_float = {AUR_LAYOUT_POINTS, 0, 3 * PART, NULL, fxyz};
        const aur_output arrays_float = {AUR_LAYOUT_ARRAYS, COUNT, 3 * COUNT, NULL, faxes[0]};
        const aur_output weights = {.capacity = PART, .doubles = w2};
        const aur_output weights_float = {.capacity = PART, .floats = fw};
        const aur_output again_float = {AUR_LAYOUT_ARRAYS, 0, PART, NULL, fw2};
        assert_int_equal(aur_directions_points(directions, 0, COUNT, 3 * COUNT, xyz, w, NULL), AUR_OK);
        assert_int_equal(aur_directions_generate(directions, FIRST, PART, &arrays, &weights, NULL), AUR_OK);
        assert_int_equal(aur_directions_generate(directions, FIRST, PART, &rows_float, &weights_float, NULL),
                         AUR_OK);
        assert_int_equal(aur_directions_generate(directions, FIRST, PART, &arrays_float, &again_float, NULL),
                         AUR_OK);
        for (size_t i = 0; i < PART; ++i) {
            const double *const p = xyz + 3 * (FIRST + i);
            assert_true(w2[i] == w[FIRST + i] && fw[i] == (float)w[FIRST + i] && fw2[i] == fw[i]);
            for (size_t d = 0; d < 3; ++d)
                assert_true(axes[d][i] == p[d] && fxyz[3 * i + d] == (float)p[d] &&
                            faxes[d][i] == (float)p[d]);
        }
        assert_int_equal(aur_directions_points(directions, 0, COUNT, 3 * COUNT - 1, xyz, w, NULL),
                         AUR_ERROR_CAPACITY);
        assert_int_equal(aur_directions_generate(directions, 0, PART + 1, &arrays, &weights, NULL),
                         AUR_ERROR_CAPACITY);
        aur_error error = {0};
        assert_int_equal(aur_directions_generate(directions, 0, PART + 1, &rows_float, NULL, &error),
                         AUR_ERROR_CAPACITY);
        assert_string_equal(error.message, "452 points of 3 coordinates do not fit into 1353 elements");
        assert_int_equal(aur_directions_points(directions, 1, COUNT, 3 * COUNT, xyz, w, NULL),
                         AUR_ERROR_ARGUMENT);
        assert_int_equal(aur_directions_points(directions, UINT64_MAX, 1, 3, xyz, w, NULL),
                         AUR_ERROR_ARGUMENT);
        aur_directions_destroy(directions);
    }
}

/* Rules for a lobe: the sum of w f is the integral of p f. With f = z^2 and p of cos^M that is (M+1)/(M+3),
 * and 1 with f = 1: for the density itself, the optimal one, and a map that is not uniform. */
static void weights_make_rules(void **state) {
    (void)state;
    enum { COUNT = 4096 };
    static const char *const sets[] = {"spherical-fibonacci", "sobol", "esfg"};
    static const char *const lobes[] = {"uniform", "cosine", "phong:20"};
    static double xyz[3 * COUNT], weights[COUNT];
    for (size_t k = 0; k < 36; ++k) {
        const aur_directions_options options = {.size = sizeof options,
                                                .count = COUNT,
                                                .domain = AUR_DOMAIN_HEMISPHERE,
                                                .map = k / 18 == 0 ? AUR_MAP_CONCENTRIC : AUR_MAP_POLAR,
                                                .lobe = lobe_of(lobes[k / 3 % 3]),
                                                .optimal_density = k / 9 % 2 != 0,
                                                .scramble = AUR_SCRAMBLE_ROTATE};
        aur_directions *const directions = open_set(sets[k % 3], options);
        assert_int_equal(aur_directions_points(directions, 0, COUNT, 3 * COUNT, xyz, weights, NULL), AUR_OK);
        aur_directions_destroy(directions);
        double mass = 0.0, moment = 0.0;
        for (size_t i = 0; i < COUNT; ++i) {
            mass += weights[i];
            moment += weights[i] * xyz[3 * i + 2] * xyz[3 * i + 2];
        }
        const double m = options.lobe.exponent;
        assert_near(mass, 1.0, 2e-3);
        assert_near(moment, (m + 1.0) / (m + 3.0), 2e-3);
    }
}

/* GGX: directions below the horizon weigh nothing, and the rest of the mass is the integral of the density
 * above. */
static void ggx_weighs_what_is_above_the_horizon(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    const aur_directions_options options = {.size = sizeof options,
                                            .count = COUNT,
                                            .domain = AUR_DOMAIN_HEMISPHERE,
                                            .lobe = lobe_of("ggx:0.5:70")};
    static double xyz[3 * COUNT], weights[COUNT];
    aur_directions *const directions = open_set("spherical-fibonacci", options);
    assert_int_equal(aur_directions_points(directions, 0, COUNT, 3 * COUNT, xyz, weights, NULL), AUR_OK);
    aur_directions_destroy(directions);
    double mass = 0.0;
    for (size_t i = 0; i < COUNT; ++i) {
        mass += weights[i];
        assert_true((xyz[3 * i + 2] < 0.0) == (weights[i] == 0.0));
    }
    double *const above = check_directions("spherical-fibonacci",
                                           (aur_directions_options){.size = sizeof(aur_directions_options),
                                                                    .count = 400000,
                                                                    .domain = AUR_DOMAIN_HEMISPHERE});
    double integral = 0.0;
    for (size_t i = 0; i < 400000; ++i)
        integral += aur_lobe_pdf(&options.lobe, above + 3 * i) * 2.0 * AUR_PI / 400000.0;
    free(above);
    assert_true(mass < 0.95);
    assert_near(mass, integral, 1e-3);
}

/* Rotations preserve lengths and angles, differ between seeds, and the mean of many random ones is zero. */
static void rotations_are_rotations(void **state) {
    (void)state;
    double mean[3] = {0};
    for (uint64_t seed = 0; seed < 4000; ++seed) {
        aur_rotation rotation, axial;
        aur_rotation_uniform(seed, &rotation);
        aur_rotation_axial(seed, &axial);
        double v[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        aur_rotation_apply(&rotation, 3, v);
        assert_near(check_dot(v, v + 3), 0.0, 1e-14);
        assert_near(check_dot(v, v), 1.0, 1e-14);
        /* right-handed */
        assert_near(v[0] * (v[4] * v[8] - v[5] * v[7]) - v[1] * (v[3] * v[8] - v[5] * v[6]) +
                        v[2] * (v[3] * v[7] - v[4] * v[6]),
                    1.0, 1e-14);
        for (size_t d = 0; d < 3; ++d)
            mean[d] += v[6 + d] / 4000.0;
        double up[3] = {0, 0, 1};
        aur_rotation_apply(&axial, 1, up);
        assert_true(up[0] == 0.0 && up[1] == 0.0 && up[2] == 1.0);
    }
    /* each component has variance 1/3: five standard errors */
    for (size_t d = 0; d < 3; ++d)
        assert_near(mean[d], 0.0, 5.0 * sqrt(1.0 / 3.0 / 4000.0));
}

/* Axial rotation preserves the energy, and a rotated set is the set rotated. */
static void scrambling_by_rotation_preserves_the_set(void **state) {
    (void)state;
    enum { COUNT = 256 };
    aur_directions_options options = {
        .size = sizeof options, .count = COUNT, .domain = AUR_DOMAIN_SPHERE, .seed = 17};
    double *const plain = check_directions("spherical-fibonacci", options);
    options.scramble = AUR_SCRAMBLE_ROTATE3D;
    double *const turned = check_directions("spherical-fibonacci", options);
    assert_relative(check_energy(COUNT, turned), check_energy(COUNT, plain), 1e-10);
    aur_rotation rotation;
    aur_rotation_uniform(17, &rotation);
    aur_rotation_apply(&rotation, COUNT, plain);
    assert_memory_equal(plain, turned, 3 * COUNT * sizeof *plain);
    free(plain);
    free(turned);
}

/* An octant: all of its points are in it, as evenly as on the whole sphere. */
static void octants_are_filled_evenly(void **state) {
    (void)state;
    for (size_t count = 1; count < 2000; count += 1 + count / 2) {
        double *const xyz = check_directions("spherical-fibonacci:region=octant",
                                             (aur_directions_options){.size = sizeof(aur_directions_options),
                                                                      .count = count,
                                                                      .domain = AUR_DOMAIN_SPHERE});
        double sum[3] = {0};
        for (size_t i = 0; i < count; ++i) {
            assert_true(xyz[3 * i] >= 0.0 && xyz[3 * i + 1] >= 0.0 && xyz[3 * i + 2] >= 0.0);
            for (size_t d = 0; d < 3; ++d)
                sum[d] += xyz[3 * i + d] / (double)count;
        }
        if (count > 1)
            assert_true(check_smallest_distance(count, xyz) * sqrt(8.0 * (double)count) > 2.7);
        /* the mean of each coordinate over an octant is 1/2 */
        for (size_t d = 0; d < 3; ++d)
            assert_near(sum[d], 0.5, 0.9 * pow((double)count, -0.7));
        free(xyz);
    }
}

/* Points read from a file equal the written ones: directions unchanged, squares lifted. */
static void files_are_sets(void **state) {
    (void)state;
    static const char path[] = "directions-of-a-file.csv";
    double xyz[] = {0, 0, 1, 0.6, 0, 0.8, 0, -0.8, 0.6};
    double weights[] = {0.5, 0.25, 0.25};
    const aur_points_view points = {.size = sizeof points,
                                    .domain = AUR_DOMAIN_HEMISPHERE,
                                    .count = 3,
                                    .dimension = 3,
                                    .coordinates = xyz,
                                    .weights = weights};
    assert_int_equal(aur_points_write(path, AUR_POINTS_CSV, &points, NULL, NULL), AUR_OK);
    char set[64];
    snprintf(set, sizeof set, "file:%s", path);
    const aur_directions_options options = {.size = sizeof options, .domain = AUR_DOMAIN_SPHERE};
    aur_directions *directions = open_set(set, options);
    assert_int_equal(aur_directions_size(directions), 3);
    double read[9], read_weights[3];
    assert_int_equal(aur_directions_points(directions, 0, 3, 9, read, read_weights, NULL), AUR_OK);
    assert_memory_equal(read, xyz, sizeof xyz);
    assert_memory_equal(read_weights, weights, sizeof weights);
    aur_directions_destroy(directions);
    aur_directions_options more = options;
    more.count = 4;
    assert_int_equal(aur_directions_create(set, &more, &directions, NULL), AUR_ERROR_ARGUMENT);
    xyz[8] = -0.6;
    assert_int_equal(aur_points_write(path, AUR_POINTS_NPY, &points, NULL, NULL), AUR_OK);
    more = (aur_directions_options){.size = sizeof(aur_directions_options), .domain = AUR_DOMAIN_HEMISPHERE};
    assert_int_equal(aur_directions_create(set, &more, &directions, NULL), AUR_ERROR_ARGUMENT);
    double uv[] = {0.25, 0.5, 0.125, 0.75};
    const aur_points_view squares = {
        .size = sizeof squares, .domain = AUR_DOMAIN_SQUARE, .count = 2, .dimension = 2, .coordinates = uv};
    assert_int_equal(aur_points_write(path, AUR_POINTS_CSV, &squares, NULL, NULL), AUR_OK);
    directions = open_set(set, options);
    assert_int_equal(aur_directions_points(directions, 0, 2, 6, read, NULL, NULL), AUR_OK);
    assert_near(read[2], 0.5, 1e-15);
    assert_near(read[5], 0.75, 1e-15);
    aur_directions_destroy(directions);
    unlink(path);
}

static void refuses_what_is_wrong(void **state) {
    (void)state;
    const aur_directions_options good = {.size = sizeof good, .count = 10, .domain = AUR_DOMAIN_HEMISPHERE};
    aur_directions_options wrong[12];
    for (size_t i = 0; i < 12; ++i)
        wrong[i] = good;
    wrong[0].domain = AUR_DOMAIN_SQUARE;
    wrong[1].map = (aur_map)7;
    wrong[2].cap_degrees = NAN;
    wrong[3].cap_degrees = 91.0;
    wrong[4].lobe.exponent = -1.0;
    wrong[5].lobe.exponent = NAN;
    wrong[6].scramble = AUR_SCRAMBLE_ROTATE3D;
    wrong[7].optimal_density = true;
    wrong[7].smoothness = 6.0;
    wrong[8].scramble = AUR_SCRAMBLE_OWEN; /* has no meaning for native sets */
    wrong[9].lobe.exponent = 2.0;
    wrong[9].cap_degrees = 30.0;
    wrong[10].domain = AUR_DOMAIN_SPHERE;
    wrong[10].lobe.exponent = 2.0;
    wrong[11].lobe.kind = (aur_lobe_kind)5;
    for (size_t i = 0; i < 12; ++i) {
        aur_directions *directions;
        aur_error error = {0};
        assert_int_not_equal(aur_directions_create("spherical-fibonacci", &wrong[i], &directions, &error),
                             AUR_OK);
        assert_null(directions);
        assert_true(strlen(error.message) > 0);
    }
}

static void options_can_grow(void **state) {
    (void)state;
    struct {
        aur_directions_options current;
        int option;
    } newer;
    memset(&newer, 0, sizeof newer);
    newer.current.size = sizeof(aur_directions_options);
    aur_directions_options_init(4, AUR_DOMAIN_SPHERE, &newer.current, NULL);
    newer.current.size = sizeof newer;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&newer.current, &request, NULL);
    aur_points *points;
    assert_int_equal(aur_points_generate("spherical-fibonacci", &request, &points, NULL), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->count, 4);
    aur_points_destroy(points);
    newer.option = 1;
    assert_int_equal(aur_points_generate("spherical-fibonacci", &request, &points, NULL),
                     AUR_ERROR_UNSUPPORTED);
    const aur_directions_options unset = {.count = 4, .domain = AUR_DOMAIN_SPHERE};
    aur_directions *directions;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &unset, &directions, NULL),
                     AUR_ERROR_ARGUMENT);
    assert_null(directions);
}

/* The table of all sets: unique names, complete, and every listed set can be generated. */
static void table_names_sets_that_exist(void **state) {
    (void)state;
    assert_null(aur_set_at(aur_set_count()));
    for (size_t i = 0; i < aur_set_count(); ++i) {
        const aur_set_description *const set = aur_set_at(i);
        assert_true(set->row.name != NULL && set->row.summary != NULL && set->domains != 0 &&
                    aur_set_sizes(set, 0, NULL) > 0 && set->row.source != NULL);
        for (size_t k = 0; k < i; ++k)
            assert_string_not_equal(set->row.name, aur_set_at(k)->row.name);
    }
}

/* The sizes of sets are data, and a text derived from them. */
static void sets_say_their_sizes(void **state) {
    (void)state;
    static const struct {
        const char *set, *text;
        uint64_t maximum;
        aur_sizes best;
        uint32_t base;
    } cases[] = {
        {"random", "any", UINT64_MAX, AUR_SIZES_ANY, 0},
        {"sobol", "1..2^53; a net at 2^m", UINT64_C(1) << 53, AUR_SIZES_POWERS, 2},
        {"faure", "1..2^48; a net at base^m", UINT64_C(1) << 48, AUR_SIZES_POWERS, 0},
        {"lcg", "1..(2^31-2)/dimension", 2147483646, AUR_SIZES_ANY, 0},
        {"fibonacci-lattice", "1..2^48; a lattice at F_k", UINT64_C(1) << 48, AUR_SIZES_FIBONACCI, 0},
        {"esfg", "1..2^48; base*4^levels times 1, 2, 3, 4 is even", UINT64_C(1) << 48, AUR_SIZES_GRIDS, 0},
        {"t-design", "4, 8, 18, .. 5178", 5178, AUR_SIZES_ANY, 0},
        {"healpix", "12, 48, 108, .. 3377699720527872", UINT64_C(12) << 48, AUR_SIZES_ANY, 0},
        {"file", "up to the file's", UINT64_MAX, AUR_SIZES_ANY, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const aur_set_description *const set = aur_set_find(cases[i].set);
        char text[64];
        assert_int_equal(aur_set_sizes(set, sizeof text, text), strlen(cases[i].text));
        assert_string_equal(text, cases[i].text);
        assert_true(set->maximum_size == cases[i].maximum && set->best_sizes == cases[i].best &&
                    set->size_base == cases[i].base);
    }
    /* The listed sizes of a set are its valid ones, and the last is the largest. */
    static const char *const some[] = {"t-design", "lebedev", "healpix"};
    for (size_t s = 0; s < 3; ++s) {
        const aur_set_description *const set = aur_set_find(some[s]);
        uint64_t last = 0;
        for (size_t i = 0; i < 60 && set->size_at(i) != 0; ++i) {
            aur_directions_options of_size = {.size = sizeof of_size};
            aur_directions_options_init(set->size_at(i), AUR_DOMAIN_SPHERE, &of_size, NULL);
            aur_directions *directions = NULL;
            assert_true(set->size_at(i) > last);
            last = set->size_at(i);
            if (s == 0 && last > 1338)
                continue; /* larger designs take seconds to solve for */
            assert_int_equal(aur_directions_create(some[s], &of_size, &directions, NULL), AUR_OK);
            aur_directions_destroy(directions);
        }
        assert_true(s == 2 || last == set->maximum_size);
    }
    const aur_set_description *const pixels = aur_set_find("healpix");
    assert_int_equal(pixels->size_at((1 << 24) - 1), pixels->maximum_size);
    assert_int_equal(pixels->size_at(1 << 24), 0);
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset_options_init(1073741824, &options, NULL); /* of 2 dimensions */
    aur_pointset *pointset;
    assert_int_equal(aur_pointset_create("lcg", &options, &pointset, NULL), AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_are_lifted_by_the_map),
        cmocka_unit_test(layouts_agree),
        cmocka_unit_test(sets_say_their_sizes),
        cmocka_unit_test(weights_make_rules),
        cmocka_unit_test(ggx_weighs_what_is_above_the_horizon),
        cmocka_unit_test(rotations_are_rotations),
        cmocka_unit_test(scrambling_by_rotation_preserves_the_set),
        cmocka_unit_test(octants_are_filled_evenly),
        cmocka_unit_test(files_are_sets),
        cmocka_unit_test(refuses_what_is_wrong),
        cmocka_unit_test(options_can_grow),
        cmocka_unit_test(table_names_sets_that_exist),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
