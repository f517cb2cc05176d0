/* Facets that lie in one plane, put together to convex polygons: meshes for view factors are fine divisions
 * of few large surfaces. */
#pragma once

#include "lighting/viewfactors/facets.h"

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
