/* Potentials and self-energies against golden figures, long series and brute-force quadrature. */
#include <aureole/quadrature.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/gauss.h"
#include "points/quadrature/lobes.h"
#include "points/quadrature/potential/potential.h"

#define PI 3.14159265358979323846

static aur_potential *create(const aur_density *density, double smoothness) {
    aur_potential *potential;
    assert_int_equal(aur_potential_create(density, smoothness, &potential, NULL), AUR_OK);
    return potential;
}

static void test_golden(void **state) {
    (void)state;
    const double energies[][2] = {{1.0, 1.70089089347496}, {20.0, 2.29101831718286}};
    for (size_t i = 0; i < 2; ++i) {
        aur_potential *const potential =
            create(&(aur_density){.size = sizeof(aur_density), .exponent = energies[i][0]}, 1.5);
        assert_relative(aur_potential_self_energy(potential), energies[i][1], 1e-12);
        double cross;
        assert_int_equal(aur_cross_energy(energies[i][0], energies[i][0], 1.0, 1.5, &cross, NULL), AUR_OK);
        assert_relative(cross, energies[i][1], 1e-12);
        assert_relative(aur_potential_mass(potential), 2.0 * PI / (energies[i][0] + 1.0), 1e-14);
        aur_potential_destroy(potential);
    }
    aur_potential *const potential =
        create(&(aur_density){.size = sizeof(aur_density), .exponent = 1.0}, 1.5);
    const double xyz[] = {0, 0, 1, 1, 0, 0};
    double z[2];
    aur_potential_evaluate(potential, 2, xyz, z);
    assert_relative(PI * z[0], 6.00804284255499, 1e-12);
    assert_relative(PI * z[1], 4.11091374290612, 1e-12);
    aur_potential_destroy(potential);
}

/* The potential of a cos^m lobe at the cosine x as the sum of k_l mu_l P_l(x), where k_l are the coefficients
 * of the kernel and mu_l = (m+1) times the integral over [0,1] of x^m P_l(x); P_l by the recurrence of
 * Bonnet.
 */
static double legendre_series(double m, double smoothness, double x) {
    enum { TERMS = 20000 };
    static double k[TERMS], mu[TERMS];
    aur_kernel_coefficients(smoothness, TERMS, k);
    mu[0] = 1.0;
    mu[1] = (m + 1.0) / (m + 2.0);
    double before = 1.0, value = x, sum = k[0] + k[1] * mu[1] * x;
    for (int l = 2; l < TERMS; ++l) {
        mu[l] = mu[l - 2] * (m - (l - 2)) / (m + l + 1.0);
        const double next = ((2.0 * l - 1.0) * x * value - (l - 1.0) * before) / l;
        before = value;
        value = next;
        sum += k[l] * mu[l] * value;
    }
    return sum;
}

/* The fast form against 20000 terms, for every kind of exponent and smoothness. */
static void test_long_series(void **state) {
    (void)state;
    enum { COUNT = 41 };
    const double exponents[] = {0.0, 0.5, 1.0, 2.0, 3.7, 20.0, 200.0, 3000.0};
    const double smoothness[] = {1.1, 1.5, 1.9, 2.5, 5.9};
    for (size_t e = 0; e < sizeof exponents / sizeof exponents[0]; ++e) {
        for (size_t s = 0; s < sizeof smoothness / sizeof smoothness[0]; ++s) {
            aur_potential *const potential =
                create(&(aur_density){.size = sizeof(aur_density), .exponent = exponents[e]}, smoothness[s]);
            double x[COUNT], xyz[3 * COUNT], z[COUNT], expected[COUNT];
            for (int i = 0; i < COUNT; ++i) {
                x[i] = cos(PI * i / (COUNT - 1));
                xyz[3 * i] = sin(PI * i / (COUNT - 1));
                xyz[3 * i + 1] = 0.0;
                xyz[3 * i + 2] = x[i];
            }
            aur_potential_evaluate(potential, COUNT, xyz, z);
            for (int i = 0; i < COUNT; ++i)
                expected[i] = legendre_series(exponents[e], smoothness[s], x[i]);
            /* The slower the decay (m + 2s), the fewer digits; at s = 1.1 and m < 1 20000 terms are good to
             * 1e-9. */
            const double decay = exponents[e] + 2.0 * smoothness[s];
            const double tolerance = decay < 2.9 ? 2e-9 : decay < 3.5 ? 1e-11 : 1e-12;
            /* Smooth kernels nearly vanish far from the lobe: rounding is relative to their largest values.
             */
            const double largest = smoothness[s] > 2.0 ? aur_kernel(smoothness[s], 0.0) : 0.0;
            for (int i = 0; i < COUNT; ++i)
                assert_near(z[i], expected[i], tolerance * fmax(largest, fabs(expected[i])));
            aur_potential_destroy(potential);
        }
    }
}

