/* Two lobes and one merged set: the fast way against the plain one, tables against solves, files against
 * damage. */
#include <aureole/quadrature.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/simd.h"
#include "points/quadrature/potential/potential.h"
#include "points/quadrature/tables/weight_table.h"

#define PI 3.14159265358979323846

static aur_oswa_options pair(double m, bool clipped) {
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = "sobol",
                              .count = 64,
                              .mirror_count = 32,
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = {.exponent = m},
                              .clipped = clipped,
                              .scramble = AUR_SCRAMBLE_DIGIT,
                              .seed = 11};
}

static aur_potential *create(const aur_density *density) {
    aur_potential *potential;
    assert_int_equal(aur_potential_create(density, 1.5, &potential, NULL), AUR_OK);
    return potential;
}

/* The fast method (constant blocks, rotations, hidden samples, clipped z) gives the weights of the plain
 * solve for the same points. */
static void test_solve_is_the_plain_one(void **state) {
    (void)state;
    const double turns[2] = {0.13, 0.77};
    const double degrees[] = {0.0, 35.0, 75.0, 90.0};
    for (int clipped = 0; clipped < 2; ++clipped) {
        const aur_oswa_options options = pair(20.0, clipped);
        aur_oswa *oswa;
        assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
        assert_int_equal(aur_oswa_size(oswa), 96);
        for (size_t d = 0; d < 4; ++d) {
            const double angle = degrees[d] * PI / 180.0;
            double xyz[3 * 96], fast[2 * 96], plain[2 * 96], mass;
            assert_int_equal(aur_oswa_points(oswa, angle, turns, false, 3 * aur_oswa_size(oswa), xyz, NULL),
                             AUR_OK);
            assert_int_equal(aur_oswa_solve(oswa, angle, turns, 2 * aur_oswa_size(oswa), fast, &mass, NULL),
                             AUR_OK);
            const double up = fmax(0.0, cos(angle));
            aur_potential *const diffuse =
                create(&(aur_density){.size = sizeof(aur_density), .exponent = 1.0});
            aur_potential *const glossy = create(&(aur_density){.size = sizeof(aur_density),
                                                                .exponent = 20.0,
                                                                .axis = {-sin(angle), 0.0, up},
                                                                .clipped = clipped});
            const aur_potential *const potentials[] = {diffuse, glossy};
            assert_int_equal(aur_weights_solve(96, xyz, 2, potentials, NULL, 2 * 96, plain, NULL, NULL, NULL),
                             AUR_OK);
            for (int i = 0; i < 2 * 96; ++i)
                assert_near(fast[i], plain[i], 1e-11);
            assert_relative(mass, aur_potential_mass(glossy), 1e-12);
            aur_potential_destroy(diffuse);
            aur_potential_destroy(glossy);
        }
        aur_oswa_destroy(oswa);
    }
}

/* The mirror image of the samples has the same optimal weights. */
static void test_mirror_image(void **state) {
    (void)state;
    const double turns[2] = {0.4, 0.1};
    const aur_oswa_options options = pair(20.0, 1);
    aur_oswa *oswa;
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
    double direct[3 * 96], mirrored[3 * 96], weights[2 * 96], error[2];
    assert_int_equal(aur_oswa_points(oswa, 1.0, turns, false, 3 * aur_oswa_size(oswa), direct, NULL), AUR_OK);
    assert_int_equal(aur_oswa_points(oswa, 1.0, turns, true, 3 * aur_oswa_size(oswa), mirrored, NULL),
                     AUR_OK);
    assert_int_equal(aur_oswa_solve(oswa, 1.0, turns, 2 * aur_oswa_size(oswa), weights, NULL, NULL), AUR_OK);
    aur_potential *const glossy = create(&(aur_density){
        .size = sizeof(aur_density), .exponent = 20.0, .axis = {-sin(1.0), 0.0, cos(1.0)}, .clipped = true});
    assert_true(direct[1] == -mirrored[1] && direct[1] != 0.0);
    aur_worst_case_error(96, direct, weights + 96, glossy, NULL, &error[0], NULL);
    aur_worst_case_error(96, mirrored, weights + 96, glossy, NULL, &error[1], NULL);
    assert_near(error[0], error[1], 1e-13);
    aur_potential_destroy(glossy);
    aur_oswa_destroy(oswa);
}

