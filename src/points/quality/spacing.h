#pragma once

#include "points/quality/measure.h"

/* The smallest Euclidean distance of two of at least two points. */
aur_result aur_smallest_distance(const aur_measure_request *request, double *distance, aur_error *error);