/* The kernel against its Legendre series in long double, whose coefficients are (2l+1) 4^a |(-a)_l| /
 * (a+1)_{l+1} for a = s - 1, at chords from 0 to 2. What 20000 terms leave out is less than their last power,
 * l^{2-2s}. */
static void test_smooth_kernels(void **state) {
    (void)state;
    const double smoothness[] = {1.9, 2.5, 2.9, 3.5, 4.5, 5.5, 5.9};
    for (size_t s = 0; s < sizeof smoothness / sizeof smoothness[0]; ++s) {
        const long double a = (long double)smoothness[s] - 1.0L;
        const double top = aur_kernel(smoothness[s], 0.0), left_out = pow(20000.0, 2.0 - 2.0 * smoothness[s]);
        for (int i = 0; i <= 16; ++i) {
            const double chord = 0.125 * i;
            const long double x = 1.0L - 0.5L * (long double)(chord * chord);
            long double sum = 0.0L, before = 0.0L, here = 1.0L, factor = powl(4.0L, a) / (a + 1.0L);
            for (int l = 0; l < 20000; ++l) {
                sum += (2 * l + 1) * fabsl(factor) * here;
                factor *= (l - a) / (a + l + 2);
                const long double next = ((2 * l + 1) * x * here - l * before) / (l + 1);
                before = here;
                here = next;
            }
            assert_near(aur_kernel(smoothness[s], chord), (double)sum, (left_out + 1e-14) * top);
        }
        /* A point is nearest to itself. */
        assert_true(aur_kernel(smoothness[s], 1e-4) < top);
    }
    assert_true(isnan(aur_kernel(3.0, 1.0)) && isnan(aur_kernel(2.995, 1.0)) && isnan(aur_kernel(6.5, 1.0)));
}

/* Optimal weights for smooth integrands: worst-case errors of an even set fall as N^{-s/2}, also where s is
 * above 2, and weights lower them. */
static void test_smooth_rates(void **state) {
    (void)state;
    const double smoothness[] = {2.5, 3.5};
    for (size_t s = 0; s < 2; ++s) {
        aur_density density = {.size = sizeof density};
        aur_density_init(&density, NULL);
        density.kind = AUR_DENSITY_SPHERE;
        aur_potential *const potential = create(&density, smoothness[s]);
        double error[2], optimal[2];
        for (size_t k = 0; k < 2; ++k) {
            const size_t count = k == 0 ? 64 : 256;
            double xyz[3 * 256], weights[256];
            aur_directions_options points = {.size = sizeof points};
            aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &points, NULL);
            aur_directions *directions;
            aur_weights_options options = {.size = sizeof options};
            aur_weights_options_init(&options, NULL);
            options.regularization = 1e-10;
            assert_int_equal(aur_directions_create("spherical-fibonacci", &points, &directions, NULL),
                             AUR_OK);
            assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, NULL), AUR_OK);
            aur_directions_destroy(directions);
            const aur_potential *const one = potential;
            assert_int_equal(
                aur_weights_solve(count, xyz, 1, &one, &options, count, weights, NULL, NULL, NULL), AUR_OK);
            assert_int_equal(aur_worst_case_error(count, xyz, NULL, potential, NULL, &error[k], NULL),
                             AUR_OK);
            assert_int_equal(aur_worst_case_error(count, xyz, weights, potential, NULL, &optimal[k], NULL),
                             AUR_OK);
            assert_true(optimal[k] < error[k]);
        }
        /* 4^{s/2} = 2^s from 64 to 256 points, and a fifth for the distance from the asymptote. */
        assert_true(optimal[0] / optimal[1] > 0.8 * pow(2.0, smoothness[s]));
        aur_potential_destroy(potential);
    }
}

