/* Weights of merged samples as used by the gather loop: tables against solves, constants exactly, subsets
 * against the whole. */
#include <stdlib.h>

#include "check.h"

#include "lab/gathering/merged_rule.h"

#define PI 3.14159265358979323846

enum { DIFFUSE = 48, GLOSSY = 24, SIZE = DIFFUSE + GLOSSY, ROTATIONS = 3 };

/* What a rule is created for. */
typedef struct inputs {
    lab_gather_settings settings;
    aur_gather_common common;
    lab_merged_options options;
} inputs;

static void set_inputs(inputs *in, lab_weights method, double exponent, bool clipped, size_t subsets) {
    *in = (inputs){.settings = {.gather = {.pattern = "sobol",
                                           .rotations = ROTATIONS,
                                           .smoothness = 1.5,
                                           .clip = clipped},
                                .weights = method,
                                .regularization = method == LAB_WEIGHTS_SOLVE ? 0.5 : 1e-6},
                   .common = {.scramble = AUR_SCRAMBLE_DIGIT, .seed = 77, .subsets = subsets, .threads = 2},
                   .options = {.settings = &in->settings,
                               .common = &in->common,
                               .count = {DIFFUSE, GLOSSY},
                               .exponent = exponent}};
}

static lab_merged_rule *create(const inputs *in) {
    lab_merged_rule *pair;
    assert_int_equal(lab_merged_rule_create(&in->options, &pair, NULL), AUR_OK);
    return pair;
}

/* The directions of a subset in the frame of normal and plane of reflection, as the gather loop makes them.
 */
static void surface_point(const lab_merged_rule *pair, size_t rotation, size_t subset, double angle,
                          bool mirrored, double *xyz) {
    lab_frame frames[2];
    lab_merged_rule_frames((lab_vector){0.0f, 0.0f, 1.0f},
                           (lab_vector){-(float)sin(angle), 0.0f, (float)cos(angle)}, mirrored, frames);
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        const size_t first = rotation * pair->count[pattern] + subset * pair->subset_count[pattern];
        for (size_t i = 0; i < pair->subset_count[pattern]; ++i, xyz += 3) {
            lab_vector u = lab_scale(frames[pattern].x, pair->direction[pattern][0][first + i]);
            u = lab_add_scaled(u, pair->direction[pattern][1][first + i], frames[pattern].y);
            u = lab_add_scaled(u, pair->direction[pattern][2][first + i], frames[pattern].z);
            const double length =
                sqrt((double)u.x * (double)u.x + (double)u.y * (double)u.y + (double)u.z * (double)u.z);
            xyz[0] = (double)u.x / length;
            xyz[1] = (double)u.y / length;
            xyz[2] = (double)u.z / length;
        }
    }
}

static aur_potential *lobe_at(double exponent, double angle, bool clipped) {
    aur_potential *potential;
    const aur_density density = {.size = sizeof(aur_density),
                                 .exponent = exponent,
                                 .axis = {-sin(angle), 0.0, fmax(0.0, cos(angle))},
                                 .clipped = clipped};
    assert_int_equal(aur_potential_create(&density, 1.5, &potential, NULL), AUR_OK);
    return potential;
}

static double worst_case(const double *xyz, const double *weights, const aur_potential *potential) {
    double error;
    assert_int_equal(aur_worst_case_error(SIZE, xyz, weights, potential, NULL, &error, NULL), AUR_OK);
    return error;
}

/* Over angles, turns and mirror images, looked-up weights on the directions that the loop uses have the
 * worst-case error of a solve on the same directions to half a percent of what weights gain, and integrate
 * constants to rounding. */
