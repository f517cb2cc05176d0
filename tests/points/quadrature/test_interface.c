/* Every public function of quadrature.h once with good input and once with bad: NULL where allowed, no work,
 * unset sizes, values out of range and buffers that are too small. Results are tested elsewhere. */
#include "check.h"

#include <aureole/quadrature.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { COUNT = 12, MIRROR_COUNT = 5, SIZE = COUNT + MIRROR_COUNT };

/* A function has rejected its input with this result and a message. */
static void assert_refused(aur_result result, aur_result expected, const aur_error *error) {
    assert_int_equal(result, expected);
    assert_int_equal(error->result, expected);
    assert_true(error->message[0] != '\0');
}

static aur_potential *cosine_potential(void) {
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    density.exponent = 1.0;
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&density, 0.0, &potential, NULL), AUR_OK);
    return potential;
}

static void fill_points(double xyz[3 * COUNT]) {
    aur_directions *directions;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(COUNT, AUR_DOMAIN_HEMISPHERE, &options, NULL);
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, NULL), AUR_OK);
    assert_int_equal(aur_directions_points(directions, 0, COUNT, 3 * COUNT, xyz, NULL, NULL), AUR_OK);
    aur_directions_destroy(directions);
}

static void test_densities(void **state) {
    (void)state;
    aur_error error;
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    const aur_lobe cosine = {.exponent = 1.0}, ggx = {.kind = AUR_LOBE_GGX, .alpha = 0.3};
    assert_int_equal(aur_density_from_lobe(&ggx, AUR_DOMAIN_HEMISPHERE, &density, NULL), AUR_OK);
    assert_true(density.kind == AUR_DENSITY_GGX && density.alpha == 0.3);
    assert_int_equal(aur_density_from_lobe(&(aur_lobe){0}, AUR_DOMAIN_SPHERE, &density, NULL), AUR_OK);
    assert_int_equal(density.kind, AUR_DENSITY_SPHERE);
    assert_refused(aur_density_from_lobe(&cosine, AUR_DOMAIN_SPHERE, &density, &error), AUR_ERROR_UNSUPPORTED,
                   &error);
    assert_refused(aur_density_from_lobe(&cosine, AUR_DOMAIN_SQUARE, &density, &error), AUR_ERROR_UNSUPPORTED,
                   &error);
    density.size = 0;
    assert_refused(aur_density_from_lobe(&cosine, AUR_DOMAIN_HEMISPHERE, &density, &error),
                   AUR_ERROR_ARGUMENT, &error);

    aur_potential *potential = NULL;
    const double nan = (double)NAN, up[3] = {0.0, 0.0, 1.0};
    const struct {
        aur_density density;
        double smoothness;
    } bad[] = {
        {{.size = 0}, 1.5},
        {{.size = sizeof density, .kind = (aur_density_kind)99}, 1.5},
        {{.size = sizeof density}, 1.0},
        {{.size = sizeof density}, 2.0},
        {{.size = sizeof density}, nan},
        {{.size = sizeof density, .exponent = -1.0}, 1.5},
        {{.size = sizeof density, .exponent = nan}, 1.5},
        {{.size = sizeof density, .axis = {0.0, 0.0, 2.0}}, 1.5},
        {{.size = sizeof density, .axis = {0.0, 0.0, -1.0}, .clipped = true}, 1.5},
        {{.size = sizeof density, .kind = AUR_DENSITY_GGX, .alpha = 0.0}, 1.5},
        {{.size = sizeof density, .kind = AUR_DENSITY_FUNCTION}, 1.5},
        {{.size = sizeof density, .kind = AUR_DENSITY_NODES}, 1.5},
        {{.size = sizeof density, .kind = AUR_DENSITY_NODES, .node_count = 1, .nodes = up, .masses = &nan},
         1.5},
        {{.size = sizeof density, .kind = AUR_DENSITY_NODES, .node_count = SIZE_MAX, .nodes = up}, 1.5},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        assert_refused(aur_potential_create(&bad[i].density, bad[i].smoothness, &potential, &error),
                       AUR_ERROR_ARGUMENT, &error);
        assert_null(potential);
    }
    aur_potential_destroy(NULL);
}

