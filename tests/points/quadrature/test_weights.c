/* Optimal weights against golden figures of an independent prototype, algebra, and brute force. */
#include <aureole/quadrature.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/linear/solve.h"
#include "points/quadrature/lobes.h"

#define PI 3.14159265358979323846

static const aur_weights_options plain = {
    .size = sizeof(aur_weights_options), .regularization = 0.0, .sum_constraint = false};

static aur_potential *lobe_potential(double m, double smoothness) {
    const aur_density density = {
        .size = sizeof(aur_density), .kind = AUR_DENSITY_COSINE_POWER, .exponent = m};
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&density, smoothness, &potential, NULL), AUR_OK);
    return potential;
}

static void check_golden(double m, double equal, double optimal, double sum) {
    double xyz[3 * 64], weights[64];
    fibonacci_lobe(64, m, xyz);
    aur_potential *const potential = lobe_potential(m, 1.5);
    const aur_potential *const potentials[] = {potential};
    aur_weights_report report;
    assert_int_equal(aur_weights_solve(64, xyz, 1, potentials, &plain, 64, weights, &report, NULL, NULL),
                     AUR_OK);
    assert_relative(report.equal_error, equal, 1e-9);
    assert_relative(report.optimal_error, optimal, 1e-9);
    if (sum > 0.0)
        assert_relative(report.weight_sum, sum, 1e-9);
    /* The report's figures are those of the definition. */
    double value;
    assert_int_equal(aur_worst_case_error(64, xyz, NULL, potential, NULL, &value, NULL), AUR_OK);
    assert_relative(value, equal, 1e-9);
    assert_int_equal(aur_worst_case_error(64, xyz, weights, potential, NULL, &value, NULL), AUR_OK);
    assert_relative(value, optimal, 1e-9);
    aur_potential_destroy(potential);
}

static void test_golden(void **state) {
    (void)state;
    check_golden(1.0, 3.451313401060e-2, 3.299058614880e-2, 0.998357445867);
    check_golden(20.0, 2.284681166476e-2, 2.130088901918e-2, 0.0);
}

/* With the constraint, constants are exact; without it the bias is the golden one: -0.164 % at m = 1, N = 64.
 */
static void test_sum_constraint(void **state) {
    (void)state;
    double xyz[3 * 64], weights[64];
    fibonacci_lobe(64, 1.0, xyz);
    aur_potential *const potential = lobe_potential(1.0, 1.5);
    const aur_potential *const potentials[] = {potential};
    aur_weights_report constrained, free_of_it;
    assert_int_equal(aur_weights_solve(64, xyz, 1, potentials, NULL, 64, weights, &constrained, NULL, NULL),
                     AUR_OK);
    double sum = 0.0;
    for (int i = 0; i < 64; ++i)
        sum += weights[i];
    assert_near(sum, 1.0, 1e-12);
    assert_near(constrained.weight_sum, 1.0, 1e-12);
    const aur_weights_options options = {.size = sizeof(aur_weights_options),
                                         .regularization = AUR_REGULARIZATION_DEFAULT,
                                         .sum_constraint = false};
    assert_int_equal(
        aur_weights_solve(64, xyz, 1, potentials, &options, 64, weights, &free_of_it, NULL, NULL), AUR_OK);
    assert_near(free_of_it.weight_sum - 1.0, -0.00164, 5e-6);
    /* The cost of the constraint: about 0.2 % of the error. */
    assert_true(constrained.optimal_error >= free_of_it.optimal_error);
    assert_near(constrained.optimal_error / free_of_it.optimal_error, 1.002, 1e-3);
    aur_potential_destroy(potential);
}

/* The optimum is one: no change of the weights lowers the error, and along any line it is a parabola. */
static void test_is_minimum(void **state) {
    (void)state;
    enum { N = 24 };
    double xyz[3 * N], weights[N];
    fibonacci_lobe(N, 3.3, xyz);
    aur_potential *const potential = lobe_potential(3.3, 1.3);
    const aur_potential *const potentials[] = {potential};
    aur_weights_report report;
    assert_int_equal(aur_weights_solve(N, xyz, 1, potentials, &plain, N, weights, &report, NULL, NULL),
                     AUR_OK);
    for (int i = 0; i < N; ++i) {
        double error[2];
        for (int side = 0; side < 2; ++side) {
            double changed[N];
            memcpy(changed, weights, sizeof changed);
            changed[i] += side == 0 ? 1e-3 : -1e-3;
            assert_int_equal(aur_worst_case_error(N, xyz, changed, potential, NULL, &error[side], NULL),
                             AUR_OK);
            assert_true(error[side] > report.optimal_error);
        }
        /* wce^2 is even about its minimum. */
        assert_near(error[0] * error[0] - error[1] * error[1], 0.0, 1e-12);
    }
    aur_potential_destroy(potential);
}

