/* The Cholesky factorisation K = L L^T of symmetric positive definite matrices, row by row in memory.
 *
 * Every entry is what the plain algorithm gives, L_ij = (K_ij - L_i0 L_j0 - L_i1 L_j1 - ...) / L_jj, with its
 * terms subtracted one by one in this order, without contraction, and the division done as a product with
 * 1 / L_jj. Blocks, widths of registers and instruction sets change only which entries are worked on at one
 * time, so the bits are the same on every processor. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct aur_cholesky {
    /* Replaces matrix[size * size], read on and below its diagonal, by L; inverse[size] gets the reciprocals
     * of L's diagonal, and work has room for aur_cholesky_work(size) doubles. What stands above the diagonal
     * is lost. False when the matrix is not positive definite. */
    bool (*factor)(size_t size, double *matrix, double *inverse, double *work);
    /* Solves K X = right in place, for `columns` vectors one after another. */
    void (*solve)(size_t size, const double *matrix, const double *inverse, size_t columns, double *right);
} aur_cholesky;

/* The functions for this processor. */
const aur_cholesky *aur_cholesky_best(void);
size_t aur_cholesky_work(size_t size);

extern const aur_cholesky aur_cholesky_portable, aur_cholesky_avx2, aur_cholesky_avx512;
