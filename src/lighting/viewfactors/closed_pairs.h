/* Pairs of patches that certainly see each other wholly, with the contour integral. */
#pragma once

#include "lighting/viewfactors/visits.h"

/* Of one patch, the pairs with those that come after it in the order of rows and patches. */
typedef struct aur_closed_row {
    size_t count;
    uint32_t *patches; /* ascending */
    double *exchanges; /* area times factor */
} aur_closed_row;

typedef struct aur_closed_pairs {
    size_t patch_count;
    aur_closed_row *rows;
} aur_closed_pairs;

/* Whether the pair is kept with patch i: each pair is kept once, and where its matrix entry is counted. */
static inline bool aur_pair_stands_with(const aur_facets *facets, size_t i, size_t k) {
    const size_t a = aur_facets_row(facets, i), b = aur_facets_row(facets, k);
    return a < b || (a == b && i < k);
}

/* All pairs of small meshes, else the pairs that some ray has found and whose exchange is so large that rays
 * find them all but certainly: what is not looked at can then be counted along rays without bias. Errors:
 * CANCELLED, MEMORY. */
aur_result aur_closed_pairs_find(const aur_facets *facets, const aur_visits *visits,
                                 const aur_parallel_options *parallel, aur_closed_pairs *pairs,
                                 aur_error *error);
void aur_closed_pairs_release(aur_closed_pairs *pairs);
