/* Multiple importance sampling, ratio weights, re-weighting, and the GGX lobe against its formula. */
#include <aureole/quadrature.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/gauss.h"
#include "points/quadrature/lobes.h"

#define PI 3.14159265358979323846

static aur_potential *create(const aur_density *density) {
    aur_potential *potential;
    assert_int_equal(aur_potential_create(density, 1.5, &potential, NULL), AUR_OK);
    return potential;
}

/* The samples of two lobes, the second tilted towards +x. */
static void draw_two(size_t first, size_t second, double m, double radians, double *xyz) {
    fibonacci_lobe(first, 1.0, xyz);
    fibonacci_lobe(second, m, xyz + 3 * first);
    tilt(second, radians, xyz + 3 * first);
}

/* The balance heuristic is p / sum n q, the power heuristic what Veach says, and both integrate constants
 * better and better; one strategy alone is p/(n q). */
static void test_mis(void **state) {
    (void)state;
    enum { A = 400, B = 300 };
    double *const xyz = malloc(4 * (A + B) * sizeof *xyz);
    double *const weights = xyz + 3 * (A + B);
    draw_two(A, B, 20.0, 0.8, xyz);
    const aur_density glossy = {
        .size = sizeof(aur_density), .exponent = 20.0, .axis = {sin(0.8), 0.0, cos(0.8)}};
    aur_potential *const target = create(&glossy);
    aur_strategy strategies[2] = {{.count = A, .sampled = {.exponent = 1.0}},
                                  {.count = B, .sampled = {.exponent = 20.0}}};
    memcpy(strategies[1].axis, glossy.axis, sizeof glossy.axis);
    for (int power = 0; power < 2; ++power) {
        assert_int_equal(aur_mis_weights(power ? AUR_MIS_POWER : AUR_MIS_BALANCE, 2, strategies, target,
                                         A + B, xyz, weights, NULL),
                         AUR_OK);
        double sum = 0.0;
        for (size_t i = 0; i < A + B; ++i) {
            const double *const u = xyz + 3 * i;
            const double along = fmax(0.0, u[0] * glossy.axis[0] + u[2] * glossy.axis[2]);
            const double p = 21.0 / (2.0 * PI) * pow(along, 20.0);
            const double drawn[2] = {A * fmax(0.0, u[2]) / PI, B * p};
            const double density = drawn[i < A ? 0 : 1];
            const double expected =
                power ? density * p / (drawn[0] * drawn[0] + drawn[1] * drawn[1]) : p / (drawn[0] + drawn[1]);
            assert_near(weights[i], expected, 1e-12 + 1e-9 * expected);
            sum += weights[i];
        }
        assert_near(sum, 1.0, 0.01);
    }
    assert_int_equal(
        aur_mis_weights(AUR_MIS_BALANCE, 1, strategies + 1, target, B, xyz + 3 * A, weights, NULL), AUR_OK);
    for (size_t i = 0; i < B; ++i)
        assert_near(weights[i], 1.0 / B, 1e-12);
    /* A sample that no strategy has drawn: at the horizon of the only one that is asked. */
    const double below[3] = {sin(0.8), 0.0, cos(0.8)};
    const aur_strategy elsewhere = {.count = 1, .sampled = {.exponent = 1.0}, .axis = {0.0, 0.0, -1.0}};
    aur_error error;
    assert_int_equal(aur_mis_weights(AUR_MIS_BALANCE, 1, &elsewhere, target, 1, below, weights, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "sample 0"));
    aur_potential_destroy(target);
    free(xyz);
}

static void test_refused_strategies(void **state) {
    (void)state;
    const aur_density cosine = {.size = sizeof(aur_density), .exponent = 1.0};
    aur_potential *const target = create(&cosine);
    const double node[3] = {0.0, 0.0, 1.0}, mass = 1.0;
    const aur_density point = {.size = sizeof(aur_density),
                               .kind = AUR_DENSITY_NODES,
                               .node_count = 1,
                               .nodes = node,
                               .masses = &mass};
    aur_potential *const nodes = create(&point);
    const aur_strategy good = {.count = 1, .sampled = {.exponent = 1.0}};
    aur_strategy kind = good, exponent = good, axis = good;
    kind.sampled.kind = (aur_lobe_kind)9;
    exponent.sampled.exponent = -1.0;
    axis.axis[2] = 2.0;
    const struct {
        int heuristic;
        const aur_strategy *strategy;
        const aur_potential *target;
        size_t count;
        aur_result result;
    } cases[] = {
        {AUR_MIS_BALANCE, &good, target, 1, AUR_OK},
        {77, &good, target, 1, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &kind, target, 1, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &exponent, target, 1, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &axis, target, 1, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &good, target, 0, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &good, target, 2, AUR_ERROR_ARGUMENT},
        {AUR_MIS_BALANCE, &good, nodes, 1, AUR_ERROR_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        double weight[2] = {0};
        aur_error error = {0};
        assert_int_equal(aur_mis_weights((aur_mis_heuristic)cases[i].heuristic, 1, cases[i].strategy,
                                         cases[i].target, cases[i].count, node, weight, &error),
                         cases[i].result);
        assert_true(cases[i].result == AUR_OK || error.message[0] != '\0');
    }
    double weight = 1.0;
    assert_int_equal(aur_weights_reweight(nodes, target, 1, node, &weight, NULL), AUR_ERROR_ARGUMENT);
    aur_potential_destroy(nodes);
    aur_potential_destroy(target);
}

/* --- GGX -------------------------------------------------------------------------------------------------
 */

typedef struct ggx {
    double alpha, view[3];
} ggx;

static double lambda(double alpha, double cosine) {
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 / (cosine * cosine) - 1.0)) - 1.0);
}