/* Pairs of neighbouring seeds share no pattern: no uniform height of one is a height of the other. */
static void test_neighbouring_seeds(void **state) {
    (void)state;
    double xyz[2][3 * 96];
    for (uint64_t seed = 0; seed < 2; ++seed) {
        aur_oswa_options options = pair(0.0, 0);
        options.count = options.mirror_count = 48;
        options.lobe.exponent = 0.0;
        options.set = "random";
        options.seed = 7 + seed;
        aur_oswa *oswa;
        assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
        assert_int_equal(aur_oswa_points(oswa, 0.0, (double[2]){0, 0}, false, 3 * 96, xyz[seed], NULL),
                         AUR_OK);
        aur_oswa_destroy(oswa);
    }
    for (size_t i = 0; i < 96; ++i)
        for (size_t j = 0; j < 96; ++j)
            assert_true(xyz[0][3 * i + 2] != xyz[1][3 * j + 2]);
}

/* GGX: samples follow the visible normals at each angle and hidden ones get nothing. */
static void test_ggx(void **state) {
    (void)state;
    aur_oswa_options options = pair(0.0, 0);
    options.mirror_lobe = (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = 0.3};
    aur_oswa *oswa;
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
    const double turns[2] = {0.0, 0.0};
    double xyz[3 * 96], weights[2 * 96], mass, sum = 0.0;
    const double angle = 75.0 * PI / 180.0;
    assert_int_equal(aur_oswa_points(oswa, angle, turns, false, 3 * aur_oswa_size(oswa), xyz, NULL), AUR_OK);
    assert_int_equal(aur_oswa_solve(oswa, angle, turns, 2 * aur_oswa_size(oswa), weights, &mass, NULL),
                     AUR_OK);
    size_t hidden = 0;
    for (int i = 0; i < 96; ++i) {
        sum += weights[96 + i];
        if (xyz[3 * i + 2] < 0.0) {
            ++hidden;
            assert_true(weights[i] == 0.0 && weights[96 + i] == 0.0);
        }
    }
    assert_true(hidden > 0);
    assert_near(sum, 1.0, 1e-12);
    /* Energy is lost by masking only. */
    assert_true(mass > 0.5 && mass < 1.0);
    aur_oswa_destroy(oswa);
}

static void test_published_table(void **state) {
    (void)state;
    aur_potential_table *table;
    assert_int_equal(aur_potential_table_create(
                         &(aur_z_grid){.angle_count = 64, .exponent_count = 32, .largest_exponent = 200.0},
                         1.5, &table, NULL),
                     AUR_OK);
    aur_potential *const potential = create(&(aur_density){.size = sizeof(aur_density), .exponent = 20.0});
    double worst = 0.0;
    for (int i = 0; i <= 100; ++i) {
        const double x = cos(PI * i / 100.0), u[3] = {sin(PI * i / 100.0), 0.0, x};
        double looked_up, exact;
        aur_potential_table_evaluate(table, 20.0, 1, &x, &looked_up);
        aur_potential_evaluate(potential, 1, u, &exact);
        worst = fmax(worst, fabs(looked_up - exact));
    }
    /* Linear interpolation: small, and not nothing. */
    assert_true(worst < 5e-3 && worst > 1e-5);
    /* At a node of both axes it is exact: m = 0 is the first row. */
    const double pole = 1.0;
    double value;
    aur_potential_table_evaluate(table, 0.0, 1, &pole, &value);
    aur_potential *const uniform = create(&(aur_density){.size = sizeof(aur_density), .exponent = 0.0});
    double exact;
    aur_potential_evaluate(uniform, 1, (double[]){0, 0, 1}, &exact);
    assert_near(value, exact, 1e-14);
    aur_potential_destroy(uniform);
    aur_potential_destroy(potential);
    aur_potential_table_destroy(table);
    assert_int_equal(aur_potential_table_create(
                         &(aur_z_grid){.angle_count = 1, .exponent_count = 32, .largest_exponent = 200.0},
                         1.5, &table, NULL),
                     AUR_ERROR_ARGUMENT);
}

static aur_weight_table *build(const aur_oswa_options *options, size_t angles, size_t rotations,
                               size_t threads) {
    aur_weight_table *table;
    assert_int_equal(
        aur_weight_table_build(options,
                               &(aur_weight_table_grid){sizeof(aur_weight_table_grid), angles, 1, rotations},
                               threads, NULL, &table, NULL),
        AUR_OK);
    return table;
}

/* Clipped, too, although samples cross the horizon between the angles of the table.
 *
 * At its own angles a table holds the solves, whatever the threads; between them it loses less than half a
 * percent of the gain, over every angle halfway. */
