/* Sky view of patches by half planes. The occluders in a half plane are a union of segments, so only the
 * origin on the patch and the azimuth of the half plane are sampled. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/facets.h"
#include "points/base/parallel.h"

typedef struct aur_sky_slices aur_sky_slices;

/* `count` half planes for each patch and randomisation. The randomisations are the parts of one point set,
 * which is shifted randomly for every patch. Errors: those of aur_facet_points, MEMORY. */
aur_result aur_sky_slices_create(const aur_facets *facets, const char *set, size_t count,
                                 size_t randomizations, uint64_t seed, aur_sky_slices **slices,
                                 aur_error *error);
void aur_sky_slices_destroy(aur_sky_slices *slices); /* NULL is allowed */

/* sky[patch_count][randomizations]: the visible fraction of the sky; 0 for patches without area. The values
 * are rescaled so that independent estimates with their spread have the error of the whole set
 * (net_spread.c). Errors: CANCELLED, MEMORY. */
aur_result aur_sky_slices_measure(const aur_sky_slices *slices, const aur_parallel_options *parallel,
                                  double *sky, aur_error *error);

/* Half planes of a patch: azimuths, and origins on the patch. */

/* A patch in permuted coordinates. */
typedef struct aur_slice_patch {
    float corner[3], edge[2][3];
    float inset;              /* barycentric: offset of origins from the edges, where other facets begin */
    double ahead[2], upright; /* unit direction of the normal's horizontal part, and its length */
} aur_slice_patch;

typedef struct aur_slice_sample {
    float direction[2], position[2], jitter, weight;
    uint32_t randomization, bucket;
} aur_slice_sample;

/* Samples in the order of azimuth, so that packets traverse the tree coherently: one per point of
 * points[randomizations * count][4], shifted by random numbers from `hash`. `unordered` has room for as many.
 */
void aur_slice_samples_draw(const aur_slice_patch *patch, size_t randomizations, size_t count,
                            const float *points, uint64_t hash, aur_slice_sample *unordered,
                            aur_slice_sample *ordered);

/* Coplanar facets merged into convex polygons: meshes for view factors are fine subdivisions of few large
 * surfaces. */

enum { AUR_MERGED_CORNERS = 8 };

typedef struct aur_merged_facet {
    size_t count;
    double corners[AUR_MERGED_CORNERS][3];
} aur_merged_facet;

/* Covers the same area as the facets. Neighbours are merged across a complete common edge while the union is
 * convex and has few enough corners, each within a millionth of the union's extent from the plane of its
 * first facet. Facets without area are omitted. Errors: MEMORY. */
aur_result aur_merge_facets(const aur_facets *facets, size_t *count, aur_merged_facet **merged,
                            aur_error *error);

/* Error of a point set, estimated from its parts. */

/* values[count][parts]: the estimates of consecutive parts of one set, which is shifted randomly for every
 * number. Their spread is that of sets of a part's size. The whole set has a smaller error than the mean of
 * as many independent sets, because errors fall faster than the inverse root of the size. The rate of
 * convergence, size^(-rate/2), is estimated from all numbers: from the smaller variance of parts of twice the
 * size. Then each number's parts are shrunk towards their mean until their spread matches independent
 * estimates with the whole set's error: Student's interval then holds. Means are unchanged. Returns the rate
 * of variances, 1 .. 3; 1 is Monte Carlo. */
double aur_net_spread_settle(size_t count, size_t parts, double *values);