/* Cook and Torrance with the GGX distribution and height-correlated Smith masking, times the cosine. */
static double ggx_value(void *user, const double l[3]) {
    const ggx *const g = user;
    if (l[2] <= 0.0)
        return 0.0;
    double h[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        h[k] = g->view[k] + l[k];
        length += h[k] * h[k];
    }
    const double cosine = h[2] / sqrt(length), a2 = g->alpha * g->alpha;
    const double t = cosine * cosine * (a2 - 1.0) + 1.0;
    const double d = a2 / (PI * t * t);
    return d / (1.0 + lambda(g->alpha, g->view[2]) + lambda(g->alpha, l[2])) / (4.0 * g->view[2]);
}

static void test_ggx(void **state) {
    (void)state;
    enum { RINGS = 200, TURNS = 400 };
    double node[RINGS], weight[RINGS];
    aur_gauss_legendre(RINGS, node, weight);
    const double degrees[] = {0.0, 45.0, 75.0};
    for (size_t d = 0; d < 3; ++d) {
        const double angle = degrees[d] * PI / 180.0;
        ggx g = {0.3, {sin(angle), 0.0, cos(angle)}};
        aur_potential *const potential = create(&(aur_density){
            .size = sizeof(aur_density), .kind = AUR_DENSITY_GGX, .alpha = 0.3, .view_degrees = degrees[d]});
        const double u[3] = {-0.36, 0.48, 0.8};
        double mass = 0.0, z = 0.0, found;
        for (size_t i = 0; i < RINGS; ++i) {
            const double theta = 0.25 * PI * (node[i] + 1.0);
            for (size_t j = 0; j < TURNS; ++j) {
                const double phi = 2.0 * PI * ((double)j + 0.5) / TURNS;
                const double l[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
                const double share = 0.25 * PI * weight[i] * 2.0 * PI / TURNS * sin(theta) * ggx_value(&g, l);
                const double chord = sqrt(pow(u[0] - l[0], 2) + pow(u[1] - l[1], 2) + pow(u[2] - l[2], 2));
                mass += share;
                z += share * aur_kernel(1.5, chord);
                if (i % 50 != 0 || j % 50 != 0)
                    continue;
                double density;
                assert_int_equal(aur_potential_density(potential, 1, l, &density, NULL), AUR_OK);
                assert_relative(density * aur_potential_mass(potential), ggx_value(&g, l), 1e-9);
            }
        }
        aur_potential_evaluate(potential, 1, u, &found);
        assert_relative(aur_potential_mass(potential), mass, 1e-4);
        assert_relative(found * aur_potential_mass(potential), z, 2e-4);
        aur_potential_destroy(potential);
    }
}

/* Exact-p weights against the published way round a BSDF without a formula: weights for a fitted cos^m lobe,
 * times p/p'. */
static void test_reweighting(void **state) {
    (void)state;
    enum { N = 64 };
    const double degrees = 50.0;
    const aur_directions_options options = {
        .size = sizeof options,
        .count = N,
        .domain = AUR_DOMAIN_HEMISPHERE,
        .lobe = {.kind = AUR_LOBE_GGX, .alpha = 0.3, .view_degrees = degrees}};
    aur_directions *directions;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, NULL), AUR_OK);
    double xyz[3 * N], ratio[N], exact[N], fitted[N];
    aur_directions_points(directions, 0, N, 3 * N, xyz, ratio, NULL);
    aur_directions_destroy(directions);
    aur_potential *const ggx_lobe = create(&(aur_density){
        .size = sizeof(aur_density), .kind = AUR_DENSITY_GGX, .alpha = 0.3, .view_degrees = degrees});
    const aur_potential *const target[] = {ggx_lobe};
    aur_weights_report report;
    assert_int_equal(aur_weights_solve(N, xyz, 1, target, NULL, N, exact, &report, NULL, NULL), AUR_OK);
    /* The best of many fits, about the mirror direction, is still worse. */
    double best = 1e9, best_exponent = 0.0;
    for (double m = 2.0; m < 40.0; m *= 1.2) {
        const double mirror = -degrees * PI / 180.0;
        aur_potential *const phong = create(&(aur_density){
            .size = sizeof(aur_density), .exponent = m, .axis = {sin(mirror), 0.0, cos(mirror)}});
        const aur_potential *const one[] = {phong};
        assert_int_equal(aur_weights_solve(N, xyz, 1, one, NULL, N, fitted, NULL, NULL, NULL), AUR_OK);
        double value, densities[N];
        assert_int_equal(aur_potential_density(phong, N, xyz, densities, NULL), AUR_OK);
        for (size_t i = 0; i < N; ++i)
            if (densities[i] < 1e-6)
                fitted[i] = 0.0;
        assert_int_equal(aur_weights_reweight(ggx_lobe, phong, N, xyz, fitted, NULL), AUR_OK);
        assert_int_equal(aur_worst_case_error(N, xyz, fitted, ggx_lobe, NULL, &value, NULL), AUR_OK);
        if (value < best) {
            best = value;
            best_exponent = m;
        }
        aur_potential_destroy(phong);
    }
    print_message("GGX 0.3 at 50 degrees: exact p %.3e, best fitted p' %.3e (m = %.1f): %.1f times worse\n",
                  report.optimal_error, best, best_exponent, best / report.optimal_error);
    assert_true(best > 1.3 * report.optimal_error);
    /* Re-weighting to the same density changes nothing. */
    memcpy(fitted, exact, sizeof fitted);
    assert_int_equal(aur_weights_reweight(ggx_lobe, ggx_lobe, N, xyz, fitted, NULL), AUR_OK);
    for (size_t i = 0; i < N; ++i)
        assert_near(fitted[i], exact[i], 1e-15);
    aur_potential_destroy(ggx_lobe);
}