enum { RINGS = 300, TURNS = 640, BRUTE = RINGS * TURNS, SPARSE = 8 };

/* The density at nodes of a product rule on the hemisphere about the normal, whose edge is the horizon:
 * columns x, y, z and masses. The kernel's point is no node, so the rule is good to the cube of its step. */
static double *brute_nodes(const double axis[3], double exponent) {
    double *const nodes = malloc(4 * BRUTE * sizeof *nodes);
    assert_non_null(nodes);
    double node[RINGS], weight[RINGS];
    aur_gauss_legendre(RINGS, node, weight);
    for (size_t i = 0; i < RINGS; ++i) {
        const double theta = 0.25 * PI * (node[i] + 1.0);
        for (size_t j = 0; j < TURNS; ++j) {
            const double phi = 2.0 * PI * ((double)j + 0.25) / TURNS;
            const double v[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
            const double cosine = v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2];
            for (size_t k = 0; k < 3; ++k)
                nodes[k * BRUTE + i * TURNS + j] = v[k];
            nodes[3 * BRUTE + i * TURNS + j] =
                cosine > 0.0 ? 0.25 * PI * weight[i] * 2.0 * PI / TURNS * sin(theta) * pow(cosine, exponent)
                             : 0.0;
        }
    }
    return nodes;
}

static double brute_potential(const double *nodes, double smoothness, const double u[3]) {
    const aur_kernel_rule rule = aur_kernel_rule_make(smoothness);
    const aur_columns columns = {nodes, nodes + BRUTE, nodes + 2 * BRUTE};
    return aur_kernel_sum(&rule, u, BRUTE, columns, nodes + 3 * BRUTE);
}

/* The integral as it is defined, for a whole lobe. */
static void test_definition(void **state) {
    (void)state;
    const double axis[3] = {0.0, 0.0, 1.0};
    double *const nodes = brute_nodes(axis, 3.5);
    const double smoothness[] = {1.2, 1.5, 1.8, 3.5};
    for (size_t s = 0; s < sizeof smoothness / sizeof smoothness[0]; ++s) {
        aur_potential *const potential =
            create(&(aur_density){.size = sizeof(aur_density), .exponent = 3.5}, smoothness[s]);
        const double points[] = {0.6, 0.0, 0.8, 0.36, 0.48, 0.8, -0.8, 0.0, -0.6};
        double z[3];
        aur_potential_evaluate(potential, 3, points, z);
        for (size_t i = 0; i < 3; ++i)
            assert_relative(z[i] * aur_potential_mass(potential),
                            brute_potential(nodes, smoothness[s], points + 3 * i), s == 0 ? 1e-6 : 1e-7);
        aur_potential_destroy(potential);
    }
    free(nodes);
}

