#include "check.h"

#include <string.h>

#include "points/quality/pairs/pair_sum.h"
#include "points/quality/sphere/fibonacci_sum.h"
#include "sphere_sets.h"

#include "points/base/simd.h"

static double measured(const char *metric, const test_points *points) {
    double value = NAN;
    aur_error error = {0};
    assert_int_equal(aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error),
                     AUR_OK);
    return value;
}

/* E_64 = 4.01610e-2, E_1024 = 4.98051e-3, C(64) = 0.8258, C(1024) = 0.8128. */
static void spherical_fibonacci_has_the_golden_energy(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(64, AUR_DOMAIN_SPHERE);
    const double e64 = measured("energy", &points);
    assert_near(e64, 4.01610e-2, 0.5e-7);
    assert_near(e64 * e64 * 512.0, 0.8258, 0.5e-4);
    assert_near(measured("scd", &points), 2.83981e-2, 0.5e-7);
    assert_near(measured("l2-cap", &points), e64 / 2.0, 1e-16);
    assert_near(measured("l2-cap-mean", &points), e64 / sqrt(8.0), 1e-16);
    assert_near(measured("min-distance", &points) * 8.0, 3.0895, 0.5e-4);
    release_points(&points);
    points = spherical_fibonacci(1024, AUR_DOMAIN_SPHERE);
    const double e1024 = measured("energy", &points);
    assert_near(e1024, 4.98051e-3, 0.5e-8);
    assert_near(e1024 * e1024 * 32768.0, 0.8128, 0.5e-4);
    assert_near(measured("min-distance", &points) * 32.0, 3.0919, 0.5e-4);
    release_points(&points);
    points = spherical_fibonacci(1024, AUR_DOMAIN_HEMISPHERE);
    const double hemisphere = measured("energy", &points);
    assert_near(hemisphere * hemisphere * 32768.0, 0.6036, 0.5e-4);
    release_points(&points);
}

static void small_sets_have_their_closed_forms(void **state) {
    (void)state;
    test_points points = octahedron();
    /* 6 * (4 sqrt 2 + 2) / 36 is the mean distance. */
    assert_near(measured("energy", &points), sqrt(4.0 / 3.0 - (4.0 * sqrt(2.0) + 2.0) / 6.0), 1e-15);
    assert_near(measured("riesz:1", &points), 6.0 * (4.0 / sqrt(2.0) + 0.5), 1e-13);
    assert_near(measured("riesz:0", &points), -6.0 * (2.0 * log(2.0) + log(2.0)), 1e-13);
    assert_near(measured("riesz:-1", &points), 6.0 * (4.0 * sqrt(2.0) + 2.0), 1e-13);
    assert_near(measured("riesz:2", &points), 6.0 * (4.0 / 2.0 + 0.25), 1e-13);
    assert_near(measured("riesz:0.5", &points), 6.0 * (4.0 * pow(2.0, -0.25) + pow(2.0, -0.5)), 1e-13);
    assert_near(measured("min-distance", &points), sqrt(2.0), 1e-15);
    points.count = 1;
    assert_near(measured("energy", &points), sqrt(4.0 / 3.0), 1e-15);
    assert_near(measured("riesz:1", &points), 0.0, 0.0);
    points.count = 2; /* an antipodal pair */
    assert_near(measured("energy", &points), sqrt(1.0 / 3.0), 1e-15);
    points.domain = AUR_DOMAIN_HEMISPHERE;
    points.count = 1;
    points.coordinates[0] = 0.0;
    points.coordinates[2] = 1.0;
    assert_near(measured("energy", &points), sqrt(2.0 * (4.0 / (3.0 * sqrt(2.0))) - 32.0 / (9.0 * AUR_PI)),
                1e-15);
    release_points(&points);
}

/* The expectation of N^2 E^2 over independent points is 4/3 N; its mean over 400 sets must be within five
 * standard errors, so a right program fails about once in two million runs, and the seed is fixed. */
