/* Convex polygons on the sphere, cut by one great circle after the other: cells of points, of any size up to
 * the whole sphere. Coordinates are those of a frame whose third axis is the cell's point. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* A side and its end. Each corner is computed from its two sides alone, so that no error adds up. */
typedef struct aur_cell_side {
    double normal[3]; /* of any length; the cell lies where its product with a direction is positive */
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

/* A cell without sides that takes `cuts` cuts without an allocation; false: no memory. To be released. */
bool aur_cell_begin(aur_cell *cell, size_t cuts);
void aur_cell_release(aur_cell *cell);
/* Keeps what lies on the positive side of the great circle of `normal`, which holds (0, 0, 1). Corners that
 * rounding cannot tell apart become one. */
void aur_cell_cut(aur_cell *cell, const double normal[3]);
/* Steradians. */
double aur_cell_area(const aur_cell *cell);
/* The largest angle from (0, 0, 1) to a direction of the cell. */
double aur_cell_radius(const aur_cell *cell);