/* Clipped: potential and mass at many tilts to the 1e-6 that is promised, near the horizon too. */
static void test_clipped(void **state) {
    (void)state;
    const double exponents[] = {1.0, 20.0, 200.0};
    const double degrees[] = {30.0, 60.0, 75.0, 89.0};
    for (size_t e = 0; e < 3; ++e) {
        for (size_t d = 0; d < 4; ++d) {
            const double angle = degrees[d] * PI / 180.0;
            const aur_density density = {.size = sizeof(aur_density),
                                         .exponent = exponents[e],
                                         .axis = {sin(angle), 0.0, cos(angle)},
                                         .clipped = true};
            double *const nodes = brute_nodes(density.axis, density.exponent);
            aur_potential *const potential = create(&density, 1.5);
            double xyz[3 * 8], z[8];
            fibonacci_lobe(7, exponents[e], xyz);
            tilt(7, angle, xyz);
            for (int i = 0; i < 7; ++i)
                xyz[3 * i + 2] = fabs(xyz[3 * i + 2]); /* all visible */
            xyz[21] = sqrt(1.0 - 1e-6);                /* a sample a thousandth above the horizon */
            xyz[22] = 0.0;
            xyz[23] = 0.001;
            aur_potential_evaluate(potential, 8, xyz, z);
            for (size_t i = 0; i < 8; ++i)
                assert_relative(z[i] * aur_potential_mass(potential),
                                brute_potential(nodes, 1.5, xyz + 3 * i), 1e-6);
            double mass = 0.0;
            for (size_t i = 0; i < BRUTE; ++i)
                mass += nodes[3 * BRUTE + i];
            assert_relative(aur_potential_mass(potential), mass, 1e-6);
            /* The self-energy is the mean potential over the lobe; every eighth azimuth resolves m = 20. */
            double energy = 0.0, share = 0.0;
            for (size_t i = 0; i < BRUTE && e == 1 && d % 2 == 1; i += SPARSE) {
                const double u[3] = {nodes[i], nodes[BRUTE + i], nodes[2 * BRUTE + i]};
                double there;
                aur_potential_evaluate(potential, 1, u, &there);
                energy += nodes[3 * BRUTE + i] * there;
                share += nodes[3 * BRUTE + i];
            }
            if (share > 0.0)
                assert_relative(aur_potential_self_energy(potential), energy / share, 1e-6);
            aur_potential_destroy(potential);
            free(nodes);
        }
    }
    /* At grazing incidence half the lobe is hidden, exactly. */
    aur_potential *const half = create(
        &(aur_density){
            .size = sizeof(aur_density), .exponent = 7.0, .axis = {1.0, 0.0, 0.0}, .clipped = true},
        1.5);
    assert_relative(aur_potential_mass(half), PI / 8.0, 1e-12);
    aur_potential_destroy(half);
    /* m = 1: the mass above the surface is pi (1 + cos angle)/2. */
    aur_potential *const cosine = create(
        &(aur_density){
            .size = sizeof(aur_density), .exponent = 1.0, .axis = {sin(1.0), 0.0, cos(1.0)}, .clipped = true},
        1.5);
    assert_relative(aur_potential_mass(cosine), 0.5 * PI * (1.0 + cos(1.0)), 1e-12);
    aur_potential_destroy(cosine);
}

typedef struct clipped_lobe {
    double axis[3], exponent;
} clipped_lobe;

static aur_result clipped_value(void *user, size_t count, const double *directions, double *values,
                                aur_error *error) {
    (void)error;
    const clipped_lobe *const lobe = user;
    for (size_t i = 0; i < count; ++i) {
        const double *const u = directions + 3 * i;
        const double cosine = u[0] * lobe->axis[0] + u[1] * lobe->axis[1] + u[2] * lobe->axis[2];
        values[i] = u[2] > 0.0 && cosine > 0.0 ? 3.0 * pow(cosine, lobe->exponent) : 0.0;
    }
    return AUR_OK;
}

/* A density that fails from its fourth call on, with its own message. */
static aur_result failing(void *user, size_t count, const double *directions, double *values,
                          aur_error *error) {
    (void)directions;
    size_t *const calls = user;
    if (++*calls > 3)
        return aur_fail(error, AUR_ERROR_OPEN, "the lamp's table is gone");
    for (size_t i = 0; i < count; ++i)
        values[i] = 1.0;
    return AUR_OK;
}

