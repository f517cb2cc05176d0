#include "check.h"

#include <string.h>

#include "points/base/simd.h"
#include "points/quality/split/split.h"
#include "sphere_sets.h"

/* Distances are summed fast enough over all pairs of fewer points. */
enum { COUNT = AUR_SPLIT_COUNT, MANY = 16384 };

static double measured(const char *metric, const test_points *points, double accuracy, size_t threads,
                       double *bound) {
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    options.accuracy = accuracy;
    options.threads = threads;
    const aur_points_view view = seen(points);
    double value = NAN;
    aur_error error = {0};
    if (aur_measure_bounded(metric, &view, &options, &value, bound, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return value;
}

/* Half of the points in a cap of a twentieth of the sphere. */
static test_points clustered(size_t count, uint64_t seed) {
    test_points points = random_directions(count, seed);
    for (size_t j = 0; j < count / 2; ++j)
        set_direction(&points, j, 1.0 - 0.1 * aur_unit_double(aur_hash3(seed, j, 2)),
                      2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, j, 3)));
    return points;
}

/* With a modified first point, so that the sum does not recognise the set. */
static test_points nearly_fibonacci(size_t count, aur_domain domain) {
    test_points points = spherical_fibonacci(count, domain);
    set_direction(&points, 0, 0.9999, 1.0);
    return points;
}

/* Within the bound of the sum over all pairs, and the bound within the target. */
static void agrees(const char *metric, const test_points *points, double accuracy) {
    double bound, none;
    const double exact = measured(metric, points, 0.0, 0, &none);
    const double fast = measured(metric, points, accuracy, 0, &bound);
    assert_true(none == 0.0);
    if (!(bound > 0.0 && bound <= accuracy * fabs(fast)))
        fail_msg("%s of %zu points: %.17g, bound %g", metric, points->count, fast, bound);
    assert_true(fabs(fast - exact) <= bound);
}

static void sums_are_within_their_bound(void **state) {
    (void)state;
    test_points points = random_directions(MANY, 1);
    agrees("energy", &points, 1e-6);
    points.weights = malloc(MANY * sizeof *points.weights);
    for (size_t i = 0; i < MANY; ++i)
        points.weights[i] = aur_unit_double(aur_hash2(7, i)) - 0.1;
    agrees("energy", &points, 1e-6);
    points.domain = AUR_DOMAIN_AXES;
    agrees("energy", &points, 1e-6);
    points.count = COUNT;
    agrees("riesz:1", &points, 1e-6);
    points.domain = AUR_DOMAIN_SPHERE;
    agrees("riesz:1", &points, 1e-6);
    free(points.weights);
    points.weights = NULL;
    static const char *const metrics[] = {"riesz:0", "riesz:1.5", "riesz:6"};
    for (size_t m = 0; m < sizeof metrics / sizeof metrics[0]; ++m)
        agrees(metrics[m], &points, m % 2 == 0 ? 1e-6 : 1e-3);
    release_points(&points);
    points = clustered(MANY, 2);
    agrees("energy", &points, 1e-6);
    points.count = COUNT;
    agrees("riesz:1", &points, 1e-7);
    release_points(&points);
    points = nearly_fibonacci(MANY, AUR_DOMAIN_SPHERE);
    agrees("energy", &points, 1e-6);
    release_points(&points);
    points = nearly_fibonacci(MANY, AUR_DOMAIN_HEMISPHERE);
    agrees("energy", &points, 1e-4);
    release_points(&points);
}

/* At the ends of three axes harmonics of even degrees are large and add up: the error is a hundredth of its
 * bound or more, so that a bound a hundred times smaller would not hold. */
static void bounds_are_not_loose(void **state) {
    (void)state;
    test_points points = sphere_points(COUNT);
    for (size_t j = 0; j < COUNT; ++j)
        for (size_t d = 0; d < 3; ++d)
            points.coordinates[3 * j + d] = j % 3 == d ? (j % 2 == 0 ? 1.0 : -1.0) : 0.0;
    double bound, none;
    const double exact = measured("riesz:-0.5", &points, 0.0, 0, &none);
    for (double accuracy = 1e-3; accuracy > 1e-8; accuracy *= 1e-2) {
        const double off = fabs(measured("riesz:-0.5", &points, accuracy, 0, &bound) - exact);
        print_message("accuracy %g: an error of %.3f of its bound\n", accuracy, off / bound);
        assert_true(bound > 0.0 && off <= bound && off >= 0.01 * bound);
    }
    release_points(&points);
}

/* If the target cannot be guaranteed, the sum is over all pairs. */
static void what_is_too_much_is_summed_exactly(void **state) {
    (void)state;
    test_points points = nearly_fibonacci(MANY, AUR_DOMAIN_SPHERE);
    double bound;
    const double exact = measured("energy", &points, 0.0, 0, &bound);
    assert_true(measured("energy", &points, 1e-13, 0, &bound) == exact && bound == 0.0);
    points.count = 500;
    const double few = measured("energy", &points, 0.0, 0, &bound);
    assert_true(measured("energy", &points, 1e-3, 0, &bound) == few && bound == 0.0);
    const aur_points_view view = seen(&points);
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    aur_error error;
    const double bad[] = {-1.0, 1.0, NAN};
    for (size_t i = 0; i < 3; ++i) {
        double value;
        options.accuracy = bad[i];
        assert_int_equal(aur_measure("energy", &view, &options, &value, &error), AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "accuracy"));
    }
    release_points(&points);
}

