/* Voronoi cells on the sphere or, cut at the equator, on the hemisphere, or at its rim, on a cap. */
#pragma once

#include <aureole/pointset.h>
#include <stdbool.h>
#include <stddef.h>

#include "points/base/array.h"
#include "points/quality/measure.h"
#include "points/quality/pairs/pair_sum.h"

typedef struct aur_voronoi_cell {
    double area;   /* steradians; coincident points share their cell */
    double radius; /* the angle to the farthest point of the cell */
    size_t sides;  /* an arc of a cap's rim counts as one; a cell may be a lune, a hemisphere or the sphere */
} aur_voronoi_cell;

/* The cells of all points in the request's memory; bit-identical for any number of threads. Errors: MEMORY;
 * UNSUPPORTED if a cap wider than 90 degrees has a cell of fewer than three sides. */
aur_result aur_voronoi_cells(const aur_measure_request *request, aur_voronoi_cell **cells, aur_error *error);

enum { AUR_CORNER_COLUMNS = 4 };

/* The corners of the cells of the first `count` points, which have three sides or more, counter-clockwise as
 * seen from outside: one row per corner with the point's number from 1 and a unit vector, cell after cell.
 * Not on caps. */
aur_result aur_voronoi_corners(const aur_measure_request *request, size_t count,
                               const aur_voronoi_cell *cells, double *rows, aur_error *error);

/* Suprema over spherical caps of |mass inside - area|. */

typedef struct aur_height {
    double height, mass;
} aur_height;

/* The best value of closed caps about one centre: the greatest mass inside less area, over all heights.
 * `room` has space for count of them. */
double aur_cap_best_about(const aur_axes *axes, const double centre[3], aur_height *room);

/* The part of a Voronoi cell that lies within a cap about +z. */

typedef struct aur_rim {
    double cosine, sine; /* of the cap's polar angle */
    double height;       /* 1 - cosine, without cancellation */
} aur_rim;

/* Degrees above 0 and below 180. */
aur_rim aur_rim_at(double degrees);

typedef struct aur_cap_part {
    double area;   /* steradians */
    double radius; /* the largest angle from the point to a point of the part */
    size_t sides;  /* of great circles and arcs of the rim */
} aur_cap_part;

/* `corners`, unit vectors, of a convex polygon of three or more, counter-clockwise as seen from outside,
 * about the unit vector `point`, which lies within the cap. */
aur_cap_part aur_cap_part_of(const aur_rim *rim, const double point[3], size_t count,
                             const double (*corners)[3]);

/* Convex polygons on the sphere, cut by great circles: cells of points, of any size up to the whole sphere.
 * Coordinates are those of a frame whose third axis is the cell's point. */

/* A side and its end. Each corner is computed only from its two sides, so that errors do not accumulate. */
typedef struct aur_cell_side {
    double normal[3]; /* of any length; its product with directions of the cell is positive */
    double length;    /* of the normal */
    double corner[3]; /* unit: between this side and the next one, counter-clockwise as seen from outside */
    double reach;     /* of the corner: the sine of its angle from (0, 0, 1) */
    double slack;     /* rounding of the corner, in units of DBL_EPSILON */
} aur_cell_side;

/* One side is a hemisphere, two are a lune whose corners are opposite each other, none the whole sphere. */
typedef struct aur_cell {
    size_t count, capacity;
    aur_cell_side *sides;
    double *heights; /* room of `capacity` values */
} aur_cell;

/* A cell without sides that takes `cuts` cuts without an allocation; false: out of memory. Release it. */
bool aur_cell_begin(aur_cell *cell, size_t cuts);
void aur_cell_release(aur_cell *cell);
/* Cuts to the positive side of the great circle of `normal`, which contains (0, 0, 1). Corners that rounding
 * cannot distinguish are merged. */
void aur_cell_cut(aur_cell *cell, const double normal[3]);
/* Steradians. */
double aur_cell_area(const aur_cell *cell);
/* The largest angle from (0, 0, 1) to a direction of the cell. */
double aur_cell_radius(const aur_cell *cell);

/* Points of the sphere in cells of about equal area, for finding those near a direction. */

typedef struct aur_sphere_grid {
    const aur_points_view *points; /* not owned */
    double widest;                 /* the polar angle at which the cells end */
    double spacing;                /* the side of a cell, radians */
    size_t band_count;
    size_t *band_cells; /* band_count + 1: the first cell of each band */
    size_t *cell_start; /* the first entry of each cell in `order`, one more than there are cells */
    size_t *order;      /* indices of the points, cell by cell */
} aur_sphere_grid;

/* A grid of points no farther from +z than `widest`: pi for the whole sphere. The arena owns the grid. */
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

/* All other points within `angle` of point `index`, nearest first, ties by index. */
aur_result aur_sphere_grid_near(const aur_sphere_grid *grid, size_t index, double angle,
                                aur_neighbours *neighbours);
