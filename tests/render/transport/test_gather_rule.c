#include "check.h"

#include "points/base/random.h"
#include "render/sampling/rule.h"

static aur_gather_rule_options options_of(const char *set, aur_scramble scramble, size_t count, bool optimal,
                                          size_t rotations) {
    return (aur_gather_rule_options){.set = set,
                                     .count = count,
                                     .map = AUR_MAP_LAMBERT,
                                     .scramble = scramble,
                                     .optimal_density = optimal,
                                     .smoothness = 1.5,
                                     .rotations = rotations,
                                     .seed = 5};
}

typedef double (*function)(aur_vector);

static double one(aur_vector v) {
    (void)v;
    return 1.0;
}

static double smooth(aur_vector v) {
    return 1.0 + 0.5 * (double)v.x + 0.25 * (double)v.y + (double)v.z;
}

/* The mean over several rotations of the rule's estimate of the integral of cos^exponent * f. */
static double integrate(const aur_gather_rule *rule, function f, size_t rotations) {
    double sum = 0.0;
    for (uint64_t t = 0; t < rotations; ++t) {
        const aur_gather_rotation rotation = aur_gather_rule_rotation(rule, aur_hash2(3, t));
        for (size_t i = 0; i < rule->count; ++i) {
            aur_vector v;
            const float weight = aur_gather_rule_direction(rule, &rotation, i, &v);
            assert_near(aur_vector_length(v), 1.0, 1e-5);
            assert_true(v.z >= 0.0f);
            sum += (double)weight * f(v);
        }
    }
    return sum / (double)(rule->count * rotations);
}

/* Integrals over the hemisphere: cos^m gives 2 pi / (m + 1); of `smooth` the odd parts vanish and cos^m * z
 * gives 2 pi / (m + 2). */
static void integrates_lobes(void **state) {
    (void)state;
    static const struct {
        const char *set;
        aur_scramble scramble;
    } cases[] = {{"spherical-fibonacci", AUR_SCRAMBLE_ROTATE},
                 {"sobol", AUR_SCRAMBLE_DIGIT},
                 {"sobol", AUR_SCRAMBLE_OWEN},
                 {"hammersley", AUR_SCRAMBLE_SHIFT},
                 {"larcher-pillichshammer", AUR_SCRAMBLE_DIGIT}};
    static const double exponents[] = {0.0, 1.0, 20.0, 200.0};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
        for (size_t e = 0; e < 4; ++e) {
            for (int optimal = 0; optimal < 2; ++optimal) {
                for (size_t rotations = 0; rotations <= 16; rotations += 16) {
                    const double m = exponents[e];
                    const aur_gather_rule_options options =
                        options_of(cases[c].set, cases[c].scramble, 1024, optimal != 0, rotations);
                    aur_gather_rule rule;
                    aur_error error = {0};
                    assert_int_equal(aur_gather_rule_create(&options, m, &rule, &error), AUR_OK);
                    assert_relative(integrate(&rule, one, 16), 2.0 * AUR_PI / (m + 1.0),
                                    optimal ? 2e-3 : 1e-6);
                    assert_relative(integrate(&rule, smooth, 16),
                                    2.0 * AUR_PI / (m + 1.0) + 2.0 * AUR_PI / (m + 2.0), 4e-3);
                    aur_gather_rule_release(&rule);
                }
            }
        }
    }
}

/* As many different patterns as prepared rotations, and no more. */
static void prepared_rotations_are_few(void **state) {
    (void)state;
    const aur_gather_rule_options options = options_of("sobol", AUR_SCRAMBLE_DIGIT, 32, false, 4);
    aur_gather_rule rule;
    aur_error error = {0};
    assert_int_equal(aur_gather_rule_create(&options, 1.0, &rule, &error), AUR_OK);
    float seen[4];
    size_t distinct = 0;
    for (uint64_t hash = 0; hash < 64; ++hash) {
        aur_vector v;
        const aur_gather_rotation rotation = aur_gather_rule_rotation(&rule, aur_mix64(hash));
        aur_gather_rule_direction(&rule, &rotation, 7, &v);
        size_t k = 0;
        while (k < distinct && seen[k] != v.x)
            ++k;
        if (k == distinct) {
            assert_true(distinct < 4);
            seen[distinct++] = v.x;
        }
    }
    assert_int_equal(distinct, 4);
    aur_gather_rule_release(&rule);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrates_lobes),
        cmocka_unit_test(prepared_rotations_are_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
