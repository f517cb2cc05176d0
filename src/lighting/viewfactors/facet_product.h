/* y = F x along rays, of the rows of facets. */
#pragma once

#include "lighting/viewfactors/facet_rays.h"
#include "points/base/parallel.h"

/* The mean over `count` randomisations of the pattern from `first` on; what each ray meets brings home its x.
 * `sky` (may be NULL) is the part that leaves the scene. With `sun` (may be NULL; not 0), y is instead the
 * irradiance of light from that direction, whose length is the irradiance of what faces it; x is not used.
 * Errors: CANCELLED, MEMORY. */
aur_result aur_facet_product(const aur_facets *facets, const aur_facet_pattern *pattern, size_t first,
                             size_t count, const aur_parallel_options *parallel, const double *sun,
                             const double *x, double *y, double *sky, aur_error *error);
