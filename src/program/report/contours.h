/* Contours of values on a grid. */
#pragma once

#include "program/report/figure.h"

typedef struct report_contours {
    size_t across, up;
    const double *values;   /* [up][across], at the middles of cells, from the lowest row; NaN: none */
    double low[2], step[2]; /* the middle of the first cell, and the distance of two */
    size_t count, capacity;
    report_point *segments; /* pairs of ends; from malloc */
} report_contours;

/* Adds lines at round values between 0 and `high`, more of them than a scale of a third of `side` pixels has
 * marks. False: out of memory. */
bool report_find_contours(double high, double side, report_contours *contours);