static void random_sets_have_the_exact_expectation(void **state) {
    (void)state;
    enum { SETS = 400, COUNT = 32 };
    double sum = 0.0, squares = 0.0;
    for (uint64_t seed = 0; seed < SETS; ++seed) {
        test_points points = random_directions(COUNT, seed);
        const double energy = measured("energy", &points);
        const double scaled = energy * energy * COUNT;
        sum += scaled;
        squares += scaled * scaled;
        release_points(&points);
    }
    const double mean = sum / SETS;
    const double deviation = sqrt((squares / SETS - mean * mean) / SETS);
    assert_near(mean, 4.0 / 3.0, 5.0 * deviation);
}

/* Weights 2, 1 on two points equal three points, two of which coincide. */
static void weights_are_masses(void **state) {
    (void)state;
    static const char *const metrics[] = {"energy", "riesz:-1"};
    for (int hemisphere = 0; hemisphere < 2; ++hemisphere) {
        test_points thrice = spherical_fibonacci(3, hemisphere ? AUR_DOMAIN_HEMISPHERE : AUR_DOMAIN_SPHERE);
        memcpy(thrice.coordinates + 6, thrice.coordinates, 3 * sizeof(double));
        test_points weighted = thrice;
        double weights[3] = {2.0, 1.0, 0.0};
        weighted.count = 2;
        weighted.weights = weights;
        assert_near(measured("energy", &weighted), measured("energy", &thrice), 1e-15);
        /* Sums of N w_i N w_j with N = 2 are (2/3)^2 of those of three points. */
        assert_near(measured(metrics[1], &weighted), measured(metrics[1], &thrice) * 4.0 / 9.0, 1e-14);
        for (int i = 0; i < 3; ++i)
            weights[i] *= 1e3;
        assert_near(measured("energy", &weighted), measured("energy", &thrice), 1e-15);
        release_points(&thrice);
    }
}

/* The potential against Simpson's rule in both angles, and its known values. */
static void the_potential_of_the_hemisphere_is_exact(void **state) {
    (void)state;
    assert_near(aur_hemisphere_potential(1.0), 4.0 / (3.0 * sqrt(2.0)), 2e-16);
    assert_near(aur_hemisphere_potential(0.0), 4.0 / 3.0, 2e-16);
    assert_near(aur_hemisphere_potential(-1.0), 8.0 / 3.0 - 4.0 / (3.0 * sqrt(2.0)), 4e-16);
    assert_near(aur_hemisphere_mean_distance().high, 32.0 / (9.0 * AUR_PI), 3e-16);
    /* 4/3 - sum over odd l of k_l mu_l P_l(z), with k_l and mu_l of the hemisphere's indicator. */
    static const double heights[] = {1e-7, 1e-3, 0.1, 0.3, 0.5, 0.9, 0.999, -0.4};
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; ++i) {
        const double z = heights[i];
        double sum = 4.0 / 3.0, before = 1.0, here = z, mu = 0.5;
        for (int l = 1; l < 40000; ++l) {
            if (l % 2 == 1) {
                sum -= 4.0 / ((2.0 * l - 1.0) * (2.0 * l + 3.0)) * mu * here;
                mu *= -(double)l / (l + 3.0);
            }
            const double next = ((2.0 * l + 1.0) * z * here - l * before) / (l + 1.0);
            before = here;
            here = next;
        }
        assert_near(aur_hemisphere_potential(z), sum, 2e-13);
    }
    /* Its mean over the hemisphere is the mean distance: the midpoint rule in z. */
    double mean = 0.0;
    enum { CELLS = 4000 };
    for (int i = 0; i < CELLS; ++i)
        mean += aur_hemisphere_potential((i + 0.5) / CELLS) / CELLS;
    assert_near(mean, aur_hemisphere_mean_distance().high, 1e-7);
}

