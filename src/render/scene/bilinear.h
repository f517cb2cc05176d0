/* Points of the unit square drawn in proportion to what four numbers at its corners are between them (Pharr,
 * Jakob, Humphreys 2023, section A.5.3). Without branches, for loops over lanes. */
#pragma once

#include <math.h>

/* At (0,0), (1,0), (0,1) and (1,1). */
typedef struct aur_bilinear {
    float corner[4];
} aur_bilinear;

/* In [0,1], in proportion to a line from `first` to `last`, which are positive. Of equal ones it is u. */
static inline float aur_line_draw(float first, float last, float u) {
    return u * (first + last) / (first + sqrtf(first * first + u * (last * last - first * first)));
}

/* Moves uniform u, v. */
static inline void aur_bilinear_draw(const aur_bilinear *weights, float *u, float *v) {
    const float *const w = weights->corner;
    *v = aur_line_draw(w[0] + w[1], w[2] + w[3], *v);
    *u = aur_line_draw(w[0] + *v * (w[2] - w[0]), w[1] + *v * (w[3] - w[1]), *u);
}

static inline float aur_bilinear_value(const aur_bilinear *weights, float u, float v) {
    const float *const w = weights->corner;
    const float low = w[0] + u * (w[1] - w[0]), high = w[2] + u * (w[3] - w[2]);
    return low + v * (high - low);
}

/* With which points are drawn; 1 in the mean. */
static inline float aur_bilinear_density(const aur_bilinear *weights, float u, float v) {
    const float *const w = weights->corner;
    return 4.0f * aur_bilinear_value(weights, u, v) / ((w[0] + w[1]) + (w[2] + w[3]));
}
