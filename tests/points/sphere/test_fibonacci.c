#include "sphere_check.h"

#include <string.h>

#include "points/base/simd.h"
#include "points/sphere/phase.h"
#include "points/sphere/sets/fibonacci.h"

static const aur_directions_options sphere = {.size = sizeof sphere, .domain = AUR_DOMAIN_SPHERE};

static double *fibonacci(const char *set, uint64_t count, aur_domain domain) {
    return check_directions(
        set,
        (aur_directions_options){.size = sizeof(aur_directions_options), .count = count, .domain = domain});
}

/* Energy, smallest distance: the golden figures of Marques 2013's set. */
static void reproduces_golden_figures(void **state) {
    (void)state;
    static const struct {
        size_t count;
        double energy, distance;
    } golden[] = {{64, 4.01610e-2, 3.0895}, {1024, 4.98051e-3, 3.0919}};
    for (size_t g = 0; g < 2; ++g) {
        const size_t count = golden[g].count;
        double *const xyz = fibonacci("spherical-fibonacci", count, AUR_DOMAIN_SPHERE);
        assert_relative(check_energy(count, xyz), golden[g].energy, 2e-6);
        assert_near(check_smallest_distance(count, xyz) * sqrt((double)count), golden[g].distance, 6e-5);
        free(xyz);
    }
}

/* Offset 0 adds 1/N^2 to the square of the energy, and Roberts' epsilon widens the smallest distance. */
static void offsets_trade(void **state) {
    (void)state;
    enum { COUNT = 1024 };
    double *const half = fibonacci("spherical-fibonacci", COUNT, AUR_DOMAIN_SPHERE);
    double *const zero = fibonacci("spherical-fibonacci:offset=0", COUNT, AUR_DOMAIN_SPHERE);
    double *const packed = fibonacci("spherical-fibonacci:epsilon=3.33", COUNT, AUR_DOMAIN_SPHERE);
    const double best = check_energy(COUNT, half);
    const double other = check_energy(COUNT, zero);
    assert_near((other * other - best * best) * COUNT * COUNT, 1.0, 0.01);
    assert_near(check_smallest_distance(COUNT, packed) * sqrt(COUNT), 3.305, 0.005);
    assert_true(check_energy(COUNT, packed) > 1.1 * best);
    free(half);
    free(zero);
    free(packed);
}

__extension__ typedef unsigned __int128 wide;

/* j/Phi by 128-bit arithmetic: frac(j (sqrt 5 - 1)/2) with 1/Phi to 128 digits. */
static double exact_turns(uint64_t j) {
    const uint64_t high = UINT64_C(0x9e3779b97f4a7c15);
    const uint64_t low = UINT64_C(0xf39cc0605cedc834);
    const wide product = (((wide)(j * high)) << 64) + (wide)j * (wide)low;
    return (double)(product >> 64) * 0x1p-64;
}

static void phases_stay_golden_to_a_thousand_million(void **state) {
    (void)state;
    static const uint64_t starts[] = {0, 1, 2, 75024, 999999, 99999999, 123456789, 1000000000 - 64};
    const uint64_t count = 1000000000;
    aur_directions *directions;
    aur_directions_options options = sphere;
    options.count = count;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, NULL), AUR_OK);
    for (size_t p = 0; p < sizeof starts / sizeof starts[0]; ++p) {
        double xyz[3 * 64];
        assert_int_equal(aur_directions_points(directions, starts[p], 64, 3 * 64, xyz, NULL, NULL), AUR_OK);
        for (size_t i = 0; i < 64; ++i) {
            const uint64_t j = starts[p] + i;
            const double angle = 2.0 * AUR_PI * exact_turns(j);
            const double z = 1.0 - (2.0 * (double)j + 1.0) / (double)count;
            const double radius = hypot(xyz[3 * i], xyz[3 * i + 1]);
            assert_near(xyz[3 * i + 2], z, 1e-15);
            assert_near(radius * radius + z * z, 1.0, 1e-15);
            /* the angle between the two, at most 3e-12 turn by the 64 digits at 1e9 */
            const double cross = xyz[3 * i + 1] * cos(angle) - xyz[3 * i] * sin(angle);
            assert_near(cross / radius, 0.0, 2e-11);
        }
    }
    aur_directions_destroy(directions);
}

