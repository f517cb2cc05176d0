/* How much of the sky patches see, by half planes: what hides the sky in one is the union of segments, so
 * that only the places of a patch and the azimuths of the half planes are sampled. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/facets.h"
#include "points/base/parallel.h"

typedef struct aur_sky_slices aur_sky_slices;

/* `count` half planes for each patch and randomisation. The randomisations are the parts of one set of
 * points, which is shifted at random for every patch. Errors: those of aur_facet_points, MEMORY. */
aur_result aur_sky_slices_create(const aur_facets *facets, const char *set, size_t count,
                                 size_t randomizations, uint64_t seed, aur_sky_slices **slices,
                                 aur_error *error);
void aur_sky_slices_destroy(aur_sky_slices *slices); /* NULL is allowed */

/* sky[patch_count][randomizations]: the part of the view that is the sky; 0 for patches without area. The
 * randomisations spread as independent ones whose mean errs as the whole set does (net_spread.c). Errors:
 * CANCELLED, MEMORY. */
aur_result aur_sky_slices_measure(const aur_sky_slices *slices, const aur_parallel_options *parallel,
                                  double *sky, aur_error *error);

/* Which half planes a patch looks along: their azimuths and where on the patch they end. */

/* A patch in turned coordinates. */
typedef struct aur_slice_patch {
    float corner[3], edge[2][3];
    float inset; /* barycentric: how far half planes end off the edges, where other facets begin */
    double ahead[2], upright; /* the normal's way, of unit length, and how much of it there is */
} aur_slice_patch;

typedef struct aur_slice_sample {
    float way[2], place[2], jitter, weight;
    uint32_t randomization, bucket;
} aur_slice_sample;

/* Samples in the order of their azimuths, so that those of a packet go through the same boxes: one for each
 * of points[randomizations * count][4], all shifted by what `hash` says. `unordered` has place for as many.
 */
void aur_slice_samples_draw(const aur_slice_patch *patch, size_t randomizations, size_t count,
                            const float *points, uint64_t hash, aur_slice_sample *unordered,
                            aur_slice_sample *ordered);

/* Facets that lie in one plane, put together to convex polygons: meshes for view factors are fine divisions
 * of few large surfaces. */

enum { AUR_MERGED_CORNERS = 8 };

typedef struct aur_merged_facet {
    size_t count;
    double corners[AUR_MERGED_CORNERS][3];
} aur_merged_facet;

/* Covers what the facets cover. Neighbours are put together across an edge that both have whole, while the
 * union is convex and has few enough corners, none of them farther from the plane of its first facet than a
 * millionth of the union's extent. Facets without area are left out. Errors: MEMORY. */
aur_result aur_merge_facets(const aur_facets *facets, size_t *count, aur_merged_facet **merged,
                            aur_error *error);

/* How much the parts of one set of points say of the error of the whole set. */

/* values[count][parts]: what each of the consecutive parts of one set, which is shifted at random for every
 * number, found. Their spread is that of sets of a part's size; the whole set errs by less than the mean of
 * as many independent ones, for errors fall faster than with the root of the size. How fast, with
 * size^(-rate/2), is taken from all numbers together: from how much less parts of twice the size vary. Then
 * each number's parts are drawn towards their mean, until they spread as independent ones whose mean errs as
 * the whole set does: Student's interval from them holds. Means stay. Returns the rate, 1 .. 3, of variances:
 * 1 is chance. */
double aur_net_spread_settle(size_t count, size_t parts, double *values);
