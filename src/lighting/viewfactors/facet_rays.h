/* Rays from facets: one pattern of origins and directions, shifted randomly for every facet and
 * randomisation. */
#pragma once

#include "lighting/viewfactors/facets.h"
#include "points/base/parallel.h"

/* Targets of a ray that are not patches. */
#define AUR_TARGET_SKY UINT32_MAX
#define AUR_TARGET_BACK (UINT32_MAX - 1)

/* Points of the four-dimensional unit cube. Adjacent points have similar directions, so that the rays of a
 * packet are coherent. */
typedef struct aur_facet_pattern {
    size_t count;
    uint64_t seed;
    float *origins[2]; /* coordinates of the origins */
    float *squared;    /* squared sine of the direction to the normal */
    float *around[2];  /* cosine and sine of the angle about the normal */
} aur_facet_pattern;

/* points[count][4] of SET, scrambled if supported. Errors: those of aur_pointset_create; UNSUPPORTED for
 * fewer than 4 dimensions. */
aur_result aur_facet_points(const char *set, size_t count, uint64_t seed, double *points, aur_error *error);

/* Barycentric: distance of ray origins from a facet's edges, where other facets begin. */
float aur_facet_inset(const aur_facets *facets, size_t facet);

/* `count` points of SET. Errors: those of aur_pointset_create; UNSUPPORTED for fewer than 4 dimensions. */
aur_result aur_facet_pattern_create(const char *set, size_t count, uint64_t seed, aur_facet_pattern *pattern,
                                    aur_error *error);
void aur_facet_pattern_release(aur_facet_pattern *pattern);

/* Traces the rays of one randomisation of the pattern from a patch that has an area, cosine-distributed about
 * its normal, from uniformly distributed origins. targets[pattern->count] receives the hits. With `along`
 * (else NULL; nonzero) all rays have that direction. */
void aur_facet_trace(const aur_facets *facets, const aur_facet_pattern *pattern, size_t patch,
                     uint64_t randomization, const double *along, uint32_t *targets);

/* y = F x along rays, for the rows of facets. */

/* The mean over `count` randomisations of the pattern from `first` on; each ray collects the x of its hit.
 * `sky` (may be NULL) is the fraction that leaves the scene. With `sun` (may be NULL; nonzero), y is instead
 * the irradiance by light from that direction; its length is the irradiance on a plane facing it; x is
 * unused. Errors: CANCELLED, MEMORY. */
aur_result aur_facet_product(const aur_facets *facets, const aur_facet_pattern *pattern, size_t first,
                             size_t count, const aur_parallel_options *parallel, const double *sun,
                             const double *x, double *y, double *sky, aur_error *error);
