/* Voronoi cells on the sphere or, cut at the equator, on the hemisphere, or at its rim, on a cap. */
#pragma once

#include "points/quality/measure.h"

typedef struct aur_voronoi_cell {
    double area;   /* steradians; points in one place share their cell */
    double radius; /* the angle to the farthest place of the cell */
    size_t sides; /* along the rim of a cap an arc is one; a cell may be a lune, a hemisphere or the sphere */
} aur_voronoi_cell;

/* The cells of all points in the request's memory; no bit depends on the number of threads. Errors: MEMORY;
 * UNSUPPORTED where a cap wider than 90 degrees has a cell of fewer than three sides. */
aur_result aur_voronoi_cells(const aur_measure_request *request, aur_voronoi_cell **cells, aur_error *error);

enum { AUR_CORNER_COLUMNS = 4 };

/* The corners of the cells of the first `count` points, which have three sides or more, counter-clockwise as
 * seen from outside: a row each of the point's number from 1 and a unit vector, cell after cell, as many as
 * the sum of their sides. Not on caps. */
aur_result aur_voronoi_corners(const aur_measure_request *request, size_t count,
                               const aur_voronoi_cell *cells, double *rows, aur_error *error);