static long double exact_angle(uint64_t phase) {
    return 2.0L * acosl(-1.0L) * ((long double)(int64_t)phase * 0x1p-64L);
}

/* The nearest double is at most half a unit in the last place away; long double adds its error. */
static void assert_nearest(double rounded, long double exact) {
    int exponent;
    frexp(rounded, &exponent);
    assert_true(fabsl((long double)rounded - exact) <= ldexpl(0.5005L, exponent - 53));
}

static void turns_of_a_block_are_rounded_once(void **state) {
    (void)state;
    for (size_t k = 0; k < AUR_FIBONACCI_BLOCK + AUR_FIBONACCI_WRAPPED; ++k) {
        const long double angle = exact_angle(k % AUR_FIBONACCI_BLOCK * AUR_GOLDEN_PHASE);
        assert_nearest(aur_golden_cosines[k], cosl(angle));
        assert_nearest(aur_golden_sines[k], sinl(angle));
    }
}

/* Each coordinate across the axis within 6e-16: 2e-16 of the block's first azimuth, 0.8e-16 of the table,
 * half a unit in the last place (0.55e-16) of two products, their sum and the product with the radius, and
 * the radius, rounded where it is largest, three times as much. */
static void points_are_within_their_error(void **state) {
    (void)state;
    enum { COUNT = 1 << 16 };
    double *const xyz = fibonacci("spherical-fibonacci", COUNT, AUR_DOMAIN_SPHERE);
    for (uint64_t j = 0; j < COUNT; ++j) {
        const long double depth = ((long double)j + 0.5L) * (2.0L / COUNT);
        const long double radius = sqrtl(depth * (2.0L - depth));
        const long double angle = exact_angle(j * AUR_GOLDEN_PHASE);
        assert_true(fabsl(xyz[3 * j] - radius * cosl(angle)) <= 6e-16L);
        assert_true(fabsl(xyz[3 * j + 1] - radius * sinl(angle)) <= 6e-16L);
        assert_true(xyz[3 * j + 2] == (double)(1.0L - depth)); /* both are exact */
    }
    free(xyz);
}

static void hemisphere_is_the_first_half(void **state) {
    (void)state;
    static const char *const sets[] = {"spherical-fibonacci", "spherical-fibonacci:offset=0.2",
                                       "spherical-fibonacci:epsilon=0.4"};
    for (size_t s = 0; s < 3; ++s) {
        for (size_t count = 1; count < 300; count += 13) {
            double *const half = fibonacci(sets[s], count, AUR_DOMAIN_HEMISPHERE);
            double *const whole = fibonacci(sets[s], 2 * count, AUR_DOMAIN_SPHERE);
            assert_memory_equal(half, whole, 3 * count * sizeof *half);
            free(half);
            free(whole);
        }
    }
}

/* A cap filled with N points: its boundary, the share of each smaller cap, and the density of the whole. */
static void caps_are_filled_evenly(void **state) {
    (void)state;
    enum { COUNT = 500 };
    static const double angles[] = {1e-3, 20.0, 90.0, 140.0, 180.0};
    for (size_t a = 0; a < 5; ++a) {
        double *const xyz = check_directions("spherical-fibonacci",
                                             (aur_directions_options){.size = sizeof(aur_directions_options),
                                                                      .count = COUNT,
                                                                      .domain = AUR_DOMAIN_SPHERE,
                                                                      .cap_degrees = angles[a]});
        const double half = sin(angles[a] * AUR_PI / 360.0);
        const double height = 2.0 * half * half;
        double deepest = 0.0;
        for (size_t i = 0; i < COUNT; ++i) {
            const double across = xyz[3 * i] * xyz[3 * i] + xyz[3 * i + 1] * xyz[3 * i + 1];
            assert_relative(across,
                            height * ((double)i + 0.5) / COUNT * (2.0 - height * ((double)i + 0.5) / COUNT),
                            1e-12);
            deepest = fmax(deepest, 1.0 - xyz[3 * i + 2]);
        }
        assert_near(deepest, height * (1.0 - 0.5 / COUNT), 1e-12);
        const double spacing = check_smallest_distance(COUNT, xyz) / sqrt(2.0 * height);
        assert_true(spacing * sqrt(COUNT) > 1.4 && spacing * sqrt(COUNT) < 1.7);
        free(xyz);
    }
}