/* With p = 1 on the whole sphere z is constant, so sets that symmetry makes equal get equal weights. */
static void test_sphere(void **state) {
    (void)state;
    const double octahedron[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    const aur_density density = {.size = sizeof(aur_density), .kind = AUR_DENSITY_SPHERE};
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&density, 0.0, &potential, NULL), AUR_OK);
    const aur_potential *const potentials[] = {potential};
    assert_near(aur_potential_self_energy(potential), 4.0 / 3.0, 1e-14);
    assert_near(aur_potential_mass(potential), 4.0 * PI, 1e-14);
    double weights[6];
    aur_weights_report report;
    assert_int_equal(aur_weights_solve(6, octahedron, 1, potentials, NULL, 6, weights, &report, NULL, NULL),
                     AUR_OK);
    for (int i = 0; i < 6; ++i)
        assert_near(weights[i], 1.0 / 6.0, 1e-14);
    /* The worst-case error of equal weights is the distance energy: sqrt(4/3 - mean distance). */
    const double mean = (2.0 + 4.0 * sqrt(2.0)) / 6.0;
    assert_near(report.equal_error, sqrt(4.0 / 3.0 - mean), 1e-14);
    /* Golden E_64 of spherical Fibonacci points, and weights improve it. */
    double xyz[3 * 64], more[64];
    fibonacci_sphere(64, xyz);
    assert_int_equal(aur_weights_solve(64, xyz, 1, potentials, NULL, 64, more, &report, NULL, NULL), AUR_OK);
    assert_relative(report.equal_error, 4.01610e-2, 2e-6);
    assert_true(report.optimal_error < report.equal_error);
    aur_potential_destroy(potential);
}

/* Coincident samples share their weight, with and without regularisation, and nothing else changes. */
static void test_duplicates(void **state) {
    (void)state;
    enum { N = 40, COPIES = 3 };
    double xyz[3 * (N + COPIES)], weights[N + COPIES], single[N];
    fibonacci_lobe(N, 5.0, xyz);
    for (int c = 0; c < COPIES; ++c)
        memcpy(xyz + 3 * (N + c), xyz + 3 * (c < 2 ? 7 : 31), 3 * sizeof *xyz);
    aur_potential *const potential = lobe_potential(5.0, 1.5);
    const aur_potential *const potentials[] = {potential};
    for (int constrained = 0; constrained < 2; ++constrained) {
        const aur_weights_options options = {.size = sizeof(aur_weights_options),
                                             .sum_constraint = constrained};
        aur_weights_report once, shared;
        assert_int_equal(aur_weights_solve(N, xyz, 1, potentials, &options, N, single, &once, NULL, NULL),
                         AUR_OK);
        assert_int_equal(aur_weights_solve(N + COPIES, xyz, 1, potentials, &options, N + COPIES, weights,
                                           &shared, NULL, NULL),
                         AUR_OK);
        assert_near(shared.optimal_error, once.optimal_error, 1e-12);
        for (int i = 0; i < N; ++i)
            assert_near(weights[i], single[i] / (i == 7 ? 3.0 : i == 31 ? 2.0 : 1.0), 1e-13);
        assert_true(weights[N] == weights[7] && weights[N + 1] == weights[7] &&
                    weights[N + 2] == weights[31]);
    }
    /* With regularisation the merged system is the full one: check the normal equations of the full one. */
    const aur_weights_options options = {
        .size = sizeof(aur_weights_options), .regularization = 0.01, .sum_constraint = false};
    assert_int_equal(
        aur_weights_solve(N + COPIES, xyz, 1, potentials, &options, N + COPIES, weights, NULL, NULL, NULL),
        AUR_OK);
    double z[N + COPIES];
    aur_potential_evaluate(potential, N + COPIES, xyz, z);
    for (int i = 0; i < N + COPIES; ++i) {
        double row = 0.01 * weights[i];
        for (int j = 0; j < N + COPIES; ++j) {
            const double *const u = xyz + 3 * i, *const v = xyz + 3 * j;
            row += aur_kernel(1.5, sqrt(pow(u[0] - v[0], 2) + pow(u[1] - v[1], 2) + pow(u[2] - v[2], 2))) *
                   weights[j];
        }
        assert_near(row, z[i], 1e-12);
    }
    aur_potential_destroy(potential);
}

/* Several densities over one set give the results of each alone; the condition estimate has the magnitude of
 * the true one. */
