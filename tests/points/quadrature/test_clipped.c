/* Clipped lobes of every exponent against a quadrature that no singularity of theirs disturbs. */
#include <aureole/quadrature.h>
#include <stdlib.h>

#include "check.h"

#define PI 3.14159265358979323846

/* Tanh-sinh nodes crowd doubly exponentially at both ends of an interval, so an interval may end at any kink
 * or zero of the integrand (Takahasi and Mori 1974). With 71 nodes the smooth middle is good to 1e-9 for the
 * sharpest lobe here. */
enum { NODES = 71, CUTS = 4 };

typedef struct end_rule {
    double from_start[NODES], from_end[NODES], weight[NODES]; /* of [0,1] */
} end_rule;

static void make_rule(end_rule *rule) {
    const double reach = 3.6, step = 2.0 * reach / (NODES - 1);
    for (int i = 0; i < NODES; ++i) {
        const double t = -reach + step * i;
        const double e = 0.5 * PI * sinh(t);
        rule->from_start[i] = 1.0 / (1.0 + exp(-2.0 * e));
        rule->from_end[i] = 1.0 / (1.0 + exp(2.0 * e));
        rule->weight[i] = 0.25 * PI * step * cosh(t) / (cosh(e) * cosh(e));
    }
}

/* Nodes of an angle on [cuts[0], cuts[CUTS-1]], weights times cos^exponent, and the way from `place`, which
 * is exact near it where it is a cut. */
typedef struct angle_nodes {
    size_t count;
    double angle[(CUTS - 1) * NODES], away[(CUTS - 1) * NODES], weight[(CUTS - 1) * NODES];
} angle_nodes;

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* From -reach to `end`, cut at the middle of the lobe and at `peak`. */
static void make_angles(const end_rule *rule, double end, double peak, double exponent, angle_nodes *nodes) {
    const double reach = acos(pow(1e-17, 1.0 / exponent));
    const double last = fmin(end, reach);
    double cuts[CUTS] = {-reach, fmin(0.0, last), fmax(-reach, fmin(peak, last)), last};
    qsort(cuts, CUTS, sizeof *cuts, ascending);
    nodes->count = 0;
    for (int piece = 0; piece + 1 < CUTS; ++piece) {
        const double length = cuts[piece + 1] - cuts[piece];
        for (int i = 0; i < NODES && length > 0.0; ++i) {
            const size_t at = nodes->count++;
            const double start = length * rule->from_start[i], rest = length * rule->from_end[i];
            nodes->angle[at] = start < rest ? cuts[piece] + start : cuts[piece + 1] - rest;
            nodes->away[at] = cuts[piece] == peak       ? start
                              : cuts[piece + 1] == peak ? -rest
                                                        : nodes->angle[at] - peak;
            nodes->weight[at] = length * rule->weight[i] * pow(fmax(0.0, cos(nodes->angle[at])), exponent);
        }
    }
}

/* The integral over the visible part of the lobe, unnormalised, in the lobe's own angles: psi towards the
 * horizon at `horizon`, beta across; of the kernel at (place, aside), and of 1. */
static double integrate(const end_rule *rule, double exponent, double smoothness, double horizon, double peak,
                        double aside, double *mass) {
    angle_nodes psi, beta;
    make_angles(rule, horizon, peak, exponent, &psi);
    make_angles(rule, 0.5 * PI, aside, exponent + 1.0, &beta);
    const double top = pow(2.0, 2.0 * smoothness - 1.0) / smoothness;
    double sum = 0.0;
    *mass = 0.0;
    for (size_t j = 0; j < beta.count; ++j) {
        const double across = sin(0.5 * beta.away[j]);
        const double both = 4.0 * cos(beta.angle[j]) * cos(aside);
        double row = 0.0, row_mass = 0.0;
        for (size_t i = 0; i < psi.count; ++i) {
            const double along = sin(0.5 * psi.away[i]);
            const double chord2 = fmax(0.0, 4.0 * across * across + both * along * along);
            const double power = smoothness == 1.5 ? sqrt(chord2) : pow(chord2, smoothness - 1.0);
            row += psi.weight[i] * (top - power);
            row_mass += psi.weight[i];
        }
        sum += beta.weight[j] * row;
        *mass += beta.weight[j] * row_mass;
    }
    return sum;
}

