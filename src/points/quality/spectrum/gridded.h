/* The periodogram of points of the square in O(points + F^2 log F), by a grid. */
#pragma once

#include "points/quality/measure.h"

/* Whether options.accuracy allows a grid: the error of powers is then at most that, relative to the larger of
 * 1 and the power in units of a random set. */
bool aur_gridded_allowed(const aur_measure_request *request);

/* |sum_i w_i e^{2 pi i (kx x_i + ky y_i)}|^2 at power[kx * (2F + 1) + F + ky], 0 <= kx <= F, -F <= ky <= F.
 * Errors: MEMORY, CANCELLED. */
aur_result aur_gridded_powers(const aur_measure_request *request, size_t limit, double *power,
                              aur_error *error);

/* Columns degree and power, degrees 1 to L: the mean over i and j of w_i w_j P_l(x_i.x_j), in units of a
 * random set. */
aur_result aur_angular_spectrum(const aur_measure_request *request, aur_series *series, aur_error *error);
