/* The linear system of least changes that make rows add up.
 *
 * With G the exchanges, w their variances, and a multiplier m for each row, changes of least squares are
 *
 *     G_ab += w_ab (m_a + m_b),  G_aa += w_aa m_a,  sky_a += v_a m_a,
 *
 * where the multipliers solve (D + W) m = what the rows lack, D the diagonal of row sums. The matrix is
 * positive, and regular where a row, or one that it is linked to, sees sky or sees in an odd circle. */
#pragma once

#include "lighting/viewfactors/exchange.h"

typedef struct aur_row_system {
    aur_exchange *exchange;
    const aur_parallel_options *parallel;
    double *weights;  /* of the entries; 0 for what may not move */
    double *diagonal; /* of the matrix */
    double *losses;   /* weights of sky and back: [2][rows] */
    double *deficit, *multipliers;
    double *residual, *direction, *image, *best;
} aur_row_system;

/* Sets the diagonal by the weights. */
void aur_row_system_prepare(aur_row_system *system);
/* Finds what multipliers of `lack` to have in `best`: until the residual's square has fallen by `goal`, or
 * falls no more, where there is no solution. Errors: CANCELLED, MEMORY. */
aur_result aur_row_system_solve(aur_row_system *system, double goal, aur_error *error);

/* Does to each randomisation's deviations from the mean what the weights and multipliers do to the mean: the
 * least change is linear, but for what it has cut at 0, which stays as it is. Errors: CANCELLED, MEMORY. */
aur_result aur_row_system_settle(aur_row_system *system, aur_error *error);