static aur_potential *tilted(double exponent, double radians, double smoothness) {
    const aur_density density = {.size = sizeof(aur_density),
                                 .exponent = exponent,
                                 .axis = {sin(radians), 0.0, cos(radians)},
                                 .clipped = true};
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&density, smoothness, &potential, NULL), AUR_OK);
    return potential;
}

/* The direction at (psi, beta) of the lobe whose axis is tilted by that angle. */
static void place_at(double radians, double psi, double beta, double u[3]) {
    u[0] = cos(beta) * sin(radians + psi);
    u[1] = sin(beta);
    u[2] = fmax(0.0, cos(beta) * cos(radians + psi));
}

/* z to 1e-6 and the mass to 1e-7, whatever the exponent: integer or not, below 1 or above. */
static void test_every_exponent(void **state) {
    (void)state;
    static const double exponents[] = {0.1, 0.3, 0.5, 0.9, 1.0, 1.3, 2.0, 2.6, 5.5, 20.0, 33.3, 131.3, 200.0};
    static const double degrees[] = {5.0, 60.0, 89.9};
    /* Samples above the horizon by so much, at these latitudes. */
    static const double heights[][2] = {{1e-12, 0.7}, {1e-5, 0.0}, {1e-3, 0.0},
                                        {0.01, 0.7},  {0.1, 1.5},  {0.8, 0.2}};
    end_rule rule;
    make_rule(&rule);
    for (size_t k = 0; k < 2; ++k) {
        const double smoothness = k == 0 ? 1.5 : 1.1;
        double worst = 0.0;
        for (size_t e = 0; e < sizeof exponents / sizeof *exponents; ++e) {
            for (size_t d = 0; d < sizeof degrees / sizeof *degrees; ++d) {
                const double radians = degrees[d] * PI / 180.0, horizon = 0.5 * PI - radians;
                aur_potential *const potential = tilted(exponents[e], radians, smoothness);
                for (size_t h = 0; h < sizeof heights / sizeof *heights; ++h) {
                    const double psi = horizon - heights[h][0], beta = heights[h][1];
                    double u[3], z, mass;
                    place_at(radians, psi, beta, u);
                    aur_potential_evaluate(potential, 1, u, &z);
                    const double expected =
                        integrate(&rule, exponents[e], smoothness, horizon, psi, beta, &mass);
                    assert_relative(z * aur_potential_mass(potential), expected, 1e-6);
                    assert_relative(aur_potential_mass(potential), mass, 1e-7);
                    worst = fmax(worst, fabs(z * aur_potential_mass(potential) / expected - 1.0));
                }
                aur_potential_destroy(potential);
            }
        }
        print_message("smoothness %g: z of clipped lobes within %.1e\n", smoothness, worst);
    }
}

/* V is the mean potential over the visible part, to 1e-6. */
static void test_self_energy(void **state) {
    (void)state;
    static const double exponents[] = {0.1, 0.6, 1.3, 20.5};
    end_rule rule;
    make_rule(&rule);
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; ++e) {
        const double radians = 70.0 * PI / 180.0, horizon = 0.5 * PI - radians;
        aur_potential *const potential = tilted(exponents[e], radians, 1.5);
        angle_nodes psi, beta;
        make_angles(&rule, horizon, horizon, exponents[e], &psi);
        make_angles(&rule, 0.0, 0.0, exponents[e] + 1.0, &beta); /* one half: it is symmetric */
        double energy = 0.0, mass = 0.0;
        for (size_t i = 0; i < psi.count; ++i) {
            for (size_t j = 0; j < beta.count; ++j) {
                double u[3], z;
                const double weight = psi.weight[i] * beta.weight[j];
                if (!(weight > 1e-12))
                    continue;
                place_at(radians, psi.angle[i], beta.angle[j], u);
                aur_potential_evaluate(potential, 1, u, &z);
                energy += weight * z;
                mass += weight;
            }
        }
        assert_relative(aur_potential_self_energy(potential), energy / mass, 1e-6);
        aur_potential_destroy(potential);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_exponent),
                                       cmocka_unit_test(test_self_energy)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
