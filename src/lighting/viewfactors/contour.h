/* Exchange of light between two polygons that see each other wholly, by integrals along their edges. */
#pragma once

#include <stddef.h>

/* Area of the first times its view factor to the second:
 *
 *     A1 F12 = 1/(2 pi) sum over edges e of 1 and f of 2 of dot(e, f) times the integral of ln r along both
 *
 * (Moon 1936; Sparrow 1963). The polygons may touch, share edges or corners, or be far away; each must lie in
 * front of the other's plane, and nothing may stand between them. The inner integral is a closed form, the
 * outer one Gauss's rule on pieces that shrink towards where the integrand is not smooth. Twelve digits. */
double aur_contour_exchange(size_t first_count, const double (*first)[3], size_t second_count,
                            const double (*second)[3]);
