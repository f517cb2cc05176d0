/* Single-threaded solvers for symmetric positive definite systems. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"
#include "points/base/simd.h"

/* Solves matrix * X = right, in place. `matrix` (size * size, row major) is read on and below its diagonal
 * and destroyed there; `right` holds `columns` vectors one after another. *condition, unless NULL, becomes an
 * estimate of the 1-norm condition number. INTERNAL when the matrix is not positive definite, MEMORY. */
aur_result aur_solve_positive(size_t size, double *matrix, size_t columns, double *right, double *condition,
                              aur_error *error);

/* Changes a solution of K X = z, in place, to the one that minimises the error subject to sum 1; `ones`
 * solves K X = 1. Returns the Lagrange multiplier of the constraint. */
double aur_constrain_sum(size_t size, double *solution, const double *ones);

/* MEMORY with the required size if the matrix of a system is larger than the machine's memory. */
aur_result aur_check_system_size(size_t size, aur_error *error);

/* The Cholesky factorisation K = L L^T of symmetric positive definite matrices, row by row in memory.
 *
 * Every entry equals that of the plain algorithm, L_ij = (K_ij - L_i0 L_j0 - L_i1 L_j1 - ...) / L_jj, with
 * terms subtracted one by one in this order, without contraction, and a multiplication by 1 / L_jj instead of
 * the division. Blocks, register widths and instruction sets change only which entries are computed together,
 * so results are bit-identical on every processor. */

typedef struct aur_cholesky {
    /* Replaces matrix[size * size], read on and below its diagonal, by L; inverse[size] becomes the
     * reciprocals of L's diagonal; work has aur_cholesky_work(size) doubles. Entries above the diagonal are
     * overwritten. False when the matrix is not positive definite. */
    bool (*factor)(size_t size, double *matrix, double *inverse, double *work);
    /* Solves K X = right in place, for `columns` vectors one after another. */
    void (*solve)(size_t size, const double *matrix, const double *inverse, size_t columns, double *right);
    /* matrix[size * size], on and below its diagonal: the products of the `size` rows of rows[size * depth]
     * with each other; `work` as for `factor`. */
    void (*gram)(size_t size, size_t depth, const double *rows, double *matrix, double *work);
} aur_cholesky;

AUR_KERNELS(const aur_cholesky, aur_cholesky);

/* The number of columns factored at a time, and the size of their blocks. */
enum { AUR_CHOLESKY_NARROW = 16, AUR_CHOLESKY_WIDE = 128 };

/* Strips with the width of the widest tile and the depth of the widest block of columns. */
static inline size_t aur_cholesky_work(size_t size) {
    return (size + AUR_CHOLESKY_NARROW) *
           (size > AUR_CHOLESKY_WIDE ? AUR_CHOLESKY_WIDE : AUR_CHOLESKY_NARROW);
}
