/* Measures of rotations, which are passed as quaternions and their opposites. */
#pragma once

#include "points/quality/measure.h"

/* The sum over unordered pairs of rotations of w_i w_j pair(d^2, parameter), d the distance of their nearer
 * quaternions, w masses that add up to 1; compensated, in an order that depends only on the data. INFINITY if
 * a pair has it. */
aur_result aur_rotation_pair_sum(const aur_measure_request *request, double (*pair)(double, double),
                                 double parameter, double *sum, aur_error *error);

/* The square of the distance energy on the unit quaternions: 64 / (15 pi), the mean distance of two random
 * points of the three-sphere, less the mean distance of the quaternions and their opposites. */
aur_result aur_rotation_energy(const aur_measure_request *request, double *square, aur_error *error);

/* The largest angle in radians from any rotation to the nearest of the set. */
aur_result aur_rotation_covering(const aur_measure_request *request, double *angle, aur_error *error);
