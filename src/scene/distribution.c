#include "scene/distribution.h"

#include <stdlib.h>

aur_result aur_distribution_create(aur_distribution *distribution, size_t count, const double *weights,
                                   aur_error *error) {
    distribution->count = count;
    distribution->sums = malloc((count + 1) * sizeof *distribution->sums);
    if (distribution->sums == NULL)
        return aur_fail_memory(error);
    distribution->sums[0] = 0.0;
    for (size_t i = 0; i < count; ++i)
        distribution->sums[i + 1] = distribution->sums[i] + weights[i];
    distribution->total = distribution->sums[count];
    return AUR_OK;
}

void aur_distribution_release(aur_distribution *distribution) {
    free(distribution->sums);
    *distribution = (aur_distribution){0};
}

size_t aur_distribution_choose_double(const aur_distribution *distribution, double *u) {
    if (distribution->count == 1)
        return 0;
    const double target = *u * distribution->total;
    size_t low = 0;
    size_t high = distribution->count;
    /* Where the weights are nearly alike, the item is the first one that is tried. */
    const double guess = *u * (double)high;
    const size_t tried = guess < (double)high ? (size_t)guess : high - 1;
    if (distribution->sums[tried] > target) {
        high = tried;
    } else {
        low = tried;
        if (distribution->sums[tried + 1] > target)
            high = tried + 1;
    }
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (distribution->sums[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    /* Rounding may lead beyond the last item whose weight is not 0. */
    while (low > 0 && distribution->sums[low + 1] <= distribution->sums[low])
        --low;
    const double width = distribution->sums[low + 1] - distribution->sums[low];
    const double rest = (target - distribution->sums[low]) / width;
    *u = rest < 0.0 ? 0.0 : rest < 1.0 ? rest : 0x1.fffffffffffffp-1;
    return low;
}

size_t aur_distribution_choose(const aur_distribution *distribution, float *u) {
    double rest = *u;
    const size_t chosen = aur_distribution_choose_double(distribution, &rest);
    *u = (float)rest < 0x1.fffffep-1f ? (float)rest : 0x1.fffffep-1f;
    return chosen;
}