/* The sum in long double, pair by pair. */
static long double plain_sum(const test_points *points) {
    long double sum = 0.0L;
    for (size_t i = 0; i < points->count; ++i)
        for (size_t j = 0; j < i; ++j) {
            const double *const p = points->coordinates + 3 * i;
            const double *const q = points->coordinates + 3 * j;
            long double square = 0.0L;
            for (int d = 0; d < 3; ++d) {
                const long double difference = (long double)p[d] - (long double)q[d];
                square += difference * difference;
            }
            const long double weight = points->weights != NULL
                                           ? (long double)points->weights[i] * (long double)points->weights[j]
                                           : 1.0L;
            sum += weight * sqrtl(square);
        }
    return sum;
}

static void pair_sums_agree_with_long_double(void **state) {
    (void)state;
    static const size_t counts[] = {1, 2, 3, 7, 8, 9, 100, 1023, 1024, 1025, 2053, 3000};
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c) {
        test_points points = random_directions(counts[c], 7 + c);
        const double expected = (double)plain_sum(&points);
        aur_axes axes;
        assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
        const aur_measure_options accurate = {.size = sizeof accurate};
        const aur_measure_options fast = {.size = sizeof fast, .fast = true};
        aur_twofold sum;
        assert_int_equal(aur_distance_sum(&axes, &accurate, &sum, NULL), AUR_OK);
        assert_relative(sum.high, expected, 2.3e-16);
        assert_int_equal(aur_distance_sum(&axes, &fast, &sum, NULL), AUR_OK);
        assert_relative(sum.high, expected, 2e-14);
        aur_axes_release(&axes);
        points.weights = malloc(counts[c] * sizeof(double));
        for (size_t i = 0; i < counts[c]; ++i)
            points.weights[i] = aur_unit_double(aur_hash2(c, i));
        assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
        assert_int_equal(aur_distance_sum(&axes, &fast, &sum, NULL), AUR_OK);
        assert_relative(sum.high, (double)plain_sum(&points), 2e-14);
        aur_axes_release(&axes);
        release_points(&points);
    }
}

/* Nearly coincident and coincident points: the reciprocal root must survive them. */
static void fast_sums_survive_coincident_points(void **state) {
    (void)state;
    test_points points = random_directions(2048, 3);
    for (size_t i = 1024; i < 2048; ++i)
        memcpy(points.coordinates + 3 * i, points.coordinates + 3 * (i % 1024), 3 * sizeof(double));
    points.coordinates[3 * 1500] += 1e-12;
    aur_axes axes;
    assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
    const aur_measure_options fast = {.size = sizeof fast, .fast = true};
    aur_twofold sum;
    assert_int_equal(aur_distance_sum(&axes, &fast, &sum, NULL), AUR_OK);
    assert_relative(sum.high, (double)plain_sum(&points), 2e-14);
    aur_axes_release(&axes);
    release_points(&points);
}

/* The kernels of the instruction sets that are here. */
static size_t kernels_here(const aur_distance_kernels *kernels[3]) {
    size_t count = 0;
    kernels[count++] = &aur_distance_portable;
#if !defined(AUR_PORTABLE)
    if (aur_isa_available() >= AUR_ISA_AVX2)
        kernels[count++] = &aur_distance_avx2;
    if (aur_isa_available() >= AUR_ISA_AVX512)
        kernels[count++] = &aur_distance_avx512;
#endif
    return count;
}

/* Four rows and one column have four equal distances, of lengths of all mantissas and many exponents: each
 * root is within 2e-14, down to 1e-19, where estimates in single precision end. */