/* A density's error ends the call that evaluates it, during the creation of nodes and afterwards. */
static void test_function_that_fails(void **state) {
    (void)state;
    size_t calls = 0;
    aur_density density = {.size = sizeof density,
                           .kind = AUR_DENSITY_FUNCTION,
                           .function = failing,
                           .user = &calls,
                           .node_count = 4096};
    aur_potential *potential = NULL;
    aur_error error;
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, &error), AUR_ERROR_OPEN);
    assert_true(potential == NULL);
    assert_string_equal(error.message, "the lamp's table is gone");
    assert_int_equal(calls, 4);
    calls = 0;
    density.node_count = 256;
    potential = create(&density, 1.5);
    const double up[3] = {0.0, 0.0, 1.0};
    double value;
    calls = 2;
    assert_int_equal(aur_potential_density(potential, 1, up, &value, &error), AUR_OK);
    assert_near(value, 1.0 / (2.0 * PI), 1e-12);
    assert_int_equal(aur_potential_density(potential, 1, up, &value, &error), AUR_ERROR_OPEN);
    assert_string_equal(error.message, "the lamp's table is gone");
    aur_potential_destroy(potential);
}

/* A callback density is the same density by another road: importance-sampled points. */
static void test_function(void **state) {
    (void)state;
    clipped_lobe lobe = {.axis = {sin(1.1), 0.0, cos(1.1)}, .exponent = 20.0};
    aur_density density = {.size = sizeof(aur_density),
                           .kind = AUR_DENSITY_FUNCTION,
                           .exponent = 20.0,
                           .function = clipped_value,
                           .user = &lobe,
                           .node_count = 16384};
    aur_density exact = {.size = sizeof(aur_density), .exponent = 20.0, .clipped = true};
    memcpy(density.axis, lobe.axis, sizeof density.axis);
    memcpy(exact.axis, lobe.axis, sizeof exact.axis);
    aur_potential *const sampled = create(&density, 1.5);
    aur_potential *const closed = create(&exact, 1.5);
    assert_relative(aur_potential_mass(sampled), 3.0 * aur_potential_mass(closed), 1e-3);
    double xyz[3 * 30], a[30], b[30];
    fibonacci_lobe(30, 1.0, xyz);
    aur_potential_evaluate(sampled, 30, xyz, a);
    aur_potential_evaluate(closed, 30, xyz, b);
    for (int i = 0; i < 30; ++i)
        assert_relative(a[i], b[i], 5e-4);
    assert_relative(aur_potential_self_energy(sampled), aur_potential_self_energy(closed), 1e-3);
    aur_potential_destroy(sampled);

    /* Drawn from the whole sphere, without the horizon's edge: the error is that of a smooth function. */
    aur_density even = {.size = sizeof(aur_density),
                        .kind = AUR_DENSITY_FUNCTION,
                        .function = clipped_value,
                        .user = &lobe,
                        .whole_sphere = 1};
    aur_potential *const whole = create(&even, 1.5);
    aur_potential_evaluate(whole, 30, xyz, a);
    for (int i = 0; i < 30; ++i)
        assert_relative(a[i], b[i], 5e-3);
    aur_potential_destroy(whole);
    aur_potential_destroy(closed);
}