static void test_many_densities(void **state) {
    (void)state;
    enum { N = 48 };
    double xyz[3 * N], both[2 * N], one[N];
    fibonacci_lobe(N, 2.0, xyz);
    aur_potential *const diffuse = lobe_potential(1.0, 1.5);
    aur_potential *const glossy = lobe_potential(20.0, 1.5);
    const aur_potential *const potentials[] = {diffuse, glossy};
    double condition;
    assert_int_equal(aur_weights_solve(N, xyz, 2, potentials, &plain, 2 * N, both, NULL, &condition, NULL),
                     AUR_OK);
    for (size_t k = 0; k < 2; ++k) {
        assert_int_equal(aur_weights_solve(N, xyz, 1, potentials + k, &plain, N, one, NULL, NULL, NULL),
                         AUR_OK);
        for (size_t i = 0; i < N; ++i)
            assert_near(both[k * N + i], one[i], 1e-13);
    }
    /* K has entries up to 8/3 and eigenvalues down to about the chord of neighbours. */
    assert_true(condition > 100.0 && condition < 5000.0);
    aur_potential_destroy(diffuse);
    aur_potential_destroy(glossy);
}

/* One call gives the same as its steps. */
static void test_rule(void **state) {
    (void)state;
    aur_directions_options points = {.size = sizeof points};
    aur_directions_options_init(64, AUR_DOMAIN_HEMISPHERE, &points, NULL);
    points.lobe.exponent = 20.0;
    const aur_rule_options optimal = {
        .size = sizeof optimal, .points = &points, .optimal = true, .weights = &plain};
    double xyz[3 * 64], weights[64], value;
    assert_int_equal(aur_rule_make(&optimal, 3 * 64, xyz, weights, NULL), AUR_OK);
    aur_potential *const potential = lobe_potential(20.0, 1.5);
    assert_int_equal(aur_worst_case_error(64, xyz, weights, potential, NULL, &value, NULL), AUR_OK);
    assert_relative(value, 2.130088901918e-2, 1e-9);
    aur_rule_options ratio = optimal;
    ratio.optimal = false;
    points.optimal_density = true;
    assert_int_equal(aur_rule_make(&ratio, 3 * 64, xyz, weights, NULL), AUR_OK);
    assert_int_equal(aur_worst_case_error(64, xyz, weights, potential, NULL, &value, NULL), AUR_OK);
    assert_near(value, 2.078e-2, 0.5e-5);
    aur_error error;
    assert_int_equal(aur_rule_make(&ratio, 3 * 64 - 1, xyz, weights, &error), AUR_ERROR_CAPACITY);
    ratio.set = "no-such-set";
    assert_int_equal(aur_rule_make(&ratio, 3 * 64, xyz, weights, &error), AUR_ERROR_NAME);
    aur_potential_destroy(potential);
}

static void test_bad_input(void **state) {
    (void)state;
    aur_error error;
    aur_potential *potential;
    aur_density density = {.size = sizeof(aur_density), .kind = AUR_DENSITY_COSINE_POWER, .exponent = -1.0};
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "between 0 and"));
    assert_null(potential);
    density.exponent = (double)NAN;
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, &error), AUR_ERROR_ARGUMENT);
    density.exponent = 1.0;
    const double wrong[] = {1.0, 2.0, 3.005, 6.0, -1.0, (double)NAN};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        assert_int_equal(aur_potential_create(&density, wrong[i], &potential, &error), AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "between 1 and 6"));
    }
    density.axis[0] = 0.5;
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, &error), AUR_ERROR_ARGUMENT);

    potential = lobe_potential(1.0, 1.5);
    const aur_potential *const potentials[] = {potential};
    double weights[2];
    const double off[] = {0, 0, 1, 0, 0.5, 0.5};
    assert_int_equal(aur_weights_solve(2, off, 1, potentials, NULL, 2, weights, NULL, NULL, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "point 2"));
    double value;
    assert_int_equal(aur_worst_case_error(2, off, NULL, potential, NULL, &value, &error), AUR_ERROR_ARGUMENT);
    const double nan_point[] = {0, 0, (double)NAN};
    assert_int_equal(aur_weights_solve(1, nan_point, 1, potentials, NULL, 1, weights, NULL, NULL, &error),
                     AUR_ERROR_ARGUMENT);
    const aur_weights_options negative = {.size = sizeof(aur_weights_options), .regularization = -1.0};
    assert_int_equal(aur_weights_solve(1, off, 1, potentials, &negative, 1, weights, NULL, NULL, &error),
                     AUR_ERROR_ARGUMENT);
    /* Beyond memory: the message states the size. The check precedes any reading. */
    assert_int_equal(aur_check_system_size((size_t)1 << 27, &error), AUR_ERROR_MEMORY);
    assert_non_null(strstr(error.message, "GiB"));
    /* Not positive definite: an error, never NaN. */
    double singular[] = {1, 0, 2, 1}, right[] = {1, 1};
    assert_int_equal(aur_solve_positive(2, singular, 1, right, NULL, &error), AUR_ERROR_INTERNAL);
    aur_potential_destroy(potential);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden),     cmocka_unit_test(test_sum_constraint),
        cmocka_unit_test(test_is_minimum), cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_duplicates), cmocka_unit_test(test_many_densities),
        cmocka_unit_test(test_rule),       cmocka_unit_test(test_bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