static void tables_are_solves(void **state) {
    (void)state;
    static const struct {
        double exponent;
        bool clipped, optimal;
    } cases[] = {{20.0, true, false}, {20.0, false, true}, {150.0, true, true}, {3.3, true, false}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        const double m = cases[c].exponent;
        inputs in;
        set_inputs(&in, LAB_WEIGHTS_OSWA, m, cases[c].clipped, 1);
        in.settings.gather.density = cases[c].optimal ? AUR_GATHER_DENSITY_OPTIMAL : AUR_GATHER_DENSITY_SAME;
        lab_merged_rule *const pair = create(&in);
        double looked_up_total = 0.0, solved_total = 0.0, equal_total = 0.0;
        for (size_t step = 0; step < 18; ++step) {
            const double angle = (0.4 + 5.0 * (double)step) * PI / 180.0;
            float weights[2 * SIZE];
            double xyz[3 * SIZE], from_table[SIZE], equal[SIZE] = {0}, exact[2 * SIZE];
            surface_point(pair, step % ROTATIONS, 0, angle, step % 2 == 1, xyz);
            lab_merged_rule_weights(pair, step % ROTATIONS, 0, (float)cos(angle), weights);
            aur_potential *const lobes[2] = {lobe_at(1.0, 0.0, false), lobe_at(m, angle, cases[c].clipped)};
            const aur_potential *const potentials[2] = {lobes[0], lobes[1]};
            assert_int_equal(
                aur_weights_solve(SIZE, xyz, 2, potentials, NULL, 2 * SIZE, exact, NULL, NULL, NULL), AUR_OK);
            for (size_t lobe = 0; lobe < 2; ++lobe) {
                const double mass = aur_potential_mass(lobes[lobe]);
                size_t visible = 0;
                double sum = 0.0;
                for (size_t i = 0; i < SIZE; ++i) {
                    from_table[i] = (double)weights[lobe * SIZE + i] / mass;
                    sum += from_table[i];
                    const bool mine = lobe == 0 ? i < DIFFUSE : i >= DIFFUSE;
                    visible += mine && (!cases[c].clipped || xyz[3 * i + 2] >= 0.0);
                }
                for (size_t i = 0; i < SIZE; ++i)
                    if ((lobe == 0 ? i < DIFFUSE : i >= DIFFUSE) &&
                        (!cases[c].clipped || xyz[3 * i + 2] >= 0.0))
                        equal[i] = 1.0 / (double)visible;
                    else
                        equal[i] = 0.0;
                assert_near(sum, 1.0, 2e-4); /* of the mass's interpolation */
                looked_up_total += worst_case(xyz, from_table, lobes[lobe]);
                solved_total += worst_case(xyz, exact + lobe * SIZE, lobes[lobe]);
                equal_total += worst_case(xyz, equal, lobes[lobe]);
            }
            aur_potential_destroy(lobes[0]);
            aur_potential_destroy(lobes[1]);
        }
        const double loss = (looked_up_total - solved_total) / (equal_total - solved_total);
        print_message("m %g: look-ups lose %.3f %% of the gain\n", m, 100.0 * loss);
        assert_true(loss < 0.005);
        lab_merged_rule_destroy(pair);
    }
}

/* Constant light of one: the sum of the weights is the mass of the lobe above the surface, for whatever part
 * of the samples is hidden, over all subsets together. */
static void constants_are_exact(void **state) {
    (void)state;
    inputs in;
    set_inputs(&in, LAB_WEIGHTS_OSWA, 20.0, true, 4);
    lab_merged_rule *const pair = create(&in);
    assert_int_equal(lab_merged_rule_samples(pair), SIZE / 4);
    for (size_t step = 0; step <= 30; ++step) {
        const double angle = 3.0 * (double)step * PI / 180.0;
        double sums[2] = {0.0, 0.0};
        for (size_t subset = 0; subset < 4; ++subset) {
            float weights[2 * SIZE / 4];
            double xyz[3 * SIZE / 4];
            lab_merged_rule_weights(pair, step % ROTATIONS, subset, (float)cos(angle), weights);
            surface_point(pair, step % ROTATIONS, subset, angle, false, xyz);
            for (size_t i = 0; i < SIZE / 4; ++i) {
                /* Hidden samples carry nothing. */
                if (xyz[3 * i + 2] < -1e-3)
                    assert_true(weights[i] == 0.0f && weights[SIZE / 4 + i] == 0.0f);
                sums[0] += (double)weights[i] / 4.0;
                sums[1] += (double)weights[SIZE / 4 + i] / 4.0;
            }
        }
        aur_potential *const lobe = lobe_at(20.0, fmin(angle, 0.5 * PI), true);
        assert_relative(sums[0], PI, 2e-6);
        assert_relative(sums[1], aur_potential_mass(lobe), 2e-4);
        aur_potential_destroy(lobe);
    }
    lab_merged_rule_destroy(pair);
}

