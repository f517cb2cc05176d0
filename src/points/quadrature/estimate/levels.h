/* Combination of levels of independent randomisations, for all estimates to a target error (aur_estimate,
 * irradiance). Each level has more points, independent of the others. The variance of a level falls with its
 * size n as n^-1, for random points, to n^-2. Levels have weights n^1.5, which is nearly optimal at either
 * end and independent of their values, so that the mean is unbiased. */
#pragma once

#include <aureole/statistics.h>
#include <math.h>

typedef struct aur_levels {
    size_t replicates, values;
    double weight;
    double *sums; /* replicates * values, owned by the caller; initially 0 */
} aur_levels;

/* Adds one level: values of each replicate from `points` points. */
static inline void aur_levels_add(aur_levels *levels, size_t points, const double *values) {
    const double weight = (double)points * sqrt((double)points);
    levels->weight += weight;
    for (size_t i = 0; i < levels->replicates * levels->values; ++i)
        levels->sums[i] += weight * values[i];
}

/* The moments of value `index` over the randomisations. */
static inline aur_moments aur_levels_moments(const aur_levels *levels, size_t index) {
    aur_moments moments = {0};
    for (size_t r = 0; r < levels->replicates; ++r)
        aur_moments_add(&moments, levels->sums[r * levels->values + index] / levels->weight);
    return moments;
}