static void parts_do_not_depend_on_the_calls(void **state) {
    (void)state;
    enum { COUNT = 1000 };
    double *const whole = fibonacci("spherical-fibonacci", COUNT, AUR_DOMAIN_SPHERE);
    aur_directions *directions;
    aur_directions_options options = sphere;
    options.count = COUNT;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, NULL), AUR_OK);
    for (uint64_t attempt = 0; attempt < 200; ++attempt) {
        const uint64_t first = aur_hash2(1, attempt) % COUNT;
        const size_t count = (size_t)(aur_hash2(2, attempt) % (COUNT - first + 1));
        double part[3 * COUNT];
        assert_int_equal(aur_directions_points(directions, first, count, 3 * count, part, NULL, NULL),
                         AUR_OK);
        assert_memory_equal(part, whole + 3 * first, 3 * count * sizeof *part);
    }
    aur_directions_destroy(directions);
    free(whole);
}

/* No tolerance between instruction sets: every bit, for any start, length and alignment, streamed or not. */
static void kernels_agree_bit_for_bit(void **state) {
    (void)state;
#if defined(AUR_PORTABLE)
    skip();
#else
    static aur_fibonacci_kernel *const kernels[] = {aur_fibonacci_points_avx2, aur_fibonacci_points_avx512};
    static const aur_isa needs[] = {AUR_ISA_AVX2, AUR_ISA_AVX512};
    enum { MOST = 1100 };
    double *const expected = malloc((3 * MOST + 8) * sizeof *expected);
    double *const actual = malloc((3 * MOST + 8) * sizeof *actual);
    assert_true(expected != NULL && actual != NULL);
    for (uint64_t attempt = 0; attempt < 200; ++attempt) {
        const uint64_t random = aur_hash2(91, attempt);
        const size_t count = random % (attempt % 2 == 0 ? 50 : MOST);
        const bool stream = attempt % 3 == 0;
        const uint64_t first = random >> (16 + attempt % 40);
        const aur_fibonacci set = {
            .step = 1.9 / (double)(first + count + 1), .offset = 0.25, .phase = random};
        aur_fibonacci_points_portable(&set, first, count, false, expected);
        for (size_t k = 0; k < 2; ++k) {
            if (aur_isa_available() < needs[k])
                continue;
            double *const to = actual + attempt % 8;
            to[3 * count] = 7.0;
            kernels[k](&set, first, count, stream, to);
            assert_memory_equal(to, expected, 3 * count * sizeof *to);
            assert_true(to[3 * count] == 7.0);
        }
    }
    free(expected);
    free(actual);
#endif
}

static void refuses_what_is_wrong(void **state) {
    (void)state;
    static const char *const sets[] = {"spherical-fibonacci:offset=nan",
                                       "spherical-fibonacci:offset=1.5",
                                       "spherical-fibonacci:ofset=0.5",
                                       "spherical-fibonacci:epsilon=-1",
                                       "spherical-fibonacci:offset",
                                       "spherical-fibonacci:offset=0.5,epsilon=1",
                                       "spherical-fibonaci"};
    aur_directions *directions;
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; ++i) {
        aur_error error = {0};
        aur_directions_options options = sphere;
        options.count = 10;
        assert_int_not_equal(aur_directions_create(sets[i], &options, &directions, &error), AUR_OK);
        assert_null(directions);
        assert_true(strlen(error.message) > 0);
    }
    aur_error error = {0};
    aur_directions_options options = sphere;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, &error),
                     AUR_ERROR_ARGUMENT);
    options.count = UINT64_MAX;
    assert_int_equal(aur_directions_create("spherical-fibonacci", &options, &directions, &error),
                     AUR_ERROR_ARGUMENT);
    options.count = 1;
    assert_int_equal(aur_directions_create("spherical-fibonacci:epsilon=0", &options, &directions, &error),
                     AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reproduces_golden_figures),
        cmocka_unit_test(offsets_trade),
        cmocka_unit_test(phases_stay_golden_to_a_thousand_million),
        cmocka_unit_test(turns_of_a_block_are_rounded_once),
        cmocka_unit_test(points_are_within_their_error),
        cmocka_unit_test(hemisphere_is_the_first_half),
        cmocka_unit_test(caps_are_filled_evenly),
        cmocka_unit_test(kernels_agree_bit_for_bit),
        cmocka_unit_test(parts_do_not_depend_on_the_calls),
        cmocka_unit_test(refuses_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