/* Subsets are a permutation: together they hold the directions and weights of the whole. */
static void parts_make_the_whole(void **state) {
    (void)state;
    for (int method = LAB_WEIGHTS_MIS; method <= LAB_WEIGHTS_SOLVE; ++method) {
        inputs one, four;
        set_inputs(&one, (lab_weights)method, 20.0, true, 1);
        set_inputs(&four, (lab_weights)method, 20.0, true, 4);
        lab_merged_rule *const whole = create(&one);
        lab_merged_rule *const shared = create(&four);
        float expected[2 * SIZE];
        lab_merged_rule_weights(whole, 1, 0, 0.5f, expected);
        for (size_t subset = 0; subset < 4; ++subset) {
            float weights[2 * SIZE / 4];
            lab_merged_rule_weights(shared, 1, subset, 0.5f, weights);
            for (size_t pattern = 0, at = 0; pattern < 2; ++pattern) {
                const size_t count = shared->subset_count[pattern];
                for (size_t i = 0; i < count; ++i, ++at) {
                    const size_t index = 4 * i + subset;
                    for (size_t k = 0; k < 3; ++k)
                        assert_true(
                            shared->direction[pattern][k][shared->count[pattern] + subset * count + i] ==
                            whole->direction[pattern][k][whole->count[pattern] + index]);
                    for (size_t lobe = 0; lobe < 2; ++lobe)
                        assert_near(weights[lobe * SIZE / 4 + at],
                                    4.0f * expected[lobe * SIZE + pattern * DIFFUSE + index], 1e-5);
                }
            }
        }
        lab_merged_rule_destroy(whole);
        lab_merged_rule_destroy(shared);
    }
}

/* The balance heuristic is that of the library, in float and in the loop's frames. */
static void balance_is_the_library_s(void **state) {
    (void)state;
    for (int optimal = 0; optimal < 2; ++optimal) {
        inputs in;
        set_inputs(&in, LAB_WEIGHTS_MIS, 20.0, true, 1);
        in.settings.gather.density = optimal == 1 ? AUR_GATHER_DENSITY_OPTIMAL : AUR_GATHER_DENSITY_SAME;
        lab_merged_rule *const pair = create(&in);
        for (size_t step = 0; step < 9; ++step) {
            const double angle = 10.0 * (double)step * PI / 180.0;
            float weights[2 * SIZE];
            double xyz[3 * SIZE], expected[SIZE];
            surface_point(pair, 0, 0, angle, false, xyz);
            lab_merged_rule_weights(pair, 0, 0, (float)cos(angle), weights);
            const double power = optimal == 1 ? 0.8 : 1.0;
            const aur_strategy strategies[2] = {{.count = DIFFUSE, .sampled = {.exponent = power}},
                                                {.count = GLOSSY,
                                                 .sampled = {.exponent = 20.0 * power},
                                                 .axis = {-sin(angle), 0.0, cos(angle)}}};
            for (size_t lobe = 0; lobe < 2; ++lobe) {
                aur_potential *const target =
                    lobe == 0 ? lobe_at(1.0, 0.0, false) : lobe_at(20.0, angle, true);
                const double mass = aur_potential_mass(target);
                assert_int_equal(
                    aur_mis_weights(AUR_MIS_BALANCE, 2, strategies, target, SIZE, xyz, expected, NULL),
                    AUR_OK);
                for (size_t i = 0; i < SIZE; ++i)
                    if (fabs(xyz[3 * i + 2]) > 1e-5)
                        assert_near(weights[lobe * SIZE + i], mass * expected[i],
                                    1e-5 + 2e-4 * mass * expected[i]);
                aur_potential_destroy(target);
            }
        }
        lab_merged_rule_destroy(pair);
    }
}