/* The energy of two lobes is the integral of one's potential over the other. */
static void test_cross_energy(void **state) {
    (void)state;
    enum { ACROSS = 60, AROUND = 120 };
    double node[ACROSS], weight[ACROSS];
    aur_gauss_legendre(ACROSS, node, weight);
    aur_potential *const diffuse = create(&(aur_density){.size = sizeof(aur_density), .exponent = 1.0}, 1.5);
    double energy = 0.0;
    for (size_t i = 0; i < ACROSS; ++i) {
        const double cosine = 0.5 * (node[i] + 1.0);
        for (size_t j = 0; j < AROUND; ++j) {
            const double phi = 2.0 * PI * (double)j / AROUND;
            double u[3] = {sqrt(1.0 - cosine * cosine) * cos(phi), sqrt(1.0 - cosine * cosine) * sin(phi),
                           cosine},
                   z;
            tilt(1, 0.9, u);
            aur_potential_evaluate(diffuse, 1, u, &z);
            energy += 0.5 * weight[i] / AROUND * 21.0 * pow(cosine, 20.0) * z;
        }
    }
    double cross;
    assert_int_equal(aur_cross_energy(1.0, 20.0, cos(0.9), 1.5, &cross, NULL), AUR_OK);
    assert_relative(cross, energy, 1e-9);
    const double refused[][4] = {{-1.0, 20.0, 0.5, 1.5}, {1.0, (double)NAN, 0.5, 1.5},
                                 {1.0, 2.0, 1.5, 1.5},   {1.0, 2.0, (double)NAN, 1.5},
                                 {1.0, 2.0, 0.5, 1.0},   {1.0, 2.0, 0.5, 2.0}};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        const double *const r = refused[i];
        aur_error error;
        assert_int_equal(aur_cross_energy(r[0], r[1], r[2], r[3], &cross, &error), AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "must be"));
    }
    aur_potential_destroy(diffuse);
}

/* The same bits on every instruction set, for every length. */
static void test_kernel_rows(void **state) {
    (void)state;
    enum { COUNT = 67 };
    double xyz[3 * COUNT], storage[3 * COUNT], expected[COUNT], row[COUNT];
    fibonacci_sphere(COUNT, xyz);
    const aur_columns columns = aur_columns_split(COUNT, xyz, storage);
    const aur_kernel_rule rule = aur_kernel_rule_make(1.5);
    for (size_t count = 0; count <= COUNT; ++count) {
        aur_kernel_row_portable(rule.top, xyz + 9, count, columns, expected);
        aur_kernel_row(&rule, xyz + 9, count, columns, row);
        for (size_t i = 0; i < count; ++i)
            assert_true(row[i] == expected[i]);
    }
    assert_near(expected[3], 8.0 / 3.0, 0.0);
    assert_near(aur_kernel(1.5, 0.5), 8.0 / 3.0 - 0.5, 1e-15);
    assert_true(isnan(aur_kernel(1.0, 0.5)) && isnan(aur_kernel(1.5, 3.0)));
    /* Legendre coefficients of s = 3/2. */
    double k[6];
    aur_kernel_coefficients(1.5, 6, k);
    assert_near(k[0], 4.0 / 3.0, 1e-14);
    for (int l = 1; l < 6; ++l)
        assert_near(k[l], 4.0 / ((2.0 * l - 1.0) * (2.0 * l + 3.0)), 1e-14);
}

static void test_missing(void **state) {
    (void)state;
    const double node[3] = {0.0, 0.0, 1.0};
    const aur_density densities[] = {
        {.size = sizeof(aur_density), .kind = AUR_DENSITY_FUNCTION},
        {.size = sizeof(aur_density), .kind = AUR_DENSITY_NODES, .node_count = 1},
        {.size = sizeof(aur_density), .kind = AUR_DENSITY_NODES, .node_count = 1, .nodes = node}};
    for (size_t i = 0; i < 3; ++i) {
        aur_potential *potential;
        aur_error error;
        assert_int_equal(aur_potential_create(&densities[i], 1.5, &potential, &error), AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "needs its"));
        assert_null(potential);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden),       cmocka_unit_test(test_long_series),
        cmocka_unit_test(test_definition),   cmocka_unit_test(test_clipped),
        cmocka_unit_test(test_function),     cmocka_unit_test(test_function_that_fails),
        cmocka_unit_test(test_cross_energy), cmocka_unit_test(test_kernel_rows),
        cmocka_unit_test(test_missing),      cmocka_unit_test(test_smooth_kernels),
        cmocka_unit_test(test_smooth_rates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
