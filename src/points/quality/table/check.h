/* Checks whether a measure, its points and its options are compatible. */
#pragma once

#include "points/quality/measure.h"

/* Coordinates of a point of the domain; 0: any. */
size_t aur_domain_dimension(aur_domain domain);

/* A cap that is the whole domain becomes that domain, without cap_degrees. */
aur_result aur_measure_check(const aur_measure_row *row, aur_points_view *points,
                             aur_measure_options *options, aur_error *error);

static inline double aur_square_length(size_t dimension, const double *x) {
    double square = 0.0;
    for (size_t d = 0; d < dimension; ++d)
        square += x[d] * x[d];
    return square;
}
