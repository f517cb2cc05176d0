#include "sphere_check.h"

#include <string.h>

#include "points/base/simd.h"
#include "points/sphere/repulsion/repulsion.h"

/* The sum over pairs of 1/|x - y|, for axes with that of 1/|x + y|. */
static double coulomb(size_t count, const double *xyz, bool axes) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < i; ++k) {
            const double c = check_dot(xyz + 3 * i, xyz + 3 * k);
            sum += 1.0 / sqrt(2.0 - 2.0 * c) + (axes ? 1.0 / sqrt(2.0 + 2.0 * c) : 0.0);
        }
    return sum;
}

static double *charges(const char *set, size_t count, aur_domain domain) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    return check_directions(set, options);
}

static double rest(const char *set, size_t count, aur_domain domain) {
    double *const xyz = charges(set, count, domain);
    const double energy = coulomb(count, xyz, domain == AUR_DOMAIN_AXES);
    free(xyz);
    return energy;
}

/* The energies that everybody finds (Thomson problem: Wales and Ulker 2006, table of global minima). */
static void charges_come_to_the_known_rests(void **state) {
    (void)state;
    assert_relative(rest("electrostatic", 4, AUR_DOMAIN_SPHERE), 3.674234614, 1e-9);
    assert_relative(rest("electrostatic", 12, AUR_DOMAIN_SPHERE), 49.165253058, 1e-9);
    assert_relative(rest("electrostatic", 32, AUR_DOMAIN_SPHERE), 412.261274651, 1e-9);
    assert_relative(rest("electrostatic", 72, AUR_DOMAIN_SPHERE), 2255.001190975, 1e-9);
    assert_relative(rest("electrostatic", 24, AUR_DOMAIN_SPHERE), 223.347074052, 1e-9);
    assert_relative(rest("electrostatic", 200, AUR_DOMAIN_SPHERE), 18438.842717530, 1e-9);
    assert_relative(rest("electrostatic:starts=1", 282, AUR_DOMAIN_SPHERE), 37147.294418462, 1e-10);
}

/* Antipodal charges that are the best of all 2 N charges are the best axes: octahedron and icosahedron, less
 * the pairs of opposites. */
static void axes_of_regular_bodies_are_found(void **state) {
    (void)state;
    assert_relative(rest("electrostatic", 3, AUR_DOMAIN_AXES), (9.985281374 - 1.5) / 2.0, 1e-9);
    assert_relative(rest("electrostatic", 6, AUR_DOMAIN_AXES), (49.165253058 - 3.0) / 2.0, 1e-9);
}

static void the_push_is_the_sum_and_its_gradient_for_every_instruction_set(void **state) {
    (void)state;
    enum { COUNT = 37, STRIDE = 48, FIRST = 5, LAST = 36, INDEX = 11 };
    double xyz[3 * COUNT];
    static double room[3 * STRIDE];
    aur_charges q = {.count = COUNT, .x = room, .y = room + STRIDE, .z = room + 2 * STRIDE};
    for (size_t i = 0; i < COUNT; ++i) {
        double *const x = xyz + 3 * i;
        check_random_direction(5, i, x);
        q.x[i] = x[0];
        q.y[i] = x[1];
        q.z[i] = x[2];
    }
    for (int axes = 0; axes < 2; ++axes) {
        q.axes = axes != 0;
        const aur_push push = aur_push_portable(&q, INDEX, FIRST, LAST);
        double energy = 0.0, gradient[3] = {0.0};
        for (size_t j = FIRST; j < LAST; ++j) {
            const double c = check_dot(xyz + 3 * INDEX, xyz + 3 * j);
            const double near = 1.0 / sqrt(2.0 - 2.0 * c), far = 1.0 / sqrt(2.0 + 2.0 * c);
            if (j == INDEX)
                continue;
            energy += near + (axes ? far : 0.0);
            for (size_t d = 0; d < 3; ++d)
                gradient[d] += xyz[3 * j + d] * (near * near * near - (axes ? far * far * far : 0.0));
        }
        /* The oracle's 2 - 2c has a relative error of 2 units over d^2 > 1e-3, here 1e-12. */
        assert_relative(push.energy, energy, 1e-12);
        for (size_t d = 0; d < 3; ++d)
            assert_near(push.gradient[d], gradient[d], 1e-11 * energy);
#if !defined(AUR_PORTABLE)
        if (aur_isa_available() >= AUR_ISA_AVX2) {
            const aur_push same = aur_push_avx2(&q, INDEX, FIRST, LAST);
            assert_memory_equal(&push, &same, sizeof push);
        }
        if (aur_isa_available() >= AUR_ISA_AVX512) {
            const aur_push same = aur_push_avx512(&q, INDEX, FIRST, LAST);
            assert_memory_equal(&push, &same, sizeof push);
        }
#endif
    }
}

