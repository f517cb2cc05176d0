/* The normal equations of the least-squares correction of row sums.
 *
 * With G the exchanges, w their variances, and a multiplier m per row, the changes are G_ab += w_ab (m_a +
 * m_b), G_aa += w_aa m_a, sky_a += v_a m_a, where the multipliers solve (D + W) m = residuals of the row
 * sums, D the diagonal of row sums of W. The matrix is positive semidefinite. It is regular if each connected
 * component has a row that sees sky, or an odd cycle. */
#pragma once

#include "lighting/viewfactors/exchange.h"

typedef struct aur_row_system {
    aur_exchange *exchange;
    const aur_parallel_options *parallel;
    double *weights;  /* per entry; 0 for fixed ones */
    double *diagonal; /* of the matrix */
    double *losses;   /* weights of sky and back: [2][rows] */
    double *deficit, *multipliers;
    double *residual, *direction, *image, *best;
} aur_row_system;

/* Computes the diagonal from the weights. */
void aur_row_system_prepare(aur_row_system *system);
/* Solves for the residuals `lack`; `best` receives the multipliers. Stops when the squared residual has
 * fallen by `goal`, or stagnates, if there is no solution. Errors: CANCELLED, MEMORY. */
aur_result aur_row_system_solve(aur_row_system *system, double goal, aur_error *error);

/* Applies the correction to each randomisation's deviations from the mean, with the same weights: the
 * correction is linear, except for entries clamped at 0, which stay 0. Errors: CANCELLED, MEMORY. */
aur_result aur_row_system_settle(aur_row_system *system, aur_error *error);
