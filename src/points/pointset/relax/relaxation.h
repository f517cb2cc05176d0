/* What the two blue-noise sets share: wrapped differences, a grid of sites, and a cache of results. */
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

/* Sites by cell of a square grid with about one site a cell: sites[start[c]] .. sites[start[c + 1] - 1] are
 * those of cell c = row * side + column, in ascending order. */
typedef struct aur_site_grid {
    size_t side;
    uint32_t *start; /* side^2 + 2 */
    uint32_t *sites;
} aur_site_grid;

bool aur_site_grid_create(aur_site_grid *grid, size_t count); /* false: out of memory */
void aur_site_grid_destroy(aur_site_grid *grid);
void aur_site_grid_fill(aur_site_grid *grid, size_t count, const aur_point2 *sites);

/* How points are relaxed: kind->own of a set whose prepare() is aur_prepare_relaxed. */
typedef struct aur_relaxation {
    unsigned version; /* changes whenever the points do */
    /* Writes `count` points or fails. */
    aur_result (*relax)(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error);
} aur_relaxation;

/* Makes set->data a table of the points that are computed from the seed, or takes it from what an earlier
 * call has kept (points/base/cache_file.h). */
aur_result aur_prepare_relaxed(aur_pointset *set, aur_parameters *keys, aur_error *error);
