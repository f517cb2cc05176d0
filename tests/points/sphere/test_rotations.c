#include "sphere_check.h"

#include <aureole/rotations.h>
#include <string.h>

#include "points/base/simd.h"
#include "points/sphere/map.h"
#include "points/sphere/rotations/hopf.h"

static double *generate(const char *set, aur_rotations_options options) {
    aur_rotations *rotations;
    aur_error error = {0};
    if (aur_rotations_create(set, &options, &rotations, &error) != AUR_OK)
        fail_msg("%s: %s", set, error.message);
    const size_t count = (size_t)aur_rotations_size(rotations);
    double *const wxyz = malloc(4 * count * sizeof *wxyz);
    assert_int_equal(aur_rotations_points(rotations, 0, count, 4 * count, wxyz, NULL), AUR_OK);
    aur_rotations_destroy(rotations);
    return wxyz;
}

static double *plain(const char *set, size_t count) {
    aur_rotations_options options = {.size = sizeof options};
    aur_rotations_options_init(count, &options, NULL);
    return generate(set, options);
}

static void super_fibonacci_is_the_published_formula(void **state) {
    (void)state;
    enum { COUNT = 1000 };
    static const long double psi = 1.533751168755204288118041L, turn = 6.283185307179586476925286766559L;
    double *const wxyz = plain("super-fibonacci", COUNT);
    for (size_t i = 0; i < COUNT; ++i) {
        const long double s = (long double)i + 0.5L;
        const long double r = sqrtl(s / COUNT), R = sqrtl(1.0L - s / COUNT);
        const long double a = turn * s / sqrtl(2.0L), b = turn * s / psi;
        const double expected[4] = {(double)(r * sinl(a)), (double)(r * cosl(a)), (double)(R * sinl(b)),
                                    (double)(R * cosl(b))};
        for (size_t d = 0; d < 4; ++d)
            /* 1 - s/N is off by half a unit of 1, and its root, at least (2 N)^-1/2, by that over twice
             * itself. */
            assert_near(wxyz[4 * i + d], expected[d], 4e-15);
    }
    free(wxyz);
}

static void all_instruction_sets_and_parts_have_the_same_bits(void **state) {
    (void)state;
    enum { COUNT = 77 };
    static double first[4 * COUNT], second[4 * COUNT], cube[3 * COUNT];
    const aur_hopf_line line = {0.01, 0.25, {5, UINT64_C(1) << 63}, AUR_SUPER_FIBONACCI_TURNS};
    for (size_t i = 0; i < 3 * COUNT; ++i)
        cube[i] = aur_unit_double(aur_hash2(3, i));
    cube[0] = 0.0;
    cube[1] = cube[2] = 1.0 - 0x1p-53;
    const aur_hopf_kernels *const kernels[] = {
        &aur_hopf_portable,
#if !defined(AUR_PORTABLE)
        aur_isa_available() >= AUR_ISA_AVX2 ? &aur_hopf_avx2 : &aur_hopf_portable,
        aur_isa_available() >= AUR_ISA_AVX512 ? &aur_hopf_avx512 : &aur_hopf_portable,
#endif
    };
    for (size_t k = 0; k < sizeof kernels / sizeof kernels[0]; ++k) {
        kernels[0]->line(&line, 3, COUNT, first);
        kernels[k]->line(&line, 3, 20, second);
        kernels[k]->line(&line, 23, COUNT - 20, second + 80);
        assert_memory_equal(first, second, sizeof first);
        kernels[0]->lift(COUNT, cube, first);
        kernels[k]->lift(COUNT, cube, second);
        assert_memory_equal(first, second, sizeof first);
    }
}

/* The least angle between two quaternions, or one and another's opposite. */
static double smallest(size_t count, const double *wxyz) {
    double most = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < i; ++k)
            most = fmax(most, fabs(aur_dot4(wxyz + 4 * i, wxyz + 4 * k)));
    return acos(fmin(most, 1.0));
}

/* The mean of the distances to all quaternions and their opposites. */
static double energy(size_t count, const double *wxyz) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < count; ++k) {
            const double c = fmin(fabs(aur_dot4(wxyz + 4 * i, wxyz + 4 * k)), 1.0);
            sum += sqrt(2.0 - 2.0 * c) + sqrt(2.0 + 2.0 * c);
        }
    return sqrt(64.0 / (15.0 * AUR_PI) - sum / (2.0 * (double)count * (double)count));
}

