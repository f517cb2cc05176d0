/* Voronoi cells on the sphere or, cut at the equator, on the hemisphere. */
#pragma once

#include "quality/measure.h"

typedef struct aur_voronoi_cell {
    double area;   /* steradians; points in one place share their cell */
    double radius; /* the angle to the farthest corner */
    size_t sides;
    bool unbounded; /* the cell reaches 90 degrees or more from its point: area and radius mean nothing */
} aur_voronoi_cell;

/* The cells of all points in the request's memory, and whether one is unbounded; no bit depends on the number
 * of threads. */
aur_result aur_voronoi_cells(const aur_measure_request *request, aur_voronoi_cell **cells, bool *unbounded,
                             aur_error *error);

/* The angular radius of the smallest cap that holds all points, which must lie in one hemisphere. */
double aur_smallest_cap(const aur_points_view *points);
