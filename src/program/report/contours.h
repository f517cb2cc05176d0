/* Contours of values on a grid. */
#pragma once

#include "program/report/figure.h"

typedef struct report_contours {
    size_t across, up;
    const double *values;   /* [up][across], at the centers of cells, from the lowest row; NaN: none */
    double low[2], step[2]; /* the center of the first cell, and the spacing */
    size_t count, capacity;
    report_point *segments; /* pairs of endpoints; from malloc */
} report_contours;

/* Adds lines at round values between 0 and `high`, with more levels than a scale of a third of `side` pixels
 * has ticks. False: out of memory. */
bool report_find_contours(double high, double side, report_contours *contours);