static void test_potentials(void **state) {
    (void)state;
    aur_error error;
    aur_potential *const potential = cosine_potential();
    const double up[3] = {0.0, 0.0, 1.0}, nowhere[3] = {(double)NAN, 0.0, 0.0};
    double z = 7.0, energy, density;
    assert_true(aur_potential_smoothness(potential) == 1.5);
    assert_near(aur_potential_mass(potential), PI, 1e-15);
    assert_int_equal(aur_potential_density(potential, 1, up, &density, NULL), AUR_OK);
    assert_near(density, 1.0 / PI, 1e-15);
    assert_true(aur_potential_self_energy(potential) > 0.0);
    aur_potential_evaluate(potential, 0, up, &z);
    assert_true(z == 7.0);
    aur_potential_evaluate(potential, 1, up, &z);
    assert_true(z > 0.0 && z < aur_kernel(1.5, 0.0));
    aur_potential_evaluate(potential, 1, nowhere, &z);
    assert_true(isnan(z));
    assert_int_equal(aur_cross_energy(1.0, 1.0, 1.0, 1.5, &energy, NULL), AUR_OK);
    assert_relative(energy, aur_potential_self_energy(potential), 1e-12);
    assert_refused(aur_cross_energy(1.0, 1.0, 1.5, 1.5, &energy, &error), AUR_ERROR_ARGUMENT, &error);
    assert_refused(aur_cross_energy(1.0, -1.0, 1.0, 1.5, &energy, &error), AUR_ERROR_ARGUMENT, &error);
    /* 2^{2s-1}/s - 2^{2s-2} at the opposite point: 8/3 - 2. */
    assert_near(aur_kernel(1.5, 2.0), 2.0 / 3.0, 1e-15);
    assert_true(isnan(aur_kernel(1.5, 2.1)) && isnan(aur_kernel(1.5, -0.1)) && isnan(aur_kernel(2.0, 1.0)));
    aur_potential_destroy(potential);
}

