/* The part of a lobe above the horizon, and weights scaled by it. */
#include <aureole/quadrature.h>

#include "check.h"

#include "render/gather/rules.h"

#define PI 3.14159265358979323846

enum { COUNT = 48 };

static aur_gather_rule rule_of(const char *set, aur_scramble scramble, double exponent, bool optimal,
                               size_t rotations) {
    const aur_gather_rule_options options = {.set = set,
                                             .count = COUNT,
                                             .scramble = scramble,
                                             .optimal_density = optimal,
                                             .smoothness = 1.5,
                                             .rotations = rotations,
                                             .seed = 9};
    aur_gather_rule rule;
    assert_int_equal(aur_gather_rule_create(&options, exponent, &rule, NULL), AUR_OK);
    return rule;
}

static void visible_part(void **state) {
    (void)state;
    static const double exponents[] = {0.0, 0.3, 1.0, 20.0, 200.0};
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; ++e) {
        aur_gather_horizon horizon;
        aur_gather_horizon_fill(exponents[e], &horizon);
        for (size_t i = 0; i <= AUR_HORIZON_STEPS; i += 16) {
            const double angle = 0.5 * PI * (double)i / AUR_HORIZON_STEPS;
            const aur_density density = {.size = sizeof(aur_density),
                                         .axis = {sin(angle), 0.0, fmax(0.0, cos(angle))},
                                         .exponent = exponents[e],
                                         .clipped = true};
            aur_potential *potential;
            assert_int_equal(aur_potential_create(&density, 1.5, &potential, NULL), AUR_OK);
            assert_near(horizon.visible[i], aur_potential_mass(potential) * (exponents[e] + 1.0) / (2.0 * PI),
                        1e-5);
            aur_potential_destroy(potential);
        }
    }
}

/* With scaling, the samples above the surface carry the mass of the lobe above it, for every kind of rule. */
static void scaled_weights(void **state) {
    (void)state;
    static const struct {
        const char *set;
        aur_scramble scramble;
        size_t rotations;
    } cases[] = {{"spherical-fibonacci", AUR_SCRAMBLE_ROTATE, 16},
                 {"sobol", AUR_SCRAMBLE_DIGIT, 5},
                 {"sobol", AUR_SCRAMBLE_DIGIT, 0},
                 {"random", AUR_SCRAMBLE_ROTATE, 0}};
    const double m = 20.0, mass = 2.0 * PI / (m + 1.0);
    aur_gather_horizon horizon;
    aur_gather_horizon_fill(m, &horizon);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        aur_gather_rule rule = rule_of(cases[c].set, cases[c].scramble, m, true, cases[c].rotations);
        for (uint64_t step = 0; step <= 18; ++step) {
            const double angle = 5.0 * (double)step * PI / 180.0;
            const aur_vector normal = {(float)(sin(angle) * 0.6), (float)(sin(angle) * 0.8),
                                       (float)cos(angle)};
            const aur_gather_rotation rotation =
                aur_gather_rule_rotation(&rule, step * UINT64_C(0x9e3779b97f4a7c15));
            const double factor = (double)aur_gather_horizon_factor(&rule, &horizon, &rotation, normal);
            double sum = 0.0;
            for (size_t i = 0; i < COUNT; ++i) {
                aur_vector v;
                const double weight = (double)aur_gather_rule_direction(&rule, &rotation, i, &v) / COUNT;
                sum += aur_vector_dot(v, normal) > 0.0f ? factor * weight : 0.0;
            }
            if (angle < 0.5) {
                assert_true(factor == 1.0); /* the whole lobe is visible: nothing is changed */
                continue;
            }
            const size_t at = (size_t)lround(angle / (0.5 * PI) * AUR_HORIZON_STEPS);
            const double share = (double)horizon.visible[at];
            if (share < 0.9999)
                assert_relative(sum, mass * share, 0.02 + 1e-4); /* the nearest step of the table here */
        }
        aur_gather_rule_release(&rule);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(visible_part), cmocka_unit_test(scaled_weights)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