static void the_grid_preserves_its_points_and_its_energy(void **state) {
    (void)state;
    double *const whole = plain("super-fibonacci-grid:base=50,levels=2", 3200);
    double *const part = plain("super-fibonacci-grid:base=50,levels=2", 400);
    assert_memory_equal(whole, part, 1600 * sizeof *whole);
    /* 1 to 4 % more than spirals of that many points; between the eightfold sizes up to a fifth more. */
    for (size_t count = 400; count <= 3200; count *= 8) {
        double *const spiral = plain("super-fibonacci", count);
        const double ratio = energy(count, whole) / energy(count, spiral);
        assert_true(ratio > 0.9 && ratio < 1.1);
        free(spiral);
    }
    free(whole);
    free(part);
}

/* Each direction of E-SFG is brought to +x by as many rotations, which are equal turns apart. */
static void lifted_grids_have_their_directions(void **state) {
    (void)state;
    enum { BASE = 20, TURNS = 6, COUNT = BASE * TURNS * 64, DIRECTIONS = BASE * 16 };
    double *const whole = plain("esfg-rotations:levels=2", COUNT);
    double *const part = plain("esfg-rotations:levels=2", 8 * BASE * TURNS);
    assert_memory_equal(whole, part, sizeof *whole * 4 * 8 * BASE * TURNS);
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(DIRECTIONS, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions = NULL;
    double xyz[3 * DIRECTIONS];
    assert_int_equal(aur_directions_create("esfg:base=20,levels=2", &options, &directions, NULL), AUR_OK);
    assert_int_equal(aur_directions_points(directions, 0, DIRECTIONS, 3 * DIRECTIONS, xyz, NULL, NULL),
                     AUR_OK);
    aur_directions_destroy(directions);
    size_t found[DIRECTIONS] = {0};
    double turned[DIRECTIONS][2];
    for (size_t i = 0; i < COUNT; ++i) {
        aur_rotation rotation;
        aur_rotation_from_quaternion(whole + 4 * i, &rotation);
        const double *const row = rotation.m;           /* what comes to +x */
        const double d[3] = {row[2], -row[1], -row[0]}; /* the set's axes */
        size_t nearest = 0;
        double most = -1.0;
        for (size_t k = 0; k < DIRECTIONS; ++k) {
            const double *const x = xyz + 3 * k, product = x[0] * d[0] + x[1] * d[1] + x[2] * d[2];
            if (product > most) {
                most = product;
                nearest = k;
            }
        }
        assert_true(most > 1.0 - 1e-14);
        /* Where its neighbour in the fibre is: a multiple of the last step, 1/24 of a turn, from the first.
         */
        double *const first = turned[nearest];
        /* A vector across it, which the turns move in the plane of y and z. */
        const double across[3] = {-row[1], row[0], 0.0}, length = hypot(row[0], row[1]);
        double second[2];
        for (size_t k = 0; k < 2; ++k)
            second[k] = (rotation.m[3 + 3 * k] * across[0] + rotation.m[4 + 3 * k] * across[1]) / length;
        if (found[nearest]++ == 0)
            memcpy(first, second, sizeof second);
        const double turn =
            atan2(first[0] * second[1] - first[1] * second[0], first[0] * second[0] + first[1] * second[1]) /
            (2.0 * AUR_PI) * 4.0 * TURNS;
        assert_true(fabs(turn - nearbyint(turn)) < 1e-9);
    }
    for (size_t k = 0; k < DIRECTIONS; ++k)
        assert_int_equal(found[k], 4 * TURNS);
    free(whole);
    free(part);
}

/* More even than the grid of super-Fibonacci rotations: no smallest angle below .7 of the spiral's, no energy
 * more than a sixth above it. */
static void lifted_grids_are_even(void **state) {
    (void)state;
    for (size_t count = 120; count <= 120 * 16; count *= 2) {
        double *const grid = plain("esfg-rotations:levels=2", count), *const spiral =
                                                                          plain("super-fibonacci", count);
        assert_true(energy(count, grid) < 1.16 * energy(count, spiral));
        assert_true(smallest(count, grid) > 0.7 * smallest(count, spiral));
        free(grid);
        free(spiral);
    }
}

/* The mean of q q^T is a quarter of the identity: within the error of 4096 points of a net, far below that of
 * random ones, 4096^-1/2 / 4 = .004. */
static void lifted_points_are_uniform(void **state) {
    (void)state;
    enum { COUNT = 4096 };
    static const char *const sets[] = {"sobol", "halton", "r2", "super-fibonacci"};
    for (size_t s = 0; s < 4; ++s) {
        double *const wxyz = plain(sets[s], COUNT);
        for (size_t a = 0; a < 4; ++a)
            for (size_t b = 0; b <= a; ++b) {
                double mean = 0.0;
                for (size_t i = 0; i < COUNT; ++i)
                    mean += wxyz[4 * i + a] * wxyz[4 * i + b] / COUNT;
                assert_near(mean, a == b ? 0.25 : 0.0, 2e-3);
            }
        free(wxyz);
    }
}

static void scrambling_turns_all_alike_or_moves_the_cube(void **state) {
    (void)state;
    aur_rotations_options options = {.size = sizeof options};
    aur_rotations_options_init(64, &options, NULL);
    double *const before = plain("sobol", 64);
    options.scramble = AUR_SCRAMBLE_ROTATE3D;
    options.seed = 4;
    double *const turned = generate("sobol", options);
    for (size_t i = 1; i < 64; ++i)
        assert_near(aur_dot4(turned, turned + 4 * i), aur_dot4(before, before + 4 * i), 1e-15);
    assert_true(fabs(aur_dot4(turned, before)) < 0.999);
    options.scramble = AUR_SCRAMBLE_OWEN;
    double *const scrambled = generate("sobol", options);
    assert_true(fabs(aur_dot4(scrambled, scrambled + 4) - aur_dot4(before, before + 4)) > 1e-6);
    free(before);
    free(turned);
    free(scrambled);
}

static void matrices_are_quaternions(void **state) {
    (void)state;
    for (size_t i = 0; i < 200; ++i) {
        double q[4], back[4], vector[3] = {0.3, -0.5, 0.8}, product[4], turned[4];
        aur_quaternion_uniform(i, q);
        if (i < 4) /* half turns, where w or all others are 0 */
            for (size_t d = 0; d < 4; ++d)
                q[d] = d == i ? 1.0 : 0.0;
        aur_rotation rotation;
        aur_rotation_from_quaternion(q, &rotation);
        aur_rotation_to_quaternion(&rotation, back);
        assert_near(fabs(aur_dot4(q, back)), 1.0, 1e-15);
        /* q v q^-1 */
        const double pure[4] = {0.0, vector[0], vector[1], vector[2]},
                     inverse[4] = {q[0], -q[1], -q[2], -q[3]};
        aur_quaternion_multiply(q, pure, product);
        aur_quaternion_multiply(product, inverse, turned);
        aur_rotation_apply(&rotation, 1, vector);
        for (size_t d = 0; d < 3; ++d)
            assert_near(vector[d], turned[1 + d], 1e-15);
    }
}

static void symmetries_are_groups_with_zones(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    static const size_t orders[] = {1, 2, 4, 3, 6, 4, 8, 6, 12, 12, 24};
    for (size_t s = 0; s < sizeof orders / sizeof orders[0]; ++s) {
        double group[4 * AUR_SYMMETRY_ORDER_MAX];
        const size_t order = aur_symmetry_group((aur_symmetry)s, group);
        assert_int_equal(order, orders[s]);
        for (size_t a = 0; a < order; ++a)
            for (size_t b = 0; b < order; ++b) {
                double product[4], nearest = 0.0;
                aur_quaternion_multiply(group + 4 * a, group + 4 * b, product);
                for (size_t k = 0; k < order; ++k)
                    nearest = fmax(nearest, fabs(aur_dot4(product, group + 4 * k)));
                assert_near(nearest, 1.0, 1e-15);
            }
        double *const given = plain("super-fibonacci", COUNT), *const reduced =
                                                                   plain("super-fibonacci", COUNT);
        assert_int_equal(aur_symmetry_reduce((aur_symmetry)s, COUNT, reduced, NULL), AUR_OK);
        for (size_t i = 0; i < COUNT; ++i) {
            /* q^-1 q' is in the group, and no other q g turns by less. */
            const double *const q = given + 4 * i;
            double step[4], nearest = 0.0;
            aur_quaternion_multiply((const double[]){q[0], -q[1], -q[2], -q[3]}, reduced + 4 * i, step);
            for (size_t k = 0; k < order; ++k)
                nearest = fmax(nearest, fabs(aur_dot4(step, group + 4 * k)));
            assert_near(nearest, 1.0, 1e-14);
        }
        assert_int_equal(aur_symmetry_select((aur_symmetry)s, COUNT, reduced), COUNT);
        /* So even a set has its share in the zone to a hundredth. */
        const size_t inside = aur_symmetry_select((aur_symmetry)s, COUNT, given);
        assert_near((double)inside * (double)order / COUNT, 1.0, 0.05);
        free(given);
        free(reduced);
    }
    aur_symmetry symmetry;
    aur_error error = {0};
    assert_int_equal(aur_symmetry_from_name("432", &symmetry, NULL), AUR_OK);
    assert_int_equal(symmetry, AUR_SYMMETRY_432);
    assert_string_equal(aur_symmetry_name(AUR_SYMMETRY_622), "622");
    assert_null(aur_symmetry_name((aur_symmetry)11));
    assert_int_equal(aur_symmetry_from_name("532", &symmetry, &error), AUR_ERROR_NAME);
    double none[4] = {1.0};
    assert_int_equal(aur_symmetry_group((aur_symmetry)11, none), 0);
    assert_int_equal(aur_symmetry_select((aur_symmetry)11, 1, none), 0);
    assert_int_equal(aur_symmetry_reduce((aur_symmetry)11, 1, none, &error), AUR_ERROR_ARGUMENT);
}

static void refused(const char *set, size_t count, aur_scramble scramble, aur_result expected,
                    const char *words) {
    aur_rotations_options options = {.size = sizeof options};
    aur_rotations_options_init(count, &options, NULL);
    options.scramble = scramble;
    aur_rotations *rotations;
    aur_error error = {0};
    assert_int_equal(aur_rotations_create(set, &options, &rotations, &error), expected);
    assert_null(rotations);
    if (strstr(error.message, words) == NULL)
        fail_msg("'%s' does not say '%s'", error.message, words);
}

static void what_has_no_meaning_is_refused(void **state) {
    (void)state;
    refused("super-fibonaci", 8, AUR_SCRAMBLE_NONE, AUR_ERROR_NAME, "did you mean 'super-fibonacci'");
    refused("super-fibonacci", 0, AUR_SCRAMBLE_NONE, AUR_ERROR_ARGUMENT, "not 0");
    refused("super-fibonacci", 8, AUR_SCRAMBLE_OWEN, AUR_ERROR_UNSUPPORTED, "rotate3d");
    refused("super-fibonacci:x=1", 8, AUR_SCRAMBLE_NONE, AUR_ERROR_NAME, "no 'x'");
    refused("super-fibonacci-grid:levels=0", 101, AUR_SCRAMBLE_NONE, AUR_ERROR_ARGUMENT, "base*8^levels");
    refused("esfg-rotations:levels=0", 121, AUR_SCRAMBLE_NONE, AUR_ERROR_ARGUMENT, "base*turns*8^levels");
    refused("spherical-fibonacci", 8, AUR_SCRAMBLE_NONE, AUR_ERROR_UNSUPPORTED, "'rotations'");
    refused("fibonacci-lattice", 8, AUR_SCRAMBLE_NONE, AUR_ERROR_ARGUMENT, "not 3");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(super_fibonacci_is_the_published_formula),
        cmocka_unit_test(all_instruction_sets_and_parts_have_the_same_bits),
        cmocka_unit_test(the_grid_preserves_its_points_and_its_energy),
        cmocka_unit_test(lifted_grids_have_their_directions),
        cmocka_unit_test(lifted_grids_are_even),
        cmocka_unit_test(lifted_points_are_uniform),
        cmocka_unit_test(scrambling_turns_all_alike_or_moves_the_cube),
        cmocka_unit_test(matrices_are_quaternions),
        cmocka_unit_test(symmetries_are_groups_with_zones),
        cmocka_unit_test(what_has_no_meaning_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
