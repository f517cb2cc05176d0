/* How much of the sky patches see, by half planes: what hides the sky in one is the union of segments, so
 * that only the places of a patch and the azimuths of the half planes are sampled. */
#pragma once

#include "lighting/viewfactors/facet_rays.h"
#include "points/base/parallel.h"

typedef struct aur_sky_slices aur_sky_slices;

/* `count` half planes for each patch and randomisation. The randomisations are the parts of one set of
 * points, which is shifted at random for every patch. Errors: those of aur_facet_points, MEMORY. */
aur_result aur_sky_slices_create(const aur_facets *facets, const char *set, size_t count,
                                 size_t randomizations, uint64_t seed, aur_sky_slices **slices,
                                 aur_error *error);
void aur_sky_slices_destroy(aur_sky_slices *slices); /* NULL is allowed */

/* sky[patch_count][randomizations]: the part of the view that is the sky; 0 for patches without area. The
 * randomisations spread as independent ones whose mean errs as the whole set does (net_spread.h). Errors:
 * CANCELLED, MEMORY. */
aur_result aur_sky_slices_measure(const aur_sky_slices *slices, const aur_parallel_options *parallel,
                                  double *sky, aur_error *error);
