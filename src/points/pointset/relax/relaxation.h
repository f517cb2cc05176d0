/* Common code of the two blue-noise sets: wrapped differences, a grid of sites, and a cache of results. */
#pragma once

#include "points/pointset/set.h"

typedef struct aur_point2 {
    double x, y;
} aur_point2;

/* The representative in [-1/2, 1/2) of a difference of two coordinates in [0,1). */
static inline double aur_wrap(double difference) {
    if (difference >= 0.5)
        return difference - 1.0;
    return difference < -0.5 ? difference + 1.0 : difference;
}

static inline aur_point2 aur_wrapped_difference(aur_point2 a, aur_point2 b) {
    return (aur_point2){aur_wrap(a.x - b.x), aur_wrap(a.y - b.y)};
}

/* The representative in [0,1) of a coordinate in [-1, 2). */
static inline double aur_unwrap(double x) {
    if (x < 0.0)
        x += 1.0;
    if (x >= 1.0)
        x -= 1.0;
    return x >= 0.0 && x < 1.0 ? x : 0.0;
}

/* Sites by cell of a square grid with about one site per cell: sites[start[c]] .. sites[start[c + 1] - 1] are
 * those of cell c = row * side + column, in ascending order. */
typedef struct aur_site_grid {
    size_t side;
    uint32_t *start; /* side^2 + 2 */
    uint32_t *sites;
} aur_site_grid;

bool aur_site_grid_create(aur_site_grid *grid, size_t count); /* false: out of memory */
void aur_site_grid_destroy(aur_site_grid *grid);
void aur_site_grid_fill(aur_site_grid *grid, size_t count, const aur_point2 *sites);

/* Parameters of a relaxation: kind->kind_data of a set whose prepare() is aur_prepare_relaxed. */
typedef struct aur_relaxation {
    unsigned version; /* changes with the points */
    /* Writes `count` points. */
    aur_result (*relax)(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error);
} aur_relaxation;

/* Fills set->data with the points computed from the seed, or takes them from the cache of an earlier call
 * (points/base/file.h). */
aur_result aur_prepare_relaxed(aur_pointset *set, aur_parameters *keys, aur_error *error);

/* Blue noise by optimal transport on the torus. */

/* Points with cells of equal area, each near the centre of its cell, in random order. In each round all
 * points move to the centres: few rounds leave the points irregular, many give crystals. A round takes O(n)
 * time. Errors: MEMORY. */
aur_result aur_transport_relax(uint64_t seed, unsigned rounds, size_t count, aur_point2 *sites,
                               aur_error *error);

/* Power diagrams of weighted sites on the torus [0,1)^2: the cell of a site is the set of points where |x -
 * site|^2 - weight is minimal. */

enum { AUR_POWER_EDGES = 24 }; /* more edges than any cell has here; further ones are not recorded */

typedef struct aur_power_cell {
    double area;
    aur_point2 centre; /* of mass, from the site */
    size_t edge_count;
    uint32_t neighbours[AUR_POWER_EDGES]; /* the site across each edge; the site itself for an image of it */
    double slopes[AUR_POWER_EDGES];       /* derivative of the area by the difference of weights: length / (2
                                             distance) */
} aur_power_cell;

typedef struct aur_power_diagram {
    size_t count;
    const aur_point2 *sites;
    const double *weights;
    aur_site_grid grid; /* filled with the sites */
    aur_power_cell *cells;
    bool warm; /* the cells are those of similar sites and weights: a starting point */
} aur_power_diagram;

/* Computes all cells; they are independent of each other and of the number of threads. */
void aur_power_diagram_compute(aur_power_diagram *diagram);