/* The pdf that weights light sampling is that of the directions. */
static void densities(void **state) {
    (void)state;
    inputs in;
    set_inputs(&in, LAB_WEIGHTS_OSWA, 20.0, true, 4);
    in.settings.gather.density = AUR_GATHER_DENSITY_OPTIMAL;
    lab_merged_rule *const pair = create(&in);
    for (float cosine = 0.05f; cosine <= 1.0f; cosine += 0.05f) {
        const double expected = 12.0 * 1.8 / (2.0 * PI) * pow((double)cosine, 0.8) +
                                6.0 * 17.0 / (2.0 * PI) * pow((double)cosine, 16.0);
        assert_relative(lab_merged_rule_density(pair, cosine, cosine), expected, 0.02 / (double)cosine);
    }
    assert_true(lab_merged_rule_density(pair, -0.5f, -0.1f) == 0.0f);
    lab_merged_rule_destroy(pair);
}

static void refuses(void **state) {
    (void)state;
    lab_merged_rule *pair;
    aur_error error;
    inputs in;
    set_inputs(&in, LAB_WEIGHTS_OSWA, 20.0, true, 1);
    in.settings.gather.rotations = 0;
    assert_int_equal(lab_merged_rule_create(&in.options, &pair, &error), AUR_ERROR_ARGUMENT);
    assert_null(pair);
    set_inputs(&in, LAB_WEIGHTS_OSWA, 20.0, true, 5);
    assert_int_equal(lab_merged_rule_create(&in.options, &pair, &error), AUR_ERROR_ARGUMENT);
    set_inputs(&in, LAB_WEIGHTS_OSWA, 20.0, true, 1);
    in.settings.gather.pattern = "sobl";
    assert_int_equal(lab_merged_rule_create(&in.options, &pair, &error), AUR_ERROR_NAME);
    set_inputs(&in, LAB_WEIGHTS_MIS, -1.0, true, 1);
    assert_int_equal(lab_merged_rule_create(&in.options, &pair, &error), AUR_ERROR_ARGUMENT);
    assert_null(pair);
}

/* A system that cannot be solved is reported, and no weight is a number. Here the solver rejects the result's
 * size, which is too small because the rule omits its second pattern. */
static void unsolved_systems_are_said(void **state) {
    (void)state;
    inputs in;
    set_inputs(&in, LAB_WEIGHTS_SOLVE, 20.0, true, 1);
    lab_merged_rule *const rule = create(&in);
    float weights[2 * SIZE];
    assert_true(lab_merged_rule_weights(rule, 0, 0, 0.5f, weights));
    for (size_t i = 0; i < 2 * SIZE; ++i)
        assert_true(isfinite(weights[i]));
    lab_merged_rule broken = *rule;
    broken.count[1] = 0;
    assert_false(lab_merged_rule_weights(&broken, 0, 0, 0.5f, weights));
    for (size_t i = 0; i < 2 * SIZE; ++i)
        assert_true(isnan(weights[i]));
    lab_merged_rule_destroy(rule);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_solves),
        cmocka_unit_test(constants_are_exact),
        cmocka_unit_test(parts_make_the_whole),
        cmocka_unit_test(balance_is_the_library_s),
        cmocka_unit_test(densities),
        cmocka_unit_test(refuses),
        cmocka_unit_test(unsolved_systems_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