/* At rest no charge is pushed along the sphere. */
static void nothing_moves_at_rest(void **state) {
    (void)state;
    enum { COUNT = 100 };
    double *const xyz = charges("electrostatic:starts=1", COUNT, AUR_DOMAIN_AXES);
    for (size_t i = 0; i < COUNT; ++i) {
        const double *const x = xyz + 3 * i;
        double force[3] = {0.0}, strength = 0.0;
        for (size_t j = 0; j < COUNT; ++j) {
            const double c = check_dot(x, xyz + 3 * j);
            const double near = j != i ? pow(2.0 - 2.0 * c, -1.5) : 0.0;
            const double far = j != i ? pow(2.0 + 2.0 * c, -1.5) : 0.0;
            for (size_t d = 0; d < 3; ++d)
                force[d] += xyz[3 * j + d] * (near - far);
            strength += near + far;
        }
        const double along = check_dot(force, x);
        for (size_t d = 0; d < 3; ++d)
            assert_near(force[d] - along * x[d], 0.0, 1e-5 * strength);
        assert_true(x[2] >= 0.0);
    }
    free(xyz);
}

/* Each prefix of six axes or more has at most 3 % more energy than that many axes optimised separately; those
 * of Sobol points have 5 % more at 15. */
static void every_prefix_is_even(void **state) {
    (void)state;
    double *const all = charges("electrostatic", 60, AUR_DOMAIN_AXES);
    for (size_t count = 6; count < 60; count += 9)
        assert_true(coulomb(count, all, true) < 1.03 * rest("electrostatic", count, AUR_DOMAIN_AXES));
    free(all);
}

static void shells_are_even_together_and_alone(void **state) {
    (void)state;
    double *const all = charges("electrostatic:shells=20/40", 60, AUR_DOMAIN_AXES);
    assert_true(coulomb(60, all, true) < 1.002 * rest("electrostatic", 60, AUR_DOMAIN_AXES));
    assert_true(coulomb(20, all, true) < 1.005 * rest("electrostatic", 20, AUR_DOMAIN_AXES));
    assert_true(coulomb(40, all + 60, true) < 1.005 * rest("electrostatic", 40, AUR_DOMAIN_AXES));
    free(all);
}

static void refused(const char *set, size_t count, aur_domain domain, double cap, aur_result expected,
                    const char *words) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.cap_degrees = cap;
    aur_directions *directions;
    aur_error error = {0};
    assert_int_equal(aur_directions_create(set, &options, &directions, &error), expected);
    if (strstr(error.message, words) == NULL)
        fail_msg("'%s' does not say '%s'", error.message, words);
}

static void what_has_no_meaning_is_refused(void **state) {
    (void)state;
    refused("electrostatic", 12, AUR_DOMAIN_HEMISPHERE, 0.0, AUR_ERROR_UNSUPPORTED, "'hemisphere'");
    refused("electrostatic", 12, AUR_DOMAIN_AXES, 30.0, AUR_ERROR_UNSUPPORTED, "no cap");
    refused("electrostatic", 1 << 15, AUR_DOMAIN_AXES, 0.0, AUR_ERROR_ARGUMENT, "sizes");
    refused("electrostatic:shells=3/4", 12, AUR_DOMAIN_AXES, 0.0, AUR_ERROR_ARGUMENT, "add up to the 12");
    refused("electrostatic:shells=12/0", 12, AUR_DOMAIN_AXES, 0.0, AUR_ERROR_ARGUMENT, "'12/0'");
    refused("electrostatic:shells=6/6/", 12, AUR_DOMAIN_AXES, 0.0, AUR_ERROR_ARGUMENT, "'6/6/'");
    for (size_t count = 1; count < 3; ++count)
        free(charges("electrostatic", count, AUR_DOMAIN_AXES));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(charges_come_to_the_known_rests),
        cmocka_unit_test(axes_of_regular_bodies_are_found),
        cmocka_unit_test(the_push_is_the_sum_and_its_gradient_for_every_instruction_set),
        cmocka_unit_test(nothing_moves_at_rest),
        cmocka_unit_test(every_prefix_is_even),
        cmocka_unit_test(shells_are_even_together_and_alone),
        cmocka_unit_test(what_has_no_meaning_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
