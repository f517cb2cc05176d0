/* Vectors of three doubles, for points, weights and geometry that is computed once. Rays use
 * points/base/vector.h.
 */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"

static inline double aur_dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void aur_cross3(const double a[3], const double b[3], double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double aur_length3(const double a[3]) {
    return sqrt(aur_dot3(a, a));
}

/* Divides `a` by its length and returns the length; a zero vector is unchanged. */
static inline double aur_normalize3(double a[3]) {
    const double length = aur_length3(a);
    for (int d = 0; d < 3 && length > 0.0; ++d)
        a[d] /= length;
    return length;
}

/* Whether the squared length is 1 within 2e-6; false for NaN. */
static inline bool aur_is_unit(const double a[3]) {
    return fabs(aur_dot3(a, a) - 1.0) <= 2e-6;
}

/* Two unit vectors that make a right-handed frame with the unit vector `z` (Duff et al. 2017). */
static inline void aur_frame3(const double z[3], double x[3], double y[3]) {
    const double sign = copysign(1.0, z[2]);
    const double a = -1.0 / (sign + z[2]);
    const double b = z[0] * z[1] * a;
    x[0] = 1.0 + sign * z[0] * z[0] * a;
    x[1] = sign * b;
    x[2] = -sign * z[0];
    y[0] = b;
    y[1] = sign + z[1] * z[1] * a;
    y[2] = -z[1];
}

/* Exact orientation of a point of the plane and a line. */

/* Twice the signed area of the triangle a, b, c: positive when it turns to the left. The sign is exact
 * (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates"), and
 * so is 0, for coordinates whose products neither overflow nor underflow; the value is rounded. */
AUR_INTERNAL double aur_orientation(const double a[2], const double b[2], const double c[2]);

/* Plane convex polygons in double precision, counter-clockwise seen from their front. */

/* A plane's points x have dot(normal, x) == offset; the normal, of unit length, points to its front. */
typedef struct aur_plane {
    double normal[3];
    double offset;
} aur_plane;

/* How far in front of the plane the point is; negative behind it. */
static inline double aur_plane_height(const aur_plane *plane, const double point[3]) {
    return aur_dot3(plane->normal, point) - plane->offset;
}

/* The area, and the plane through the corners' mean (Newell's normal). The plane is zero when there is no
 * area. */
AUR_INTERNAL double aur_polygon_plane(size_t count, const double (*corners)[3], aur_plane *plane);

/* Twice the area divided by the perimeter: half to all of the width of a long and narrow polygon. */
AUR_INTERNAL double aur_polygon_width(size_t count, const double (*corners)[3]);

/* The part in front of the plane: cut[count + 1], which must not overlap `corners`. Returns its number of
 * corners, 0 when nothing is in front. */
AUR_INTERNAL size_t aur_polygon_clip(size_t count, const double (*corners)[3], const aur_plane *plane,
                                     double (*cut)[3]);
