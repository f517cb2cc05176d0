/* Tables of weights of GGX lobes over angle and roughness: against the systems that they tabulate, through
 * files, and invalid input. */
#include <aureole/quadrature.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/random.h"
#include "points/quadrature/tables/weight_table.h"

#define PI 3.14159265358979323846

enum { GLOSSY = 24, DIFFUSE = 16, MOST = GLOSSY + DIFFUSE };

static aur_oswa_options pattern(size_t diffuse, double alpha) {
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .count = diffuse,
                              .mirror_count = GLOSSY,
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = {.kind = AUR_LOBE_GGX, .alpha = alpha},
                              .seed = 3};
}

static aur_weight_table_grid grid_of(size_t angles, size_t roughnesses, size_t rotations) {
    return (aur_weight_table_grid){sizeof(aur_weight_table_grid), angles, roughnesses, rotations};
}

static aur_weight_table *build(const aur_oswa_options *options, aur_weight_table_grid grid, size_t threads) {
    aur_weight_table *table;
    assert_int_equal(aur_weight_table_build(options, &grid, threads, NULL, &table, NULL), AUR_OK);
    return table;
}

static aur_potential *potential_of(double alpha, double radians) {
    const aur_density density = {.size = sizeof density,
                                 .kind = AUR_DENSITY_GGX,
                                 .alpha = alpha,
                                 .view_degrees = fmin(radians * 180.0 / PI, 89.99)};
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, NULL), AUR_OK);
    return potential;
}

/* Between the nodes of the grid a look-up is a set of weights nearly as good for the lobe that is looked at
 * as the system's: of sum 1, none below the surface. Its worst-case error, which the system makes as small as
 * can be, is 1.0 % above the least on average and 6 % at most over these views (interpolation is linear: a
 * fifth of that with 24 roughnesses); that of p/q is 11 % above on average. */
static void test_interpolation(void **state) {
    (void)state;
    const aur_oswa_options options = pattern(0, 0.05);
    aur_weight_table *const table = build(&options, grid_of(16, 12, 2), 2);
    double sums[3] = {0.0}, worst = 0.0;
    enum { TRIALS = 24 };
    for (uint64_t attempt = 0; attempt < TRIALS; ++attempt) {
        const uint64_t hash = aur_hash2(7, attempt);
        const double radians = 0.5 * PI * aur_unit_double(hash),
                     alpha = pow(0.05, aur_unit_double(aur_mix64(hash)));
        double xyz[3 * GLOSSY], weights[3][GLOSSY], errors[3], sum = 0.0;
        float found[GLOSSY];
        assert_int_equal(
            aur_weight_table_points(table, radians, alpha, attempt % 2, false, 3 * GLOSSY, xyz, NULL),
            AUR_OK);
        assert_int_equal(aur_weight_table_look_up(table, 1, attempt % 2, radians, alpha, GLOSSY, found, NULL),
                         AUR_OK);
        aur_potential *const potential = potential_of(alpha, radians);
        const aur_potential *const one = potential;
        assert_int_equal(aur_weights_solve(GLOSSY, xyz, 1, &one, NULL, GLOSSY, weights[0], NULL, NULL, NULL),
                         AUR_OK);
        const aur_lobe lobe = {
            .kind = AUR_LOBE_GGX, .alpha = alpha, .view_degrees = fmin(radians * 180.0 / PI, 89.99)};
        double densities[GLOSSY];
        assert_int_equal(aur_potential_density(potential, GLOSSY, xyz, densities, NULL), AUR_OK);
        for (size_t i = 0; i < GLOSSY; ++i) {
            const double *const u = xyz + 3 * i;
            weights[1][i] = (double)found[i];
            weights[2][i] = u[2] > 0.0 ? densities[i] / (aur_lobe_pdf(&lobe, u) * GLOSSY) : 0.0;
            assert_true(u[2] >= 0.0 || found[i] == 0.0f);
            sum += (double)found[i];
        }
        assert_near(sum, 1.0, 1e-6);
        for (size_t k = 0; k < 3; ++k) {
            assert_int_equal(aur_worst_case_error(GLOSSY, xyz, weights[k], potential, NULL, &errors[k], NULL),
                             AUR_OK);
            sums[k] += errors[k] / errors[0];
        }
        worst = fmax(worst, errors[1] / errors[0]);
        aur_potential_destroy(potential);
    }
    assert_true(worst < 1.08);
    assert_true(sums[1] / TRIALS < 1.02);
    assert_true(sums[2] / TRIALS > 1.08);
    aur_weight_table_destroy(table);
}

