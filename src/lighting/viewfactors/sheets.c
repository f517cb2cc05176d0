/* Back-to-back facets: the two sides of a sheet without thickness. */
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/facets.h"
#include "render/scene/overlaps.h"

/* In the file's units: its digits give the precision of coordinates. */
static void find_corners(const void *context, size_t first, size_t count, double (*corners)[3][3]) {
    const aur_facets *const facets = context;
    const double *const origin = facets->scene->origin;
    for (size_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
                corners[i][c][d] = facets->corners[first + i][c][d] + origin[d];
}

aur_result aur_facets_find_sheets(aur_facets *facets, aur_error *error) {
    const aur_triangle_source source = {facets->count, facets, find_corners, true};
    aur_overlaps overlaps;
    aur_result result = aur_overlaps_find(&source, 0, &overlaps, error);
    if (result != AUR_OK || overlaps.count == 0)
        return result;
    facets->opposite_starts = calloc(facets->count + 2, sizeof *facets->opposite_starts);
    facets->opposites = malloc(2 * overlaps.count * sizeof *facets->opposites);
    if (facets->opposite_starts != NULL && facets->opposites != NULL) {
        size_t *const next = facets->opposite_starts + 1; /* advances from each start */
        for (size_t i = 0; i < 2 * overlaps.count; ++i) {
            const aur_overlap *const pair = &overlaps.items[i / 2];
            if (pair->opposite)
                ++next[(i % 2 == 0 ? pair->first : pair->second) + 1];
        }
        for (size_t i = 0; i < facets->count; ++i)
            next[i + 1] += next[i];
        for (size_t i = 0; i < 2 * overlaps.count; ++i) {
            const aur_overlap *const pair = &overlaps.items[i / 2];
            if (pair->opposite)
                facets->opposites[next[i % 2 == 0 ? pair->first : pair->second]++] =
                    i % 2 == 0 ? pair->second : pair->first;
        }
    } else {
        result = aur_fail_memory(error);
    }
    aur_overlaps_release(&overlaps);
    return result;
}

bool aur_facets_are_sheet(const aur_facets *facets, size_t first, size_t second) {
    if (facets->opposite_starts == NULL)
        return false;
    for (size_t k = facets->opposite_starts[first]; k < facets->opposite_starts[first + 1]; ++k)
        if (facets->opposites[k] == second)
            return true;
    return false;
}

bool aur_facet_contains(const aur_facets *facets, size_t facet, const double point[3]) {
    const double(*const corners)[3] = (const double(*)[3])facets->corners[facet];
    for (int c = 0; c < 3; ++c) {
        double along[3], way[3], across[3];
        for (int d = 0; d < 3; ++d) {
            along[d] = corners[(c + 1) % 3][d] - corners[c][d];
            way[d] = point[d] - corners[c][d];
        }
        aur_cross3(along, way, across);
        if (aur_dot3(across, facets->planes[facet].normal) < 0.0)
            return false;
    }
    return facets->areas[facet] > 0.0;
}

size_t aur_facets_other_side(const aur_facets *facets, size_t facet, const double point[3]) {
    for (size_t k = facets->opposite_starts[facet]; k < facets->opposite_starts[facet + 1]; ++k)
        if (aur_facet_contains(facets, facets->opposites[k], point))
            return facets->opposites[k];
    return SIZE_MAX;
}