static void estimated_roots_are_within_their_error(void **state) {
    (void)state;
    enum { COLUMNS = 8, ROW = 8, COUNT = 12 };
    const aur_distance_kernels *kernels[3];
    const size_t here = kernels_here(kernels);
    double coordinates[3 * COUNT] = {0};
    const aur_points_view points = aur_points_view_of(AUR_DOMAIN_SPHERE, COUNT, 3, coordinates);
    aur_axes axes;
    assert_int_equal(aur_axes_create(&points, &axes, NULL), AUR_OK);
    for (uint64_t attempt = 0; attempt < 20000; ++attempt) {
        const double length = ldexp(1.0 + aur_unit_double(aur_hash2(5, attempt)), -(int)(attempt % 60));
        for (size_t row = ROW; row < COUNT; ++row)
            axes.x[row] = length;
        for (size_t k = 0; k < here; ++k) {
            const aur_pair_tile column = {ROW, COUNT, attempt % COLUMNS, attempt % COLUMNS + 1};
            assert_relative(kernels[k]->fast(&axes, column, 0.0).high, 4.0 * length, 4.5e-16);
        }
    }
    aur_axes_release(&axes);
}

/* Tiles off the diagonal of all shapes, coincident points among them. */
static void fast_tiles_agree_with_exact_ones(void **state) {
    (void)state;
    const aur_distance_kernels *kernels[3];
    const size_t here = kernels_here(kernels);
    test_points points = random_directions(600, 23);
    memcpy(points.coordinates, points.coordinates + 3 * 300, 3 * 20 * sizeof(double));
    aur_axes axes;
    assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
    for (uint64_t attempt = 0; attempt < 200; ++attempt) {
        const aur_pair_tile tile = {300, 301 + aur_hash2(1, attempt) % 300, 0,
                                    1 + aur_hash2(2, attempt) % 300};
        const double exact = aur_distance_portable.exact(&axes, tile, 0.0).high;
        for (size_t k = 0; k < here; ++k)
            assert_near(kernels[k]->fast(&axes, tile, 0.0).high, exact, 2e-14 * exact);
    }
    aur_axes_release(&axes);
    release_points(&points);
}

static void neither_threads_nor_registers_change_a_bit(void **state) {
    (void)state;
    test_points points = random_directions(5000, 11);
    for (int fast = 0; fast < 2; ++fast) {
        double values[3];
        for (size_t threads = 1; threads <= 3; ++threads) {
            const aur_measure_options options = {
                .size = sizeof options, .threads = threads, .fast = fast != 0};
            assert_int_equal(aur_measure("energy", (const aur_points_view[]){seen(&points)}, &options,
                                         &values[threads - 1], NULL),
                             AUR_OK);
        }
        assert_memory_equal(&values[0], &values[1], sizeof values[0]);
        assert_memory_equal(&values[0], &values[2], sizeof values[0]);
    }
    const aur_distance_kernels *kernels[3];
    const size_t here = kernels_here(kernels);
    aur_axes axes;
    assert_int_equal(aur_axes_create((const aur_points_view[]){seen(&points)}, &axes, NULL), AUR_OK);
    const aur_pair_tile tile = {4096, 5000, 1024, 2048};
    const aur_twofold portable = aur_distance_portable.exact(&axes, tile, 0.0);
    for (size_t k = 1; k < here; ++k) {
        const aur_twofold wide = kernels[k]->exact(&axes, tile, 0.0);
        assert_memory_equal(&portable, &wide, sizeof wide);
    }
    aur_axes_release(&axes);
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spherical_fibonacci_has_the_golden_energy),
        cmocka_unit_test(small_sets_have_their_closed_forms),
        cmocka_unit_test(random_sets_have_the_exact_expectation),
        cmocka_unit_test(weights_are_masses),
        cmocka_unit_test(the_potential_of_the_hemisphere_is_exact),
        cmocka_unit_test(pair_sums_agree_with_long_double),
        cmocka_unit_test(fast_sums_survive_coincident_points),
        cmocka_unit_test(estimated_roots_are_within_their_error),
        cmocka_unit_test(fast_tiles_agree_with_exact_ones),
        cmocka_unit_test(neither_threads_nor_registers_change_a_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
