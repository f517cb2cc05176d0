/* The power of directions at each degree of spherical harmonics, in O(points + degree^3). */
#pragma once

#include "points/quality/measure.h"

/* powers[l] = sum_ij w_i w_j P_l(x_i . x_j), 1 <= l <= degree, which is at most AUR_BASIS_DEGREE_MAX. The
 * root of each is good to AUR_WINDOW_ERROR times the sum of the absolute weights. Errors: MEMORY. */
aur_result aur_powers_find(const aur_points_view *points, size_t degree, size_t threads, double *powers,
                           aur_error *error);
