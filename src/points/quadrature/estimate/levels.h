/* Levels of independent randomisations, put together: the one way in which estimates to an error come about
 * (aur_estimate, irradiance). Level after level has more points, all of its own. The variance of a level
 * falls with its size n as n^-1, where points are as good as random, to n^-2; levels are weighed by n^1.5,
 * which costs little at either end, and not by what they say, so that the mean has no bias. */
#pragma once

#include <aureole/statistics.h>

#include "points/base/error.h"

typedef struct aur_levels {
    size_t replicates, values;
    double weight;
    double *sums; /* replicates * values, the caller's; 0 in the beginning */
} aur_levels;

/* Adds one level: values of each replicate, found by `points` points. */
AUR_INTERNAL void aur_levels_add(aur_levels *levels, size_t points, const double *values);

/* The moments of value `index` over the randomisations. */
AUR_INTERNAL aur_moments aur_levels_moments(const aur_levels *levels, size_t index);
