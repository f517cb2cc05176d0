#include "points/linear/solve.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"

aur_result aur_check_system_size(size_t size, aur_error *error) {
    const double needed = (double)size * (double)size * sizeof(double);
    const double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const double memory = aur_machine_memory();
    if (needed <= memory)
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

/* A factored system, and two vectors of scratch memory. */
typedef struct factored {
    size_t size;
    const double *matrix, *inverse;
    double *x, *signs;
} factored;

/* Solves for x in place; returns the 1-norm of the solution. */
static double solve_in_place(const factored *system) {
    AUR_KERNEL_HERE(aur_cholesky).solve(system->size, system->matrix, system->inverse, 1, system->x);
    double sum = 0.0;
    for (size_t i = 0; i < system->size; ++i)
        sum += fabs(system->x[i]);
    return sum;
}

/* An estimate of the 1-norm of the inverse, a lower bound that is seldom less than a third of it (Higham
 * 1988, Algorithm 4.1, as LAPACK's dlacn2). */
static double inverse_norm(const factored *system) {
    const size_t n = system->size;
    double *const x = system->x;
    for (size_t i = 0; i < n; ++i)
        x[i] = 1.0 / (double)n;
    double norm = solve_in_place(system);
    size_t largest = n;
    for (int step = 0; step < 5 && n > 1; ++step) {
        bool same = step > 0;
        for (size_t i = 0; i < n; ++i) {
            const double sign = x[i] >= 0.0 ? 1.0 : -1.0;
            same = same && sign == system->signs[i];
            x[i] = system->signs[i] = sign;
        }
        if (same)
            break;
        solve_in_place(system);
        const size_t before = largest;
        largest = 0;
        for (size_t i = 1; i < n; ++i)
            largest = fabs(x[i]) > fabs(x[largest]) ? i : largest;
        if (before < n && fabs(x[before]) == fabs(x[largest]))
            break;
        for (size_t i = 0; i < n; ++i)
            x[i] = i == largest ? 1.0 : 0.0;
        const double next = solve_in_place(system);
        if (next <= norm)
            break;
        norm = next;
    }
    for (size_t i = 0; i < n; ++i)
        x[i] = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + (double)i / fmax(1.0, (double)n - 1.0));
    return fmax(norm, 2.0 * solve_in_place(system) / (3.0 * (double)n));
}

aur_result aur_solve_positive(size_t size, double *matrix, size_t columns, double *right, double *condition,
                              aur_error *error) {
    double *const storage = malloc((3 * size + aur_cholesky_work(size)) * sizeof *storage);
    if (storage == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a system of %zu samples", size);
    const factored system = {size, matrix, storage, storage + size, storage + 2 * size};
    const double norm = condition != NULL ? one_norm(size, matrix, storage) : 0.0;
    bool good = AUR_KERNEL_HERE(aur_cholesky).factor(size, matrix, storage, storage + 3 * size);
    if (good) {
        AUR_KERNEL_HERE(aur_cholesky).solve(size, matrix, storage, columns, right);
        if (condition != NULL)
            *condition = norm * inverse_norm(&system);
    }
    free(storage);
    for (size_t i = 0; i < size * columns && good; ++i)
        good = isfinite(right[i]);
    return good ? AUR_OK
                : aur_fail(error, AUR_ERROR_INTERNAL,
                           "the %zu by %zu system of the weights is not positive definite: a larger "
                           "regularisation helps",
                           size, size);
}

double aur_constrain_sum(size_t size, double *solution, const double *ones) {
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