static void check_table(double m, int clipped, size_t angles) {
    const aur_oswa_options options = pair(m, clipped);
    aur_weight_table *const table = build(&options, angles, 1, 1);
    aur_weight_table *const again = build(&options, angles, 1, 3);
    if (!clipped)
        assert_int_equal(aur_weight_table_rows(table), angles);
    aur_oswa *oswa;
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
    float found[96], other[96];
    double exact[2 * 96], turns[2], xyz[3 * 96], looked_up[96];
    double equal_total = 0.0, optimal_total = 0.0, table_total = 0.0;
    for (size_t i = 0; i + 1 < angles; i += 3) {
        const double node = 0.5 * PI * (double)i / (double)(angles - 1);
        aur_oswa_turns(options.seed, 0, turns);
        assert_int_equal(aur_oswa_solve(oswa, node, turns, 2 * aur_oswa_size(oswa), exact, NULL, NULL),
                         AUR_OK);
        for (size_t lobe = 0; lobe < 2; ++lobe) {
            assert_int_equal(aur_weight_table_look_up(table, lobe, 0, node, 0.0, 96, found, NULL), AUR_OK);
            assert_int_equal(aur_weight_table_look_up(again, lobe, 0, node, 0.0, 96, other, NULL), AUR_OK);
            assert_memory_equal(found, other, sizeof found);
            double sum = 0.0;
            for (size_t k = 0; k < 96; ++k) {
                sum += (double)found[k];
                assert_near(found[k], exact[lobe * 96 + k], 2e-6 + 2e-4 * fabs(exact[lobe * 96 + k]));
            }
            assert_near(sum, 1.0, 1e-6);
        }
        const double angle = node + 0.25 * PI / (double)(angles - 1);
        double errors[3], mass;
        assert_int_equal(aur_oswa_solve(oswa, angle, turns, 2 * aur_oswa_size(oswa), exact, &mass, NULL),
                         AUR_OK);
        assert_int_equal(aur_weight_table_look_up(table, 1, 0, angle, 0.0, 96, found, NULL), AUR_OK);
        assert_int_equal(aur_oswa_points(oswa, angle, turns, false, 3 * aur_oswa_size(oswa), xyz, NULL),
                         AUR_OK);
        size_t visible = 0;
        for (size_t k = 64; k < 96; ++k)
            visible += !clipped || xyz[3 * k + 2] >= 0.0;
        double equal[96] = {0};
        for (size_t k = 0; k < 96; ++k) {
            const int seen = !clipped || xyz[3 * k + 2] >= 0.0;
            looked_up[k] = seen ? (double)found[k] : 0.0;
            equal[k] = k >= 64 && seen ? 1.0 / (double)visible : 0.0;
        }
        aur_potential *const glossy = create(&(aur_density){.size = sizeof(aur_density),
                                                            .exponent = m,
                                                            .axis = {-sin(angle), 0.0, fmax(0.0, cos(angle))},
                                                            .clipped = clipped});
        aur_worst_case_error(96, xyz, exact + 96, glossy, NULL, &errors[0], NULL);
        aur_worst_case_error(96, xyz, looked_up, glossy, NULL, &errors[1], NULL);
        aur_worst_case_error(96, xyz, equal, glossy, NULL, &errors[2], NULL);
        assert_relative(aur_weight_table_mass(table, angle, 0.0), mass, 2e-4);
        optimal_total += errors[0];
        table_total += errors[1];
        equal_total += errors[2];
        aur_potential_destroy(glossy);
    }
    print_message("m %g clipped %d angles %zu: loss %.3f %% of the gain\n", m, clipped, angles,
                  100.0 * (table_total - optimal_total) / (equal_total - optimal_total));
    assert_true(table_total - optimal_total < 0.005 * (equal_total - optimal_total));
    aur_oswa_destroy(oswa);
    aur_weight_table_destroy(table);
    aur_weight_table_destroy(again);
}

static void test_table(void **state) {
    (void)state;
    check_table(20.0, 0, 32);
    check_table(200.0, 0, 64);
    check_table(20.0, 1, 32);
    check_table(20.0, 1, 128);
    check_table(200.0, 1, 64);
}

/* More threads than cores, so that they are interrupted anywhere: every table has the same bits. */
static void test_threads(void **state) {
    (void)state;
    const aur_oswa_options options = pair(20.0, 0);
    aur_weight_table *const one = build(&options, 32, 8, 1);
    const size_t floats = 2 * (options.count + options.mirror_count);
    for (size_t repeat = 0; repeat < 25; ++repeat) {
        aur_weight_table *const many = build(&options, 32, 8, 8);
        for (size_t row = 0; row < aur_weight_table_rows(one); ++row)
            assert_memory_equal(aur_weight_table_row(one, row), aur_weight_table_row(many, row),
                                floats * sizeof(float));
        aur_weight_table_destroy(many);
    }
    aur_weight_table_destroy(one);
}

