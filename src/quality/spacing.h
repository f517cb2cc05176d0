#ifndef AUR_QUALITY_SPACING_H
#define AUR_QUALITY_SPACING_H

#include "quality/measure.h"

/* The smallest Euclidean distance of two of at least two points. */
aur_result aur_smallest_distance(const aur_points *points, double *distance, aur_error *error);

#endif
