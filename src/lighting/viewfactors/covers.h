/* Facets that lie closer to each other than rays of floats resolve, as a rug lies on a floor. Doubles decide
 * which of them a ray meets first. */
#pragma once

#include "lighting/viewfactors/facets.h"

/* How far beside a facet rays begin. */
float aur_facet_offset(const aur_facets *facets, size_t facet);

/* Lists in facets->covers what lies within that height of each facet, nearly parallel to it, before it or
 * behind it. Errors: MEMORY. */
aur_result aur_facets_find_covers(aur_facets *facets, aur_error *error);

/* The facet that a ray from a point of `facet` meets first, where floats found `met` (SIZE_MAX: none). The
 * direction is of unit length. */
size_t aur_facets_first_met(const aur_facets *facets, size_t facet, const double origin[3],
                            const double direction[3], size_t met);
