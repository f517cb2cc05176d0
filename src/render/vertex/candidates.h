/* Resampled importance sampling of direct light (Talbot, Cline and Egbert 2005): of several points on lights
 * one is kept, in proportion to what each would bring if nothing lay between, and gets the shadow ray. What
 * it brings, times (sum of all) / (count * its own), has the mean of what one point brings, whatever lies
 * between.
 *
 * The points are those of one bounce's numbers, shifted modulo 1: each alone is distributed as the first, so
 * that the mean holds though they hang together, and together they are spread more evenly than by chance. */
#pragma once

#include <stdbool.h>

#include "points/base/vector.h"

enum { AUR_CANDIDATES_MOST = 64 };

/* How far candidate `index` of `count` is shifted, in [0,1): the choice of a light by equal steps, the point
 * on it by those of the R2 sequence (Roberts 2018). */
static inline void aur_candidate_shift(uint32_t index, uint32_t count, float shift[3]) {
    const double u = 0.7548776662466927 * index, v = 0.5698402909980532 * index;
    shift[0] = (float)index / (float)count;
    shift[1] = (float)(u - (uint32_t)u);
    shift[2] = (float)(v - (uint32_t)v);
}

/* `number` shifted, both in [0,1). A sum that rounding makes 1 becomes 0, and less than 2 stays less than 1.
 */
static inline float aur_candidate_number(float number, float shift) {
    const float sum = number + shift;
    return sum < 1.0f ? sum : sum - 1.0f;
}

/* What chooses among candidates: R, G and B alike. Nothing (0) for what is no number. */
static inline float aur_candidate_weight(aur_vector light) {
    const float sum = light.x + light.y + light.z;
    return sum > 0.0f ? sum : 0.0f;
}

/* Whether a candidate takes the place of the one that was kept, by a number in [0,1), of which only what the
 * answer leaves undecided is left (Chao 1982). `total`: the weights so far. One of weight 0 never does, the
 * first other one always. */
static inline bool aur_candidate_wins(float weight, float *total, float *number) {
    *total += weight;
    const float share = weight / (*total > 0.0f ? *total : 1.0f);
    const bool wins = *number < share;
    const float rest = (wins ? *number : *number - share) / (wins ? share : 1.0f - share);
    /* The difference and 1 - share may round to the same number. */
    *number = aur_smaller(rest, 0x1.fffffep-1f);
    return wins;
}

/* By what the light of the one that was kept is multiplied; its weight is `own`, above 0. */
static inline float aur_candidate_scale(uint32_t count, float total, float own) {
    return total / ((float)count * own);
}
