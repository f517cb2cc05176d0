#include "quadrature/solve.h"

#include <cblas.h>
#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "core/memory.h"

static pthread_mutex_t openblas = PTHREAD_MUTEX_INITIALIZER;

static void set_one_thread(void) {
    openblas_set_num_threads(1);
}

/* OpenBLAS has one number of threads for the whole process; and when several threads call it at once, Debian
 * 12's 0.3.21 now and then gives wrong numbers (one or two in a thousand systems of 60 unknowns, on busy
 * cores). */
static void enter_openblas(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_one_thread);
    pthread_mutex_lock(&openblas);
}

static void leave_openblas(void) {
    pthread_mutex_unlock(&openblas);
}

aur_result aur_check_system_size(size_t size, aur_error *error) {
    const double needed = (double)size * (double)size * sizeof(double);
    const double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const double memory = aur_machine_memory();
    if (needed <= memory && size <= INT_MAX)
        return AUR_OK;
    return aur_fail(
        error, AUR_ERROR_MEMORY,
        "the weights of %zu samples take %.1f GiB; this machine has %.1f, enough for %.0f samples", size,
        needed / gibibyte, memory / gibibyte, floor(sqrt(memory / sizeof(double))));
}

/* Row sums of absolute values from the lower triangle. */
static double one_norm(size_t size, const double *matrix, double *sums) {
    for (size_t i = 0; i < size; ++i) {
        sums[i] = 0.0;
        for (size_t j = 0; j <= i; ++j) {
            const double value = fabs(matrix[i * size + j]);
            sums[i] += value;
            sums[j] += i != j ? value : 0.0;
        }
    }
    double norm = 0.0;
    for (size_t i = 0; i < size; ++i)
        norm = fmax(norm, sums[i]);
    return norm;
}

static aur_result not_positive(aur_error *error, size_t size) {
    return aur_fail(
        error, AUR_ERROR_INTERNAL,
        "the %zu by %zu system of the weights is not positive definite: a larger regularisation helps", size,
        size);
}

aur_result aur_solve_positive(size_t size, double *matrix, size_t columns, double *right, double *condition,
                              aur_error *error) {
    const lapack_int n = (lapack_int)size;
    double *work = NULL;
    double norm = 0.0;
    if (condition != NULL) {
        work = malloc(3 * size * sizeof *work + size * sizeof(lapack_int));
        if (work == NULL)
            return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
        norm = one_norm(size, matrix, work);
    }
    enter_openblas();
    /* The lower triangle of a row-major matrix is the upper one of LAPACK's. */
    lapack_int info = LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'U', n, matrix, n);
    if (info == 0)
        info = LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'U', n, (lapack_int)columns, matrix, n, right, n);
    if (info == 0 && condition != NULL) {
        double reciprocal = 0.0;
        info = LAPACKE_dpocon_work(LAPACK_COL_MAJOR, 'U', n, matrix, n, norm, &reciprocal, work,
                                   (lapack_int *)(void *)(work + 3 * size));
        *condition = reciprocal > 0.0 ? 1.0 / reciprocal : (double)INFINITY;
    }
    leave_openblas();
    free(work);
    if (info != 0)
        return not_positive(error, size);
    for (size_t i = 0; i < size * columns; ++i)
        if (!isfinite(right[i]))
            return not_positive(error, size);
    return AUR_OK;
}

double aur_hold_sum(size_t size, double *solution, const double *ones) {
    double sum = 0.0, ones_sum = 0.0;
    for (size_t i = 0; i < size; ++i) {
        sum += solution[i];
        ones_sum += ones[i];
    }
    const double multiplier = (sum - 1.0) / ones_sum;
    for (size_t i = 0; i < size; ++i)
        solution[i] -= multiplier * ones[i];
    return multiplier;
}
