#pragma once

#include "points/quality/measure.h"

/* Columns degree and power, degrees 1 to L: the mean over i and j of w_i w_j P_l(x_i.x_j), in units of a
 * random set. */
aur_result aur_angular_spectrum(const aur_measure_request *request, aur_series *series, aur_error *error);
