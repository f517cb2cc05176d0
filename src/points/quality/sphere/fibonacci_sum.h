/* The sum of distances of spherical Fibonacci points in O(N log N). */
#pragma once

#include "points/quality/measure.h"
#include "points/quality/pairs/twofold.h"

/* Whether the points are those of Marques 2013 eq. 4 in their order, to rounding and up to a rotation about
 * z. */
int aur_is_spherical_fibonacci(const aur_points_view *points);

/* The sum of |x_i - x_j| over the unordered pairs of the `count` points of a spherical Fibonacci set, on the
 * sphere or (the first half of a set of 2 * count) on the hemisphere. */
aur_result aur_fibonacci_distance_sum(size_t count, aur_domain domain, const aur_measure_options *options,
                                      aur_twofold *sum, aur_error *error);

/* Mean distances on the hemisphere. */

/* The mean distance from a point of the unit sphere with height z, -1 <= z <= 1, to the hemisphere z >= 0; to
 * the last bits. */
double aur_hemisphere_potential(double z);

/* The mean distance of two points of the hemisphere, 32 / (9 pi), to twice the precision. */
static inline aur_twofold aur_hemisphere_mean_distance(void) {
    return (aur_twofold){1.1317684842090334, 7.806110843826092e-17};
}
