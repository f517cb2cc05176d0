/* Plane convex polygons in double precision, counter-clockwise seen from their front. */
#pragma once

#include "points/base/vector3d.h"

#include <stddef.h>

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
double aur_polygon_plane(size_t count, const double (*corners)[3], aur_plane *plane);

/* Twice the area by the length of the outline: half to all of the width of what is long and narrow. */
double aur_polygon_width(size_t count, const double (*corners)[3]);

/* The part in front of the plane: cut[count + 1], which must not overlap `corners`. Returns its number of
 * corners, 0 when nothing is in front. */
size_t aur_polygon_clip(size_t count, const double (*corners)[3], const aur_plane *plane, double (*cut)[3]);
