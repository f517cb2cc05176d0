/* Resampled importance sampling of direct light (Talbot, Cline and Egbert 2005): of several light samples one
 * is selected in proportion to its unoccluded contribution, and gets the shadow ray. Its contribution times
 * (sum of all weights) / (count * its weight) has the same mean as that of a single light sample, for any
 * visibility.
 *
 * The candidates use the random numbers of one bounce, shifted modulo 1. Each is distributed as the first, so
 * the mean is right although they are correlated, and together they are stratified better than random ones.
 */
#pragma once

#include <stdbool.h>

#include "points/base/vector.h"

enum { AUR_CANDIDATES_MOST = 64 };

/* The shift of candidate `index` of `count`, in [0,1): equal steps for the choice of a light, the R2 sequence
 * (Roberts 2018) for the point on it. */
static inline void aur_candidate_shift(uint32_t index, uint32_t count, float shift[3]) {
    const double u = 0.7548776662466927 * index, v = 0.5698402909980532 * index;
    shift[0] = (float)index / (float)count;
    shift[1] = (float)(u - (uint32_t)u);
    shift[2] = (float)(v - (uint32_t)v);
}

/* `number` plus `shift` modulo 1, both in [0,1). A sum that rounds to 1 becomes 0; one below 2 gives a result
 * below 1. */
static inline float aur_candidate_number(float number, float shift) {
    const float sum = number + shift;
    return sum < 1.0f ? sum : sum - 1.0f;
}

/* The weight of a candidate: the sum of R, G and B; 0 for NaN and infinity. */
static inline float aur_candidate_weight(aur_vector light) {
    const float sum = light.x + light.y + light.z;
    return sum > 0.0f ? sum : 0.0f;
}

/* Whether a candidate replaces the selected one (reservoir sampling, Chao 1982). *number in [0,1) is rescaled
 * so that it can be used again. `total`: the sum of weights so far. A candidate of weight 0 never wins; the
 * first one with another weight always does. */
static inline bool aur_candidate_wins(float weight, float *total, float *number) {
    *total += weight;
    const float share = weight / (*total > 0.0f ? *total : 1.0f);
    const bool wins = *number < share;
    const float rest = (wins ? *number : *number - share) / (wins ? share : 1.0f - share);
    /* The difference and 1 - share may round to the same number. */
    *number = aur_smaller(rest, 0x1.fffffep-1f);
    return wins;
}

/* The factor for the contribution of the selected candidate, with `weight` above 0. */
static inline float aur_candidate_scale(uint32_t count, float total, float weight) {
    return total / ((float)count * weight);
}
