/* Triangles that lie in one plane and overlap. */
#pragma once

#include <float.h>
#include <stdbool.h>
#include <stdint.h>

#include "points/base/error.h"
#include "render/scene/scene_data.h"

/* The `count` triangles that `context` knows, in any coordinates: corners[some] of those from `first` on. */
typedef struct aur_triangle_source {
    size_t count;
    const void *context;
    void (*corners)(const void *context, size_t first, size_t some, double (*corners)[3][3]);
    bool doubles; /* rays order them in doubles, which resolve any gap */
} aur_triangle_source;

/* The triangle `second` has a part in common with `first`, which comes before it. */
typedef struct aur_overlap {
    uint32_t first, second;
    bool opposite; /* their normals point to opposite sides */
} aur_overlap;

typedef struct aur_overlaps {
    size_t count;
    aur_overlap *items; /* by their second triangle, then by their first one */
} aur_overlaps;

/* All pairs, but for those of thousands of copies in one place. Triangles lie in one plane when they are
 * nowhere more than a millionth of an extent apart in the part that they share, as coordinates that were
 * rounded may be: of the larger one's, or of the smaller one's and, axis by axis, as much of the larger one's
 * as its normal has of that axis, which for a level ground is nothing. They are not more inclined than
 * corners that are four times as far off make them; where they are evenly apart, like a rug and a
 * floor, 1.2e-7 of it, which is the rounding of rays of floats, or with `doubles` the rounding of
 * coordinates. Plates whose fronts look at each other across an even gap do not overlap, however narrow it
 * is. What is narrower than 3e-6 of the larger extent does not count. Errors: MEMORY. */
AUR_INTERNAL aur_result aur_overlaps_find(const aur_triangle_source *triangles, size_t threads,
                                          aur_overlaps *overlaps, aur_error *error);
AUR_INTERNAL void aur_overlaps_release(aur_overlaps *overlaps);

/* Surfaces in one plane: the first in the file wins. */

/* Cuts off meshes what triangles that come before, in the order of shapes and triangles, cover in their plane
 * (overlaps.h), before they are recentred: rays and lights then meet the first of such surfaces only. Shapes
 * of groups are cut by others of their group alone. Leaves in scene->overlap how many triangles were cut, and
 * the first pair. Does what scene->overlap_rule says. Errors: MEMORY. */
aur_result aur_scene_cut_overlaps(aur_scene *scene, size_t threads, aur_error *error);

/* One counted warning, if something was cut. */
void aur_scene_warn_of_overlaps(const aur_scene *scene, const aur_warnings *warnings);

/* Which triangles may have a part of their plane in common with others. */

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

/* Marks the triangles by hashing their planes; the marks depend on only the triangles. Returns the
 * number of those that are UNLIKE, or SIZE_MAX: no memory. */
size_t aur_planes_mark(const aur_triangle_source *triangles, uint8_t *marks);

/* A group of shapes for one instance alone. */

/* Gives the instance a group with copies of the shapes of its own one, all of them meshes in doubles. Errors:
 * MEMORY. */
aur_result aur_instance_own_group(aur_scene *scene, aur_instance *instance, aur_error *error);