/* At nodes of the grid a look-up equals the system's solution, also for samples merged with a diffuse lobe's;
 * masses are those of the lobe. */
static void test_nodes(void **state) {
    (void)state;
    const size_t roughnesses = 3, angles = 5;
    const double least = 0.1;
    for (size_t diffuse = 0; diffuse <= DIFFUSE; diffuse += DIFFUSE) {
        const aur_oswa_options options = pattern(diffuse, least);
        aur_weight_table *const table = build(&options, grid_of(angles, roughnesses, 2), 1);
        aur_weight_table *const again = build(&options, grid_of(angles, roughnesses, 2), 3);
        const size_t size = diffuse + GLOSSY, lobes = diffuse > 0 ? 2 : 1;
        assert_int_equal(aur_weight_table_roughnesses(table), roughnesses);
        assert_int_equal(aur_weight_table_rows(table), aur_weight_table_rows(again));
        for (size_t row = 0; row < aur_weight_table_rows(table); ++row)
            assert_memory_equal(aur_weight_table_row(table, row), aur_weight_table_row(again, row),
                                lobes * size * sizeof(float));
        for (size_t node = 0; node < roughnesses * (angles - 1); ++node) {
            const double radians = 0.5 * PI * (double)(node % (angles - 1)) / (double)(angles - 1);
            const size_t roughness = node / (angles - 1);
            const double alpha =
                roughness + 1 < roughnesses ? pow(least, 1.0 - 0.5 * (double)roughness) : 1.0;
            const aur_oswa_options one = pattern(diffuse, alpha);
            double turns[2], exact[2 * MOST], mass;
            float found[MOST];
            aur_oswa *oswa;
            aur_oswa_turns(options.seed, 1, turns);
            assert_int_equal(aur_oswa_create(&one, &oswa, NULL), AUR_OK);
            assert_int_equal(aur_oswa_solve(oswa, radians, turns, lobes * size, exact, &mass, NULL), AUR_OK);
            for (size_t lobe = 0; lobe < lobes; ++lobe) {
                assert_int_equal(
                    aur_weight_table_look_up(table, lobe + 2 - lobes, 1, radians, alpha, size, found, NULL),
                    AUR_OK);
                for (size_t i = 0; i < size; ++i)
                    assert_near(found[i], exact[lobe * size + i], 1e-5);
            }
            assert_relative(aur_weight_table_mass(table, radians, alpha), mass, 1e-5);
            aur_oswa_destroy(oswa);
        }
        aur_weight_table_destroy(table);
        aur_weight_table_destroy(again);
    }
}

