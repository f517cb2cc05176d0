/* On which side of a line a point of the plane lies, exactly. */
#pragma once

/* Twice the signed area of the triangle a, b, c: positive when it turns to the left. The sign is exact
 * (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates"), and
 * so is 0, for coordinates whose products neither overflow nor underflow; the value is rounded. */
double aur_orientation(const double a[2], const double b[2], const double c[2]);
