/* Points of the sphere in cells of about equal area, for finding those near a direction. */
#pragma once

#include <aureole/pointset.h>

#include "points/base/arena.h"

typedef struct aur_sphere_grid {
    const aur_points_view *points; /* not owned */
    double widest;                 /* the polar angle at which the cells end */
    double spacing;                /* the side of a cell, radians */
    size_t band_count;
    size_t *band_cells; /* band_count + 1: the first cell of each band */
    size_t *cell_start; /* the first entry of each cell in `order`, one more than there are cells */
    size_t *order;      /* indices of the points, cell by cell */
} aur_sphere_grid;

/* Of points that are no farther from +z than `widest`: pi for the whole sphere. The arena holds the grid. */
aur_result aur_sphere_grid_create(const aur_points_view *points, double widest, aur_arena *arena,
                                  aur_sphere_grid *grid, aur_error *error);

typedef struct aur_neighbour {
    double square; /* of the chord */
    size_t index;
} aur_neighbour;

typedef struct aur_neighbours {
    size_t count, capacity;
    aur_neighbour *items;
} aur_neighbours;

/* All points within `angle` of point `index` but itself, nearest first, ties by index. */
aur_result aur_sphere_grid_near(const aur_sphere_grid *grid, size_t index, double angle,
                                aur_neighbours *neighbours);
