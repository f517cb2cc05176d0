/* The factorisation against its plain form, to the bit, and solves against LAPACK. */
#include "check.h"

#include <lapacke.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/simd.h"
#include "points/linear/solve.h"

/* The kernel for s = 3/2 of a spiral of points, with the default regularisation, as weights require it. */
static double *kernel_matrix(size_t n) {
    double *const matrix = malloc(n * n * sizeof *matrix);
    assert_non_null(matrix);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            const size_t at[2] = {i, j};
            double u[2][3];
            for (size_t k = 0; k < 2; ++k) {
                const double z = 1.0 - ((double)at[k] + 0.5) / (double)n, angle = 2.399963 * (double)at[k];
                u[k][0] = sqrt(1.0 - z * z) * cos(angle);
                u[k][1] = sqrt(1.0 - z * z) * sin(angle);
                u[k][2] = z;
            }
            const double x = u[0][0] - u[1][0], y = u[0][1] - u[1][1], z = u[0][2] - u[1][2];
            matrix[i * n + j] = 8.0 / 3.0 - sqrt(x * x + y * y + z * z) + (i == j ? 1e-6 : 0.0);
        }
    return matrix;
}

static double *copy_of(const double *source, size_t count) {
    double *const copy = malloc(count * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, source, count * sizeof *copy);
    return copy;
}

static void factor_plainly(size_t n, double *a, double *inverse) {
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j <= i; ++j) {
            double rest = a[i * n + j];
            for (size_t k = 0; k < j; ++k)
                rest -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? sqrt(rest) : rest * inverse[j];
        }
        inverse[i] = 1.0 / a[i * n + i];
    }
}

/* The kernels that this processor can run, portable first. */
static size_t kernels(const aur_cholesky *list[3]) {
    size_t count = 0;
    list[count++] = &aur_cholesky_portable;
#if defined(__x86_64__)
    if (aur_isa_available() >= AUR_ISA_AVX2)
        list[count++] = &aur_cholesky_avx2;
    if (aur_isa_available() >= AUR_ISA_AVX512)
        list[count++] = &aur_cholesky_avx512;
#endif
    return count;
}

static void check_bits(size_t n) {
    const aur_cholesky *list[3];
    const size_t count = kernels(list);
    double *const matrix = kernel_matrix(n);
    double *const plain = copy_of(matrix, n * n);
    double *const inverse = malloc((2 * n + aur_cholesky_work(n)) * sizeof *inverse);
    double *const first = malloc(4 * n * sizeof *first);
    assert_non_null(inverse);
    assert_non_null(first);
    factor_plainly(n, plain, inverse);
    for (size_t k = 0; k < count; ++k) {
        double *const used = copy_of(matrix, n * n);
        assert_true(list[k]->factor(n, used, inverse + n, inverse + 2 * n));
        for (size_t i = 0; i < n; ++i)
            assert_memory_equal(used + i * n, plain + i * n, (i + 1) * sizeof *used);
        assert_memory_equal(inverse, inverse + n, n * sizeof *inverse);
        double *const x = first + (k == 0 ? 0 : 2 * n);
        for (size_t i = 0; i < 2 * n; ++i)
            x[i] = cos((double)i);
        list[k]->solve(n, used, inverse + n, 2, x);
        assert_memory_equal(x, first, 2 * n * sizeof *x);
        free(used);
    }
    free(first);
    free(inverse);
    free(plain);
    free(matrix);
}

static void test_bits(void **state) {
    (void)state;
    for (size_t n = 1; n <= 40; ++n)
        check_bits(n);
    for (size_t i = 0; i < 5; ++i)
        check_bits((size_t[]){96, 127, 129, 200, 301}[i]);
}

/* Products of rows with each other, in the order of the columns. */
static void check_gram(size_t n, size_t depth) {
    const aur_cholesky *list[3];
    const size_t count = kernels(list);
    double *const rows = malloc(n * depth * sizeof *rows);
    double *const matrix = malloc((n * n + aur_cholesky_work(n)) * sizeof *matrix);
    assert_non_null(rows);
    assert_non_null(matrix);
    for (size_t i = 0; i < n * depth; ++i)
        rows[i] = cos(0.7 * (double)i);
    for (size_t k = 0; k < count; ++k) {
        list[k]->gram(n, depth, rows, matrix, matrix + n * n);
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j <= i; ++j) {
                double sum = 0.0;
                for (size_t c = 0; c < depth; ++c)
                    sum += rows[i * depth + c] * rows[j * depth + c];
                assert_true(matrix[i * n + j] == sum);
            }
    }
    free(matrix);
    free(rows);
}

static void test_gram(void **state) {
    (void)state;
    for (size_t i = 0; i < 6; ++i)
        check_gram((size_t[]){1, 2, 17, 33, 128, 200}[i], (size_t[]){3, 1, 40, 129, 200, 300}[i]);
}

static void check_lapack(size_t n) {
    const lapack_int size = (lapack_int)n;
    double *const matrix = kernel_matrix(n);
    double *const theirs = copy_of(matrix, n * n);
    double *const x = malloc(2 * n * sizeof *x);
    assert_non_null(x);
    for (size_t i = 0; i < 2 * n; ++i)
        x[i] = cos((double)(i % n));
    const double norm = LAPACKE_dlansy(LAPACK_COL_MAJOR, '1', 'U', size, theirs, size);
    assert_int_equal(LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', size, theirs, size), 0);
    double reciprocal, condition;
    assert_int_equal(LAPACKE_dpocon(LAPACK_COL_MAJOR, 'U', size, theirs, size, norm, &reciprocal), 0);
    assert_int_equal(LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'U', size, 1, theirs, size, x + n, size), 0);
    assert_int_equal(aur_solve_positive(n, matrix, 1, x, &condition, NULL), AUR_OK);
    /* Both solve a system with errors of some n units in the last place, multiplied by its condition. */
    const double error = 4.0 * (double)n * 0x1p-53 * condition;
    assert_true(error < 1e-3);
    assert_relative(condition, 1.0 / reciprocal, error);
    double largest = 0.0;
    for (size_t i = 0; i < n; ++i)
        largest = fmax(largest, fabs(x[n + i]));
    for (size_t i = 0; i < n; ++i)
        assert_near(x[i], x[n + i], error * largest);
    free(x);
    free(theirs);
    free(matrix);
}

static void test_lapack(void **state) {
    (void)state;
    for (size_t i = 0; i < 6; ++i)
        check_lapack((size_t[]){1, 2, 17, 128, 300, 1000}[i]);
}

static void test_not_positive(void **state) {
    (void)state;
    static const double bad[] = {-1e-3, 0.0, NAN};
    for (size_t k = 0; k < 3; ++k)
        for (size_t at = 0; at < 70; at += 23) {
            double *const matrix = kernel_matrix(70);
            double right[70] = {0};
            matrix[at * 70 + at] = bad[k];
            aur_error error;
            assert_int_equal(aur_solve_positive(70, matrix, 1, right, NULL, &error), AUR_ERROR_INTERNAL);
            assert_non_null(strstr(error.message, "not positive definite"));
            free(matrix);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bits), cmocka_unit_test(test_gram),
                                       cmocka_unit_test(test_lapack), cmocka_unit_test(test_not_positive)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
