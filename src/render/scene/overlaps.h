/* Overlaps of coplanar triangles. */
#pragma once

#include <float.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "render/scene/scene_data.h"

/* The triangles of `context`, `count` in total, in any coordinates: writes corners[some] from `first` on. */
typedef struct aur_triangle_source {
    size_t count;
    const void *context;
    void (*corners)(const void *context, size_t first, size_t some, double (*corners)[3][3]);
    bool doubles; /* rays intersect them in doubles, which resolve any gap */
} aur_triangle_source;

/* The triangle `second` overlaps `first`, which comes before it. */
typedef struct aur_overlap {
    uint32_t first, second;
    bool opposite; /* their normals are opposite */
} aur_overlap;

typedef struct aur_overlaps {
    size_t count;
    aur_overlap *items; /* sorted by the second triangle, then by the first */
} aur_overlaps;

/* Finds all pairs, except among thousands of instances in one place.
 *
 * Two triangles are coplanar if their distance, over the part they share, is at most a millionth of an
 * extent: that of the larger triangle, or that of the smaller one plus, for each axis, the larger one's
 * extent times its normal's component. (For a level ground that term is 0.) This tolerates rounded
 * coordinates. The angle between the planes must be explained by corners four times as far off. Planes at an
 * even distance, such as a rug and a floor, must be within 1.2e-7 of an extent, the rounding of float rays,
 * or with `doubles` within the rounding of coordinates. Plates that face each other across an even gap do not
 * overlap, however narrow the gap. Overlaps narrower than 3e-6 of the larger extent are ignored. Errors:
 * MEMORY. */
AUR_INTERNAL aur_result aur_overlaps_find(const aur_triangle_source *triangles, size_t threads,
                                          aur_overlaps *overlaps, aur_error *error);
static inline void aur_overlaps_release(aur_overlaps *overlaps) {
    free(overlaps->items);
    *overlaps = (aur_overlaps){0};
}

/* Surfaces in one plane: the first in the file wins. */

/* Removes from meshes the parts covered by coplanar triangles that come before, in the order of shapes and
 * triangles (overlaps.h), before they are recentred. Rays and lights then hit only the first of such
 * surfaces. Shapes of groups are cut only by others of their group. Stores in scene->overlap the number of
 * triangles cut, and the first pair. Follows scene->overlap_rule. Errors: MEMORY. */
aur_result aur_scene_cut_overlaps(aur_scene *scene, size_t threads, aur_error *error);

/* One warning with a count, if anything was cut. */
void aur_scene_warn_of_overlaps(const aur_scene *scene, const aur_warnings *warnings);

/* Candidates: triangles that may overlap others in their plane. */

/* The largest distance of overlapping triangles, given the larger one's extent and the largest coordinate. */
static inline double aur_overlap_slack(double extent, double largest) {
    return 1e-6 * extent + 4.0 * DBL_EPSILON * largest;
}

/* The possible error of a triangle's normal, given its least altitude. Normals of overlapping triangles
 * differ by at most the sum of both. */
static inline double aur_overlap_tilt(double slack, double altitude) {
    return 4.0 * slack / altitude;
}

enum {
    AUR_PLANE_ALONE,  /* can overlap only UNLIKE triangles */
    AUR_PLANE_SHARED, /* may overlap others */
    AUR_PLANE_UNLIKE, /* much larger or narrower than most: may overlap any */
};

/* Marks the triangles by hashing their planes; the marks depend only on the triangles. Returns the number of
 * UNLIKE triangles, or SIZE_MAX: out of memory. */
size_t aur_planes_mark(const aur_triangle_source *triangles, uint8_t *marks);

/* A group of shapes for a single instance. */

/* Gives the instance a separate group with copies of its shapes, all of them meshes in doubles. Errors:
 * MEMORY. */
aur_result aur_instance_separate_group(aur_scene *scene, aur_instance *instance, aur_error *error);