/* The published set-up: sigma = 0.5 and z by a bilinear table. It loses most of the gain at m = 20, and at m
 * = 200 it is worse than equal weights. */
static void test_published_method(void **state) {
    (void)state;
    enum { N = 64 };
    const aur_weights_options heavy = {
        .size = sizeof(aur_weights_options), .regularization = 0.5, .sum_constraint = false};
    const double exponents[] = {20.0, 200.0};
    for (size_t e = 0; e < 2; ++e) {
        double xyz[3 * N], weights[N];
        fibonacci_lobe(N, exponents[e], xyz);
        aur_potential *const potential =
            create(&(aur_density){.size = sizeof(aur_density), .exponent = exponents[e]});
        const aur_potential *const one[] = {potential};
        aur_weights_report light, published;
        aur_weights_solve(N, xyz, 1, one, NULL, N, weights, &light, NULL, NULL);
        aur_weights_solve(N, xyz, 1, one, &heavy, N, weights, &published, NULL, NULL);
        print_message("m %g: gain %.2f %% with sigma 1e-6, %.2f %% with 0.5\n", exponents[e],
                      100.0 * (1.0 - light.optimal_error / light.equal_error),
                      100.0 * (1.0 - published.optimal_error / published.equal_error));
        assert_true(published.optimal_error > light.optimal_error);
        assert_true((published.optimal_error > published.equal_error) == (e == 1));
        aur_potential_destroy(potential);
    }
    /* Through OSWA, with the table of z: worse than with exact z. */
    const aur_weights_options unconstrained = {.size = sizeof unconstrained,
                                               .regularization = AUR_REGULARIZATION_DEFAULT};
    aur_oswa_options options = {.size = sizeof(aur_oswa_options),
                                .count = 64,
                                .mirror_count = 32,
                                .lobe = {.exponent = 1.0},
                                .mirror_lobe = {.exponent = 20.0},
                                .weights = &unconstrained};
    double errors[2], xyz[3 * 96], weights[2 * 96];
    aur_potential *const glossy = create(
        &(aur_density){.size = sizeof(aur_density), .exponent = 20.0, .axis = {-sin(0.6), 0.0, cos(0.6)}});
    for (int published = 0; published < 2; ++published) {
        options.published_z =
            published ? (aur_z_grid){.angle_count = 64, .exponent_count = 32, .largest_exponent = 100.0}
                      : (aur_z_grid){0};
        aur_oswa *oswa;
        assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_OK);
        assert_int_equal(
            aur_oswa_points(oswa, 0.6, (double[]){0, 0}, false, 3 * aur_oswa_size(oswa), xyz, NULL), AUR_OK);
        assert_int_equal(
            aur_oswa_solve(oswa, 0.6, (double[]){0, 0}, 2 * aur_oswa_size(oswa), weights, NULL, NULL),
            AUR_OK);
        aur_worst_case_error(96, xyz, weights + 96, glossy, NULL, &errors[published], NULL);
        aur_oswa_destroy(oswa);
    }
    print_message("z by a 64 x 32 table: wce %.4e, exact %.4e\n", errors[1], errors[0]);
    assert_true(errors[1] > errors[0]);
    options.clipped = true;
    aur_oswa *oswa;
    assert_int_equal(aur_oswa_create(&options, &oswa, NULL), AUR_ERROR_UNSUPPORTED);
    aur_potential_destroy(glossy);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mis),
        cmocka_unit_test(test_refused_strategies),
        cmocka_unit_test(test_ggx),
        cmocka_unit_test(test_reweighting),
        cmocka_unit_test(test_published_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
