/* Triangles that lie in one plane and overlap. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "points/base/error.h"
#include "points/base/internal.h"

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
