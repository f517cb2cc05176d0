/* Pairs of patches that are certainly unoccluded, evaluated by the contour integral. */
#pragma once

#include <stddef.h>

#include "lighting/viewfactors/covers.h"
#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/facets.h"
#include "points/base/parallel.h"

/* Ray hits of all patches, counted for each randomisation. */

/* The patches hit by the rays of one patch. */
typedef struct aur_ray_hits_row {
    size_t count;
    uint32_t *patches; /* ascending */
    uint16_t *hits;    /* [count][randomizations] */
} aur_ray_hits_row;

typedef struct aur_ray_hits {
    size_t patch_count, randomizations;
    size_t rays; /* of one randomisation */
    aur_ray_hits_row *rows;
    double *sky, *back; /* [patch_count][randomizations], in rays */
    /* The patches that hit a patch: sources[starts[i]] .. sources[starts[i + 1] - 1]; places[...] are its
     * indices in their lists. */
    size_t *starts;
    uint32_t *sources, *hit_indices;
} aur_ray_hits;

/* Errors: CANCELLED, MEMORY. */
aur_result aur_ray_hits_trace(const aur_facets *facets, const aur_facet_pattern *pattern,
                              size_t randomizations, const aur_parallel_options *parallel,
                              aur_ray_hits *ray_hits, aur_error *error);
void aur_ray_hits_release(aur_ray_hits *ray_hits);

/* The closed pairs of one patch with those that come after it in the order of rows and patches. */
typedef struct aur_closed_row {
    size_t count;
    uint32_t *patches; /* ascending */
    double *exchanges; /* area times factor */
} aur_closed_row;

typedef struct aur_closed_pairs {
    size_t patch_count;
    aur_closed_row *rows;
} aur_closed_pairs;

/* Whether the pair is stored with patch i: each pair is stored once, with the patch whose matrix entry counts
 * it. */
static inline bool aur_pair_stands_with(const aur_facets *facets, size_t i, size_t k) {
    const size_t a = aur_facets_row(facets, i), b = aur_facets_row(facets, k);
    return a < b || (a == b && i < k);
}

/* Tests all pairs of small meshes; else the pairs that a ray has found and whose exchange is so large that
 * rays find them almost certainly. Untested pairs can then be counted along rays without bias. Errors:
 * CANCELLED, MEMORY. */
aur_result aur_closed_pairs_find(const aur_facets *facets, const aur_ray_hits *ray_hits,
                                 const aur_parallel_options *parallel, aur_closed_pairs *pairs,
                                 aur_error *error);
void aur_closed_pairs_release(aur_closed_pairs *pairs);

/* Occlusion between two facets: the convex hull of two polygons is tested against all facets. */

enum { AUR_HULL_CORNERS = 4, AUR_HULL_PLANES = 2 + 4 * AUR_HULL_CORNERS * AUR_HULL_CORNERS };

/* The hull of two polygons with at most four corners each, each in front of the other's plane. It contains
 * all light paths between them. The hull is in front of all planes. */
typedef struct aur_hull {
    size_t counts[2]; /* corners of each polygon, those of the first one first */
    size_t corner_count, plane_count;
    double corners[2 * AUR_HULL_CORNERS][3];
    double lower[3], upper[3];
    aur_plane planes[AUR_HULL_PLANES]; /* the first two are the planes of the polygons */
    double tight;                      /* rounding error of heights in double precision */
    double slack; /* precision of coordinates in files, by the hull's size and by its thickness */
} aur_hull;

void aur_hull_make(const aur_plane planes[2], const size_t counts[2], double (*const polygons[2])[3],
                   aur_hull *hull);

/* Whether certainly no facet except the given two intersects the hull. A facet is outside if a plane of the
 * hull or the facet's plane separates the two. Facets that enter the hull by at most the slack only touch it,
 * unless they cover a part of a polygon. "False" may be wrong; "true" is not, except for edges lower than the
 * slack. */
bool aur_hull_is_empty(const aur_hull *hull, const aur_facets *facets, const aur_box_tree *tree,
                       const size_t facet[2]);

/* Light past the edges of narrow gaps, which no ray finds. */

/* Handles a patch whose rays hit only patches with closed forms, if these do not account for all of its
 * light, as in a narrow gap between two plates. The rest is distributed to the other patches in front of it,
 * in proportion to their unoccluded factors, and to the sky unless the mesh is closed. Each such factor is
 * smaller than rays can find. Errors: MEMORY. */
aur_result aur_unseen_pairs_fill(const aur_facets *facets, aur_ray_hits *ray_hits, aur_closed_pairs *pairs,
                                 aur_error *error);

/* Exchange of light between two mutually visible polygons, by integrals along their edges. */

/* Area of the first times its view factor to the second:
 *
 * A1 F12 = 1/(2 pi) sum over edges e of 1 and f of 2 of dot(e, f) times the integral of ln r along both
 *
 * (Moon 1936; Sparrow 1963). The polygons may touch, share edges or corners, or be far apart. Each must lie
 * in front of the other's plane, without occluders in between. The inner integral has a closed form; the
 * outer one uses Gauss quadrature on intervals graded towards singularities. Twelve digits. */
double aur_contour_exchange(size_t first_count, const double (*first)[3], size_t second_count,
                            const double (*second)[3]);
