/* Both solvers of exact weights, and their transforms: against each other and against sums from the
 * definition. */
#include <aureole/exact.h>
#include <stdlib.h>
#include <string.h>

#include "exact_points.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/quadrature/exact/fast.h"
#include "points/quadrature/exact/system.h"

/* The two ways of solving find the same weights, which are unique. */
static void two_ways(void **state) {
    (void)state;
    enum { N = 700, DEGREE = 20 };
    double *const xyz = points_of("sobol", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double near[N], direct[N], iterated[N], storage[4 * N];
    for (size_t i = 0; i < N; ++i)
        near[i] = (1.0 + 0.5 * sin((double)i)) / N;
    const aur_exact_system system = {.points = aur_polar_points_make(N, xyz, storage),
                                     .near = near,
                                     .distinct_points = N,
                                     .lowest = -1.0,
                                     .tolerance = 1e-15};
    aur_exact_found found = {0};
    aur_error error;
    assert_int_equal(aur_exact_direct(&system, DEGREE, false, direct, &found, &error), AUR_OK);
    assert_true(found.exact);
    assert_int_equal(aur_exact_iterate(&system, DEGREE, AUR_EXACT_STEPS, iterated, &found, &error), AUR_OK);
    assert_true(found.exact && found.iterations > 5);
    for (size_t i = 0; i < N; ++i) /* residuals of 1e-15 times a condition of some 1e3 */
        assert_near(direct[i] * N, iterated[i] * N, 1e-11);
    free(xyz);
}

/* Sums from the definition: no bit depends on instruction set or threads, and both directions are adjoint. */
static void transforms(void **state) {
    (void)state;
    enum { N = 1111, DEGREE = 9 };
    const size_t size = aur_coefficient_count(DEGREE);
    double *const xyz = points_of("random", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double storage[4 * N], weights[N], values[N], sums[2][200], reference[N];
    double *const room = malloc(AUR_TRANSFORM_BANDS * aur_transform_room(DEGREE) * sizeof *room);
    const aur_polar_points points = aur_polar_points_make(N, xyz, storage);
    aur_basis basis;
    aur_error error;
    assert_int_equal(aur_basis_create(DEGREE, -1.0, 0.0, &basis, &error), AUR_OK);
    for (size_t i = 0; i < N; ++i)
        weights[i] = sin(3.0 * (double)i);
    const char *const sets[] = {"portable", "avx2", "avx512"};
    for (size_t k = 0; k < 3; ++k)
        for (size_t threads = 1; threads <= 3; threads += 2) {
            setenv("AUREOLE_ISA", sets[k], 1);
            aur_isa_reset();
            const aur_transform transform = {
                .basis = &basis, .points = &points, .threads = threads, .sums = room};
            const bool first = k == 0 && threads == 1;
            assert_int_equal(aur_transform_analyse(&transform, weights, sums[!first], &error), AUR_OK);
            assert_int_equal(
                aur_transform_synthesise(&transform, sums[0], first ? reference : values, &error), AUR_OK);
            if (first)
                continue;
            assert_memory_equal(sums[0], sums[1], size * sizeof(double));
            assert_memory_equal(reference, values, sizeof values);
        }
    unsetenv("AUREOLE_ISA");
    aur_isa_reset();
    double squares = 0.0, product = 0.0;
    for (size_t j = 0; j < size; ++j)
        squares += sums[0][j] * sums[0][j];
    for (size_t i = 0; i < N; ++i)
        product += weights[i] * reference[i];
    assert_relative(product, squares, 1e-13);
    /* Degree 3, order 2, the cosine, of mean square 1: sqrt(105)/2 z (x^2 - y^2). */
    double sum = 0.0;
    for (size_t i = 0; i < N; ++i)
        sum += weights[i] * 0.5 * sqrt(105.0) * xyz[3 * i + 2] *
               (xyz[3 * i] * xyz[3 * i] - xyz[3 * i + 1] * xyz[3 * i + 1]);
    assert_near(sums[0][2 * (aur_basis_at(DEGREE, 2) + 1)], sum, 1e-12);
    aur_basis_release(&basis);
    free(room);
    free(xyz);
}

/* The fast transforms against the plain ones, poles, seams and doubled points among them, at an even and an
 * odd degree; no bit depends on threads, and both directions are adjoint. The window errs by some 1e-14
 * of the largest value. */
static void fast_transforms(void **state) {
    (void)state;
    enum { N = 500 };
    double *const xyz = points_of("random", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    const double special[] = {0, 0, 1, 0, 0, -1, 1, 0, 0, -1, 0, 0, -1, -0.0, 0, 0, -1, 0, 0, -1, 0};
    memcpy(xyz, special, sizeof special);
    double storage[4 * N], weights[N], values[2][N];
    const aur_polar_points points = aur_polar_points_make(N, xyz, storage);
    aur_error error;
    for (size_t degree = 33; degree <= 64; degree += 31) {
        const size_t size = aur_coefficient_count(degree);
        double *const sums =
            malloc((2 * size + AUR_TRANSFORM_BANDS * aur_transform_room(degree)) * sizeof *sums);
        aur_basis basis;
        assert_int_equal(aur_basis_create(degree, -1.0, 0.0, &basis, &error), AUR_OK);
        const aur_transform transform = {
            .basis = &basis, .points = &points, .threads = 1, .sums = sums + 2 * size};
        for (size_t i = 0; i < N; ++i)
            weights[i] = sin(3.0 * (double)i);
        assert_int_equal(aur_transform_analyse(&transform, weights, sums, &error), AUR_OK);
        assert_int_equal(aur_transform_synthesise(&transform, sums, values[0], &error), AUR_OK);
        double largest = 0.0, most = 0.0;
        for (size_t i = 0; i < N; ++i)
            largest = fmax(largest, fabs(values[0][i]));
        for (size_t threads = 1; threads <= 3; threads += 2) {
            aur_fast_transform *fast;
            double *const found = sums + size;
            assert_int_equal(
                aur_fast_transform_create(&basis, &points, threads, (aur_progress){0}, &fast, &error),
                AUR_OK);
            assert_int_equal(aur_fast_transform_analyse(fast, weights, found, &error), AUR_OK);
            for (size_t j = 0; j < size; ++j)
                most = fmax(most, fabs(found[j]));
            for (size_t j = 0; j < size; ++j)
                assert_near(found[j], sums[j], 1e-13 * most);
            double before[N];
            memcpy(before, values[1], sizeof before);
            assert_int_equal(aur_fast_transform_synthesise(fast, sums, values[1], &error), AUR_OK);
            for (size_t i = 0; i < N; ++i)
                assert_near(values[1][i], values[0][i], 1e-13 * largest);
            if (threads > 1)
                assert_memory_equal(before, values[1], sizeof before);
            double left = 0.0, right = 0.0;
            for (size_t j = 0; j < size; ++j)
                left += found[j] * sums[j];
            for (size_t i = 0; i < N; ++i)
                right += weights[i] * values[1][i];
            assert_relative(left, right, 1e-13);
            aur_fast_transform_destroy(fast);
        }
        aur_basis_release(&basis);
        free(sums);
    }
    free(xyz);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_ways), cmocka_unit_test(transforms),
                                       cmocka_unit_test(fast_transforms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
