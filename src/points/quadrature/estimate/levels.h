/* Combination of levels of independent randomisations, for all estimates to a target error (aur_estimate,
 * irradiance). Each level has more points, independent of the others. The variance of a level falls with its
 * size n as n^-1, for random points, to n^-2. Levels have weights n^1.5, which is nearly optimal at either
 * end and independent of their values, so that the mean is unbiased. */
#pragma once

#include <aureole/statistics.h>

#include "points/base/error.h"

typedef struct aur_levels {
    size_t replicates, values;
    double weight;
    double *sums; /* replicates * values, owned by the caller; initially 0 */
} aur_levels;

/* Adds one level: values of each replicate from `points` points. */
AUR_INTERNAL void aur_levels_add(aur_levels *levels, size_t points, const double *values);

/* The moments of value `index` over the randomisations. */
AUR_INTERNAL aur_moments aur_levels_moments(const aur_levels *levels, size_t index);