static void test_weights(void **state) {
    (void)state;
    aur_error error;
    aur_potential *const potential = cosine_potential();
    const aur_potential *const one = potential;
    double xyz[3 * COUNT], weights[COUNT], value, condition;
    aur_weights_report report;
    fill_points(xyz);
    assert_int_equal(aur_weights_solve(COUNT, xyz, 1, &one, NULL, COUNT, weights, &report, &condition, NULL),
                     AUR_OK);
    assert_int_equal(report.visible, COUNT);
    assert_near(report.weight_sum, 1.0, 1e-14);
    assert_int_equal(aur_worst_case_error(COUNT, xyz, weights, potential, NULL, &value, NULL), AUR_OK);
    assert_relative(value, report.optimal_error, 1e-9);
    assert_int_equal(aur_worst_case_error(COUNT, xyz, NULL, potential, NULL, &value, NULL), AUR_OK);
    assert_relative(value, report.equal_error, 1e-9);

    aur_weights_options unset = {.size = sizeof unset};
    aur_weights_options_init(&unset, NULL);
    aur_weights_options negative = unset;
    unset.size = 0;
    negative.regularization = -1.0;
    const double off[3] = {0.0, 0.0, 1.1};
    const struct {
        size_t count;
        const double *xyz;
        size_t potential_count;
        const aur_weights_options *options;
        size_t capacity;
        aur_result result;
    } bad[] = {
        {0, xyz, 1, NULL, COUNT, AUR_ERROR_ARGUMENT},
        {COUNT, xyz, 0, NULL, COUNT, AUR_ERROR_ARGUMENT},
        {1, off, 1, NULL, COUNT, AUR_ERROR_ARGUMENT},
        {COUNT, xyz, 1, &unset, COUNT, AUR_ERROR_ARGUMENT},
        {COUNT, xyz, 1, &negative, COUNT, AUR_ERROR_ARGUMENT},
        {COUNT, xyz, 1, NULL, COUNT - 1, AUR_ERROR_CAPACITY},
        {COUNT, xyz, 1, NULL, 0, AUR_ERROR_CAPACITY},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        assert_refused(aur_weights_solve(bad[i].count, bad[i].xyz, bad[i].potential_count, &one,
                                         bad[i].options, bad[i].capacity, weights, NULL, NULL, &error),
                       bad[i].result, &error);
    assert_refused(aur_worst_case_error(0, xyz, NULL, potential, NULL, &value, &error), AUR_ERROR_ARGUMENT,
                   &error);
    weights[3] = (double)NAN;
    assert_refused(aur_worst_case_error(COUNT, xyz, weights, potential, NULL, &value, &error),
                   AUR_ERROR_ARGUMENT, &error);
    aur_potential_destroy(potential);
}

static void test_rules(void **state) {
    (void)state;
    aur_error error;
    double xyz[3 * COUNT], weights[COUNT];
    aur_directions_options points = {.size = sizeof points};
    aur_directions_options_init(COUNT, AUR_DOMAIN_HEMISPHERE, &points, NULL);
    aur_rule_options options = {.size = sizeof options};
    aur_rule_options_init(&points, &options, NULL);
    assert_int_equal(aur_rule_make(&options, 3 * COUNT, xyz, weights, NULL), AUR_OK);
    assert_near(weights[0], 1.0 / COUNT, 1e-16);
    options.optimal = true;
    assert_int_equal(aur_rule_make(&options, 3 * COUNT, xyz, weights, NULL), AUR_OK);
    assert_refused(aur_rule_make(&options, 3 * COUNT - 1, xyz, weights, &error), AUR_ERROR_CAPACITY, &error);
    aur_rule_options bad = options;
    bad.size = 0;
    assert_refused(aur_rule_make(&bad, 3 * COUNT, xyz, weights, &error), AUR_ERROR_ARGUMENT, &error);
    bad = options;
    bad.points = NULL;
    assert_refused(aur_rule_make(&bad, 3 * COUNT, xyz, weights, &error), AUR_ERROR_ARGUMENT, &error);
    bad = options;
    bad.set = "no-such-set";
    assert_refused(aur_rule_make(&bad, 3 * COUNT, xyz, weights, &error), AUR_ERROR_NAME, &error);

    assert_int_equal(aur_weights_write("weights.csv", AUR_DOMAIN_SPHERE, COUNT, xyz, 1, weights, NULL),
                     AUR_OK);
    remove("weights.csv");
    assert_refused(
        aur_weights_write("no-such-folder/weights.csv", AUR_DOMAIN_SPHERE, COUNT, xyz, 1, weights, &error),
        AUR_ERROR_WRITE, &error);
}

static aur_oswa_options pair(void) {
    aur_oswa_options options = {.size = sizeof options};
    aur_oswa_options_init(COUNT, MIRROR_COUNT, &options, NULL);
    options.lobe.exponent = 1.0;
    options.mirror_lobe.exponent = 20.0;
    options.clipped = true;
    return options;
}

static void test_pairs(void **state) {
    (void)state;
    aur_error error;
    aur_oswa *oswa;
    double turns[2], xyz[3 * SIZE], weights[2 * SIZE], mass;
    aur_oswa_options options = pair();
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
    assert_int_equal(aur_oswa_size(oswa), SIZE);
    aur_oswa_turns(1, 2, turns);
    assert_true(turns[0] >= 0.0 && turns[0] < 1.0 && turns[1] >= 0.0 && turns[1] < 1.0);
    assert_int_equal(aur_oswa_points(oswa, 0.5, turns, false, 3 * SIZE, xyz, NULL), AUR_OK);
    assert_int_equal(aur_oswa_solve(oswa, 0.5, turns, 2 * SIZE, weights, &mass, NULL), AUR_OK);
    assert_int_equal(aur_oswa_solve(oswa, 0.5, turns, 2 * SIZE, weights, NULL, NULL), AUR_OK);
    assert_true(mass > 0.0);
    assert_refused(aur_oswa_points(oswa, 0.5, turns, false, 3 * SIZE - 1, xyz, &error), AUR_ERROR_CAPACITY,
                   &error);
    assert_refused(aur_oswa_points(oswa, 2.0, turns, false, 3 * SIZE, xyz, &error), AUR_ERROR_ARGUMENT,
                   &error);
    assert_refused(aur_oswa_solve(oswa, 0.5, turns, 2 * SIZE - 1, weights, NULL, &error), AUR_ERROR_CAPACITY,
                   &error);
    assert_refused(aur_oswa_solve(oswa, -1.0, turns, 2 * SIZE, weights, NULL, &error), AUR_ERROR_ARGUMENT,
                   &error);
    aur_oswa_destroy(oswa);
    aur_oswa_destroy(NULL);

    const struct {
        aur_oswa_options options;
        aur_result result;
    } bad[] = {
        {{.size = 0}, AUR_ERROR_ARGUMENT},
        {{.size = sizeof options, .count = 1}, AUR_ERROR_ARGUMENT},
        {{.size = sizeof options, .count = 1, .mirror_count = 1, .lobe.kind = AUR_LOBE_GGX},
         AUR_ERROR_ARGUMENT},
        {{.size = sizeof options, .count = 1, .mirror_count = 1, .smoothness = 3.0}, AUR_ERROR_ARGUMENT},
        {{.size = sizeof options, .count = 1, .mirror_count = 1, .published_z = {.angle_count = 1}},
         AUR_ERROR_ARGUMENT},
        {{.size = sizeof options, .count = 1, .mirror_count = 1, .clipped = true, .published_z = {2, 2, 1.0}},
         AUR_ERROR_UNSUPPORTED},
        {{.size = sizeof options, .count = 1, .mirror_count = 1, .set = "no-such-set"}, AUR_ERROR_NAME},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        assert_refused(aur_oswa_create(&bad[i].options, &oswa, &error), bad[i].result, &error);
        assert_null(oswa);
    }
}

static void test_tables(void **state) {
    (void)state;
    const char *const path = "interface.table";
    aur_error error;
    aur_weight_table *table, *loaded;
    aur_oswa_options options = pair();
    float weights[SIZE];
    double xyz[3 * SIZE];
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 3, 1, 2},
                                            1, NULL, &table, NULL),
                     AUR_OK);
    assert_int_equal(aur_weight_table_angles(table), 3);
    assert_int_equal(aur_weight_table_roughnesses(table), 1);
    assert_int_equal(aur_weight_table_rotations(table), 2);
    const size_t rows = aur_weight_table_rows(table); /* two ends of at least one piece an interval */
    assert_true(rows >= 2 * 2 * (3 - 1) && rows % 2 == 0);
    assert_int_equal(aur_weight_table_options(table)->size, sizeof options);
    assert_true(aur_weight_table_options(table)->weights->regularization == AUR_REGULARIZATION_DEFAULT);
    assert_int_equal(aur_weight_table_points(table, 0.5, 0.0, 1, true, 3 * SIZE, xyz, NULL), AUR_OK);
    assert_int_equal(aur_weight_table_look_up(table, 1, 1, 0.5, 0.0, SIZE, weights, NULL), AUR_OK);
    assert_true(aur_weight_table_mass(table, 0.5, 0.0) > 0.0);
    assert_refused(aur_weight_table_points(table, 0.5, 0.0, 2, true, 3 * SIZE, xyz, &error),
                   AUR_ERROR_ARGUMENT, &error);
    assert_refused(aur_weight_table_points(table, 0.5, 0.0, 1, true, 3 * SIZE - 1, xyz, &error),
                   AUR_ERROR_CAPACITY, &error);
    assert_refused(aur_weight_table_look_up(table, 2, 1, 0.5, 0.0, SIZE, weights, &error), AUR_ERROR_ARGUMENT,
                   &error);
    assert_refused(aur_weight_table_look_up(table, 1, 1, 0.5, 0.0, SIZE - 1, weights, &error),
                   AUR_ERROR_CAPACITY, &error);
    assert_int_equal(aur_weight_table_save(table, path, NULL), AUR_OK);
    assert_refused(aur_weight_table_save(table, "no-such-folder/table", &error), AUR_ERROR_WRITE, &error);
    aur_weight_table_destroy(table);
    aur_weight_table_destroy(NULL);

    assert_int_equal(aur_weight_table_load(path, NULL, &loaded, NULL), AUR_OK);
    aur_weight_table_destroy(loaded);
    assert_int_equal(aur_weight_table_load(path, &options, &loaded, NULL), AUR_OK);
    aur_weight_table_destroy(loaded);
    aur_oswa_options bad = options;
    bad.size = 0;
    assert_refused(aur_weight_table_load(path, &bad, &loaded, &error), AUR_ERROR_ARGUMENT, &error);
    assert_null(loaded);
    bad = options;
    bad.weights = &(aur_weights_options){.size = sizeof(aur_weights_options), .regularization = 1e-3};
    assert_refused(aur_weight_table_load(path, &bad, &loaded, &error), AUR_ERROR_FORMAT, &error);
    assert_refused(aur_weight_table_load("no-such-table", NULL, &loaded, &error), AUR_ERROR_OPEN, &error);
    assert_refused(aur_weight_table_build(&options,
                                          &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 1, 1, 2}, 1,
                                          NULL, &table, &error),
                   AUR_ERROR_ARGUMENT, &error);
    assert_null(table);
    remove(path);
}