static void write_file(const char *path, const char *data, size_t size) {
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_file(void **state) {
    (void)state;
    const char *const path = "weights.table";
    const aur_oswa_options options = pair(20.0, 1);
    aur_weight_table *const table = build(&options, 5, 3, 0);
    assert_int_equal(aur_weight_table_save(table, path, NULL), AUR_OK);
    aur_weight_table *loaded;
    aur_error error;
    assert_int_equal(aur_weight_table_load(path, &options, &loaded, &error), AUR_OK);
    assert_int_equal(aur_weight_table_angles(loaded), 5);
    assert_int_equal(aur_weight_table_rotations(loaded), 3);
    assert_string_equal(aur_weight_table_options(loaded)->set, "sobol");
    for (size_t rotation = 0; rotation < 3; ++rotation) {
        float a[96], b[96];
        double first[3 * 96], second[3 * 96];
        assert_int_equal(aur_weight_table_look_up(table, 1, rotation, 0.7, 0.0, 96, a, NULL), AUR_OK);
        assert_int_equal(aur_weight_table_look_up(loaded, 1, rotation, 0.7, 0.0, 96, b, NULL), AUR_OK);
        assert_memory_equal(a, b, sizeof a);
        assert_int_equal(aur_weight_table_points(table, 0.7, 0.0, rotation, false, 3 * 96, first, NULL),
                         AUR_OK);
        assert_int_equal(aur_weight_table_points(loaded, 0.7, 0.0, rotation, false, 3 * 96, second, NULL),
                         AUR_OK);
        assert_memory_equal(first, second, sizeof first);
    }
    assert_true(aur_weight_table_mass(loaded, 0.3, 0.0) == aur_weight_table_mass(table, 0.3, 0.0));
    /* Anything outside the table, or incompatible, is rejected. */
    const struct {
        size_t lobe, rotation, capacity;
        double radians;
        aur_result result;
    } requests[] = {
        {1, 2, 96, 0.5 * PI, AUR_OK},         {2, 2, 96, 0.7, AUR_ERROR_ARGUMENT},
        {1, 3, 96, 0.7, AUR_ERROR_ARGUMENT},  {1, SIZE_MAX, 96, 0.7, AUR_ERROR_ARGUMENT},
        {1, 2, 95, 0.7, AUR_ERROR_CAPACITY},  {1, 2, 96, 9.0, AUR_ERROR_ARGUMENT},
        {1, 2, 96, -0.1, AUR_ERROR_ARGUMENT}, {1, 2, 96, (double)NAN, AUR_ERROR_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof requests / sizeof requests[0]; ++i) {
        float found[96];
        double xyz[3 * 96];
        assert_int_equal(aur_weight_table_look_up(loaded, requests[i].lobe, requests[i].rotation,
                                                  requests[i].radians, 0.0, requests[i].capacity, found,
                                                  &error),
                         requests[i].result);
        if (requests[i].lobe < 2)
            assert_int_equal(aur_weight_table_points(loaded, requests[i].radians, 0.0, requests[i].rotation,
                                                     false, 3 * requests[i].capacity, xyz, &error),
                             requests[i].result);
    }
    assert_true(aur_weight_table_mass(loaded, 9.0, 0.0) == aur_weight_table_mass(loaded, 0.5 * PI, 0.0));
    aur_weight_table_destroy(loaded);
    aur_weight_table_destroy(table);

    /* Another set, other options: the message states which. */
    aur_oswa_options other = options;
    other.set = "halton";
    assert_int_equal(aur_weight_table_load(path, &other, &loaded, &error), AUR_ERROR_FORMAT);
    assert_null(loaded);
    assert_non_null(strstr(error.message, "'sobol', not 'halton'"));
    other = options;
    other.mirror_lobe.exponent = 21.0;
    assert_int_equal(aur_weight_table_load(path, &other, &loaded, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "exponent of the mirror lobe: 20, not 21"));
    other = options;
    other.seed = 12;
    assert_int_equal(aur_weight_table_load(path, &other, &loaded, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "seed"));

    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    static char data[1 << 18];
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    /* Another version. */
    char *const version = strstr(data, "version 3");
    version[8] = '7';
    write_file("other.table", data, size);
    assert_int_equal(aur_weight_table_load("other.table", NULL, &loaded, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "version 7; this program reads version 3"));
    version[8] = '3';
    /* Any byte that is turned is noticed, and every length that is cut. */
    for (size_t i = 0; i < size; i += 397) {
        data[i] ^= 0x10;
        write_file("other.table", data, size);
        assert_int_equal(aur_weight_table_load("other.table", NULL, &loaded, &error), AUR_ERROR_FORMAT);
        data[i] ^= 0x10;
    }
    for (size_t cut = 0; cut < size; cut += 1301) {
        write_file("other.table", data, cut);
        assert_int_equal(aur_weight_table_load("other.table", NULL, &loaded, &error), AUR_ERROR_FORMAT);
    }
    assert_int_equal(aur_weight_table_load("no-such.table", NULL, &loaded, &error), AUR_ERROR_OPEN);
    remove(path);
    remove("other.table");
}

static int stop(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)total;
    size_t *const calls = user;
    ++*calls;
    return done >= 3;
}

static void test_build_errors(void **state) {
    (void)state;
    aur_oswa_options options = pair(20.0, 0);
    aur_weight_table *table;
    aur_error error;
    size_t calls = 0;
    const aur_progress progress = {stop, &calls};
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 16, 1, 1},
                                            1, &progress, &table, &error),
                     AUR_ERROR_CANCELLED);
    assert_null(table);
    assert_int_equal(calls, 3);
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 1, 1, 1},
                                            1, NULL, &table, &error),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 16, 1, 0},
                                            1, NULL, &table, &error),
                     AUR_ERROR_ARGUMENT);
    options.lobe = (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = 0.5};
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 16, 1, 1},
                                            1, NULL, &table, &error),
                     AUR_ERROR_UNSUPPORTED);
    options = pair(20.0, 0);
    options.set = "sobl";
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 16, 1, 1},
                                            1, NULL, &table, &error),
                     AUR_ERROR_NAME);
    options = pair(20.0, 0);
    const aur_weights_options negative = {.size = sizeof negative, .regularization = -1.0};
    options.weights = &negative;
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 16, 1, 1},
                                            1, NULL, &table, &error),
                     AUR_ERROR_ARGUMENT);
    options = pair(20.0, 0);
    aur_oswa *oswa;
    double weights[2 * 96];
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
    assert_int_equal(
        aur_oswa_solve(oswa, -0.1, (double[2]){0, 0}, 2 * aur_oswa_size(oswa), weights, NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_int_equal(
        aur_oswa_solve(oswa, (double)NAN, (double[2]){0, 0}, 2 * aur_oswa_size(oswa), weights, NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_oswa_solve(oswa, 0.1, (double[2]){0, 0}, 2 * 96 - 1, weights, NULL, &error),
                     AUR_ERROR_CAPACITY);
    double xyz[3 * 96];
    assert_int_equal(aur_oswa_points(oswa, (double)NAN, (double[2]){0, 0}, false, 3 * 96, xyz, &error),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_oswa_points(oswa, 0.1, (double[2]){0, 0}, false, 3 * 96 - 1, xyz, &error),
                     AUR_ERROR_CAPACITY);
    aur_oswa_destroy(oswa);
}

/* The kernels that this processor can run give the bits of the formula, and write nothing behind the end. */
static void test_blend(void **state) {
    (void)state;
    enum { MOST = 67 };
    aur_weight_blend *kernels[3] = {aur_weight_blend_portable};
#if !defined(AUR_PORTABLE)
    kernels[1] = aur_isa_available() >= AUR_ISA_AVX2 ? aur_weight_blend_avx2 : NULL;
    kernels[2] = aur_isa_available() >= AUR_ISA_AVX512 ? aur_weight_blend_avx512 : NULL;
#endif
    float rows[2 * MOST], found[MOST + 1];
    for (size_t i = 0; i < 2 * MOST; ++i)
        rows[i] = cosf((float)(i * i));
    for (size_t kernel = 0; kernel < 3; ++kernel)
        for (size_t count = 0; kernels[kernel] != NULL && count <= MOST; ++count) {
            const float part = (float)count / 41.0f;
            found[count] = 7.0f;
            kernels[kernel](count, rows, rows + MOST, part, found);
            for (size_t i = 0; i < count; ++i) {
                const float expected = rows[i] + part * (rows[MOST + i] - rows[i]);
                assert_memory_equal(&found[i], &expected, sizeof expected);
            }
            assert_true(found[count] == 7.0f);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solve_is_the_plain_one),
        cmocka_unit_test(test_mirror_image),
        cmocka_unit_test(test_neighbouring_seeds),
        cmocka_unit_test(test_ggx),
        cmocka_unit_test(test_published_table),
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_blend),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_file),
        cmocka_unit_test(test_build_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
