/* Which triangles may have a part of their plane in common with others. */
#pragma once

#include <float.h>

#include "render/scene/overlaps.h"

/* How far apart triangles may be, by the larger one's extent and the largest of their coordinates. */
static inline double aur_overlap_slack(double extent, double largest) {
    return 1e-6 * extent + 4.0 * DBL_EPSILON * largest;
}

/* How far the normal of a triangle may be off, by its least altitude. Those of triangles that overlap differ
 * by at most the sum of both. */
static inline double aur_overlap_tilt(double slack, double altitude) {
    return 4.0 * slack / altitude;
}

enum {
    AUR_PLANE_ALONE,  /* overlaps at most triangles that are UNLIKE */
    AUR_PLANE_SHARED, /* may overlap others */
    AUR_PLANE_UNLIKE, /* much larger or narrower than most: may overlap any */
};

/* Marks the triangles by hashing their planes; the marks depend on nothing but the triangles. Returns the
 * number of those that are UNLIKE, or SIZE_MAX: no memory. */
size_t aur_planes_mark(const aur_triangle_source *triangles, uint8_t *marks);