static void test_heuristics(void **state) {
    (void)state;
    aur_error error;
    aur_potential *const potential = cosine_potential();
    const double up[3] = {0.0, 0.0, 1.0};
    const aur_density mass = {.size = sizeof mass,
                              .kind = AUR_DENSITY_NODES,
                              .node_count = 1,
                              .nodes = up,
                              .masses = (const double[]){1.0}};
    aur_potential *point;
    assert_int_equal(aur_potential_create(&mass, 1.5, &point, NULL), AUR_OK);
    double density;
    assert_refused(aur_potential_density(point, 1, up, &density, &error), AUR_ERROR_UNSUPPORTED, &error);
    double xyz[3 * COUNT], weights[COUNT];
    fill_points(xyz);
    aur_strategy strategy = {.count = COUNT};
    assert_int_equal(aur_mis_weights(AUR_MIS_BALANCE, 1, &strategy, potential, COUNT, xyz, weights, NULL),
                     AUR_OK);
    assert_int_equal(aur_weights_reweight(potential, potential, COUNT, xyz, weights, NULL), AUR_OK);
    assert_refused(
        aur_mis_weights((aur_mis_heuristic)9, 1, &strategy, potential, COUNT, xyz, weights, &error),
        AUR_ERROR_ARGUMENT, &error);
    assert_refused(aur_mis_weights(AUR_MIS_POWER, 1, &strategy, potential, COUNT - 1, xyz, weights, &error),
                   AUR_ERROR_ARGUMENT, &error);
    assert_refused(aur_mis_weights(AUR_MIS_POWER, 1, &strategy, point, COUNT, xyz, weights, &error),
                   AUR_ERROR_ARGUMENT, &error);
    strategy.axis[2] = 2.0;
    assert_refused(aur_mis_weights(AUR_MIS_POWER, 1, &strategy, potential, COUNT, xyz, weights, &error),
                   AUR_ERROR_ARGUMENT, &error);
    assert_refused(aur_weights_reweight(point, potential, COUNT, xyz, weights, &error), AUR_ERROR_ARGUMENT,
                   &error);
    aur_potential_destroy(point);
    aur_potential_destroy(potential);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_densities),  cmocka_unit_test(test_potentials), cmocka_unit_test(test_weights),
        cmocka_unit_test(test_rules),      cmocka_unit_test(test_pairs),      cmocka_unit_test(test_tables),
        cmocka_unit_test(test_heuristics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