/* A table read from a file gives the look-ups of the written one. */
static void test_file(void **state) {
    (void)state;
    const char *const path = "roughness.table";
    const aur_oswa_options options = pattern(0, 0.2);
    aur_weight_table *const table = build(&options, grid_of(4, 3, 2), 1), *loaded;
    aur_error error;
    assert_int_equal(aur_weight_table_save(table, path, NULL), AUR_OK);
    assert_int_equal(aur_weight_table_load(path, &options, &loaded, &error), AUR_OK);
    assert_int_equal(aur_weight_table_roughnesses(loaded), 3);
    for (size_t i = 0; i < 12; ++i) {
        float a[GLOSSY], b[GLOSSY];
        const double radians = 0.13 * (double)i, alpha = 0.2 + 0.07 * (double)i;
        assert_int_equal(aur_weight_table_look_up(table, 1, i % 2, radians, alpha, GLOSSY, a, NULL), AUR_OK);
        assert_int_equal(aur_weight_table_look_up(loaded, 1, i % 2, radians, alpha, GLOSSY, b, NULL), AUR_OK);
        assert_memory_equal(a, b, sizeof a);
        assert_true(aur_weight_table_mass(table, radians, alpha) ==
                    aur_weight_table_mass(loaded, radians, alpha));
    }
    aur_oswa_options other = options;
    other.mirror_lobe.alpha = 0.3;
    aur_weight_table *refused;
    assert_int_equal(aur_weight_table_load(path, &other, &refused, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "roughness of the mirror lobe: 0.2, not 0.3"));
    aur_weight_table_destroy(loaded);
    aur_weight_table_destroy(table);
    remove(path);
}

static void test_refusals(void **state) {
    (void)state;
    aur_error error;
    aur_weight_table *table;
    aur_oswa_options options = pattern(0, 0.2);
    const aur_weight_table_grid bad[] = {grid_of(4, 0, 1), grid_of(4, 257, 1), grid_of(1, 2, 1)};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        assert_int_equal(aur_weight_table_build(&options, &bad[i], 1, NULL, &table, &error),
                         AUR_ERROR_ARGUMENT);
    const aur_weight_table_grid grid = grid_of(3, 2, 1);
    options.mirror_lobe.alpha = 1.0;
    assert_int_equal(aur_weight_table_build(&options, &grid, 1, NULL, &table, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "below 1"));
    options = pattern(1, 0.2);
    options.mirror_lobe = (aur_lobe){.exponent = 20.0};
    assert_int_equal(aur_weight_table_build(&options, &grid, 1, NULL, &table, &error), AUR_ERROR_ARGUMENT);
    options.count = 0; /* only a ggx lobe may be single */
    assert_int_equal(aur_weight_table_build(&options, NULL, 1, NULL, &table, &error), AUR_ERROR_ARGUMENT);
    options = pattern(0, 0.2);
    assert_int_equal(aur_weight_table_build(&options, &grid, 1, NULL, &table, &error), AUR_OK);
    float found[GLOSSY];
    double xyz[3 * GLOSSY];
    const double alphas[] = {0.19, 1.01, 0.0, NAN};
    for (size_t i = 0; i < sizeof alphas / sizeof alphas[0]; ++i) {
        assert_int_equal(aur_weight_table_look_up(table, 1, 0, 0.5, alphas[i], GLOSSY, found, &error),
                         AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "roughnesses from 0.2 to 1"));
        assert_int_equal(aur_weight_table_points(table, 0.5, alphas[i], 0, false, 3 * GLOSSY, xyz, &error),
                         AUR_ERROR_ARGUMENT);
    }
    assert_int_equal(aur_weight_table_look_up(table, 0, 0, 0.5, 0.5, GLOSSY, found, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "lobe 1 alone"));
    aur_weight_table_destroy(table);
    /* One sample, which is below the surface at some views: there the table has no weight. */
    options.mirror_count = 1;
    assert_int_equal(aur_weight_table_build(&options, &grid, 1, NULL, &table, &error), AUR_OK);
    for (size_t i = 0; i < 16; ++i) {
        assert_int_equal(
            aur_weight_table_look_up(table, 1, 0, 0.5 * PI * (double)i / 15.0, 0.9, 1, found, NULL), AUR_OK);
        assert_true(found[0] == 0.0f || found[0] == 1.0f);
    }
    aur_weight_table_destroy(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_interpolation),
        cmocka_unit_test(test_nodes),
        cmocka_unit_test(test_file),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
