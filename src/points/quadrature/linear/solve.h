/* Symmetric positive definite systems, on one thread. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

/* Solves matrix * X = right, in place. `matrix` (size * size, row major) is read on and below its diagonal
 * and destroyed there; `right` holds `columns` vectors one after another. *condition, unless NULL, gets an
 * estimate of the 1-norm condition number. INTERNAL when the matrix is not positive definite, MEMORY. */
aur_result aur_solve_positive(size_t size, double *matrix, size_t columns, double *right, double *condition,
                              aur_error *error);

/* Changes a solution of K X = z, in place, to that of least error among those whose sum is 1; `ones` solves K
 * X = 1. Returns the multiplier of the constraint. */
double aur_hold_sum(size_t size, double *solution, const double *ones);

/* Refuses a system of that size when its matrix is larger than the machine's memory, saying how much it
 * takes. */
aur_result aur_check_system_size(size_t size, aur_error *error);