static void coincident_points_are_infinitely_repelled(void **state) {
    (void)state;
    test_points points = random_directions(MANY, 3);
    memcpy(points.coordinates + 3 * 3000, points.coordinates, 3 * sizeof(double));
    double bound;
    assert_true(isinf(measured("riesz:1", &points, 1e-6, 0, &bound)) && bound == 0.0);
    assert_true(isinf(measured("riesz:0", &points, 1e-6, 0, &bound)) && bound == 0.0);
    agrees("energy", &points, 1e-6);
    release_points(&points);
}

static void bits_depend_on_nothing_else(void **state) {
    (void)state;
    test_points points = clustered(MANY, 4);
    static const char *const metrics[] = {"energy", "riesz:0.5"};
    for (size_t m = 0; m < 2; ++m) {
        double bounds[2];
        const double one = measured(metrics[m], &points, 1e-6, 1, &bounds[0]);
        assert_true(measured(metrics[m], &points, 1e-6, 3, &bounds[1]) == one && bounds[0] == bounds[1]);
    }
    /* The kernels of the instruction sets that are here. */
    const aur_near_kernel *kernels[3] = {&aur_near_portable};
    size_t here = 1;
#if !defined(AUR_PORTABLE)
    if (aur_isa_available() >= AUR_ISA_AVX2)
        kernels[here++] = &aur_near_avx2;
    if (aur_isa_available() >= AUR_ISA_AVX512)
        kernels[here++] = &aur_near_avx512;
#endif
    const aur_points_view view = seen(&points);
    aur_arena arena = {0};
    aur_near_points near;
    assert_int_equal(aur_near_points_create(&view, 0.3, &arena, &near, NULL), AUR_OK);
    static const double exponents[] = {-1.0, -0.5, 0.0, 1.0, 2.0, 3.0};
    for (size_t e = 0; e < sizeof exponents / sizeof exponents[0]; ++e) {
        const aur_split_kernel kernel = aur_split_kernel_make(exponents[e], 0.3, 20.0);
        for (size_t k = 1; k < here; ++k)
            for (size_t i = 0; i < 100; ++i)
                assert_true(kernels[k]->row(&near, &kernel, i, i + 1, 3 * i + 2) ==
                            kernels[0]->row(&near, &kernel, i, i + 1, 3 * i + 2));
    }
    aur_arena_release(&arena);
    release_points(&points);
}

/* F = erf(a d) / d for S = 1, d erf(a d) + e^{-a^2 d^2} / (a sqrt pi) for S = -1, and (1 - e^{-a^2 d^2}) /
 * d^2 for S = 2; the sum of the near pairs is that over all pairs of what is left. */
static void the_smooth_part_is_the_error_function(void **state) {
    (void)state;
    for (double d = 0.01; d < 1.0; d *= 1.3) {
        const double a = 5.0, q = a * a * d * d;
        const aur_split_kernel one = {.exponent = 1.0, .scale = a}, minus = {.exponent = -1.0, .scale = a},
                               two = {.exponent = 2.0, .scale = a};
        assert_relative(aur_split_smooth(&one, d * d), erf(a * d) / d, 4e-15);
        assert_relative(aur_split_smooth(&minus, d * d), d * erf(a * d) + exp(-q) / (a * sqrt(AUR_PI)),
                        4e-15);
        assert_relative(aur_split_smooth(&two, d * d), -expm1(-q) / (d * d), 4e-15);
    }
    enum { FEW = 700 };
    test_points points = clustered(FEW, 5);
    const aur_points_view view = seen(&points);
    for (double reach = 0.05; reach < 3.0; reach *= 2.5) {
        aur_arena arena = {0};
        const aur_measure_request request = {.points = &view, .arena = &arena};
        aur_near_points near;
        double sum, direct = 0.0;
        const aur_split_kernel kernel = aur_split_kernel_make(-1.0, reach, 12.0);
        assert_int_equal(aur_near_points_create(&view, reach, &arena, &near, NULL), AUR_OK);
        assert_int_equal(aur_near_sum(&near, &kernel, &request, &sum, NULL), AUR_OK);
        for (size_t i = 0; i < FEW; ++i)
            for (size_t j = 0; j < i; ++j) {
                double square = 0.0;
                for (size_t c = 0; c < 3; ++c)
                    square += pow(points.coordinates[3 * i + c] - points.coordinates[3 * j + c], 2.0);
                if (square < reach * reach)
                    direct += sqrt(square) - aur_split_smooth(&kernel, square);
            }
        assert_relative(sum, direct, 1e-11);
        aur_arena_release(&arena);
    }
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_are_within_their_bound),
                                       cmocka_unit_test(bounds_are_not_loose),
                                       cmocka_unit_test(what_is_too_much_is_summed_exactly),
                                       cmocka_unit_test(coincident_points_are_infinitely_repelled),
                                       cmocka_unit_test(bits_depend_on_nothing_else),
                                       cmocka_unit_test(the_smooth_part_is_the_error_function)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
