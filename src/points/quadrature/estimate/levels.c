#include "points/quadrature/estimate/levels.h"

#include <math.h>

void aur_levels_add(aur_levels *levels, size_t points, const double *values) {
    const double weight = (double)points * sqrt((double)points);
    levels->weight += weight;
    for (size_t i = 0; i < levels->replicates * levels->values; ++i)
        levels->sums[i] += weight * values[i];
}

aur_moments aur_levels_moments(const aur_levels *levels, size_t index) {
    aur_moments moments = {0};
    for (size_t r = 0; r < levels->replicates; ++r)
        aur_moments_add(&moments, levels->sums[r * levels->values + index] / levels->weight);
    return moments;
}
