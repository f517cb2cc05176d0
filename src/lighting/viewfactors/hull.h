/* Whether anything stands between two facets: the hull of two polygons, held against all facets. */
#pragma once

#include "lighting/viewfactors/box_tree.h"
#include "lighting/viewfactors/facets.h"

enum { AUR_HULL_CORNERS = 4, AUR_HULL_PLANES = 2 + 4 * AUR_HULL_CORNERS * AUR_HULL_CORNERS };

/* The hull of two polygons, each of at most four corners and in front of the other's plane: where all light
 * between them is. Everything in it is in front of all planes. */
typedef struct aur_hull {
    size_t counts[2]; /* corners of each polygon, those of the first one first */
    size_t corner_count, plane_count;
    double corners[2 * AUR_HULL_CORNERS][3];
    double lower[3], upper[3];
    aur_plane planes[AUR_HULL_PLANES]; /* the first two are those of the polygons */
    double tight;                      /* rounding of heights in double precision */
    double slack; /* to which files know positions, by the hull's size and by its thickness */
} aur_hull;

void aur_hull_make(const aur_plane planes[2], const size_t counts[2], double (*const polygons[2])[3],
                   aur_hull *hull);

/* Whether certainly no facet but the given two crosses the hull. A facet is outside when a plane of the hull
 * or its own plane separates the two. Facets that reach into the hull by no more than the slack touch it,
 * unless they cover a part of one of the polygons. So "false" may be wrong, and "true" is not, but for edges
 * that are lower than the slack. */
bool aur_hull_is_empty(const aur_hull *hull, const aur_facets *facets, const aur_box_tree *tree,
                       const size_t facet[2]);
