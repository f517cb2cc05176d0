/* Rows of patches that cover the sphere between circles of latitude: directions are drawn in proportion to
 * how bright the patches are, and within each to the values at its corners, so that the density is continuous
 * as radiance is. */
#pragma once

#include <math.h>

#include "points/base/error.h"
#include "points/base/vector.h"

/* Choosing among things in proportion to their weights. */

typedef struct aur_distribution {
    size_t count;
    double total;
    double *sums; /* count + 1: running sums, the last one `total`; behind them the guide of distribution.c */
} aur_distribution;

/* Copies the weights (>= 0, finite); a total of 0 is allowed. */
aur_result aur_distribution_create(aur_distribution *distribution, size_t count, const double *weights,
                                   aur_error *error);
void aur_distribution_release(aur_distribution *distribution);

/* The item that u in [0,1) falls on, never one of weight 0; *u becomes what is left, again in [0,1). The
 * total must not be 0. */
size_t aur_distribution_choose(const aur_distribution *distribution, float *u);
/* The same where 24 binary digits are too few for a choice and two coordinates of a point. */
size_t aur_distribution_choose_double(const aur_distribution *distribution, double *u);

/* Ask the memory for what the choice by u will read: first for the place where its search begins, then, by
 * that, for the items there. */
void aur_distribution_prefetch_guide(const aur_distribution *distribution, double u);
void aur_distribution_prefetch_items(const aur_distribution *distribution, double u);

static inline double aur_distribution_probability(const aur_distribution *distribution, size_t index) {
    return (distribution->sums[index + 1] - distribution->sums[index]) / distribution->total;
}

/* Points of the unit square drawn in proportion to what four numbers at its corners are between them (Pharr,
 * Jakob, Humphreys 2023, section A.5.3). Without branches, for loops over lanes. */

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

typedef struct aur_patches {
    size_t row_count, columns;
    aur_distribution rows;   /* by the integral of what is bright */
    aur_distribution *cells; /* [row_count], each over the columns, by what is bright */
} aur_patches;

/* radiance[row_count][columns], >= 0 and finite, and for each row how much the height, the cosine of the
 * polar angle, changes over it. Errors: MEMORY; it is to be released then too. */
aur_result aur_patches_create(aur_patches *patches, size_t row_count, size_t columns, const double *radiance,
                              const double *rises, aur_error *error);
void aur_patches_release(aur_patches *patches);

/* The patch that u (along the columns) and v (along the rows) in [0,1) fall on; they become what is left. The
 * integral must not be 0. */
void aur_patches_choose(const aur_patches *patches, float *u, float *v, size_t *column, size_t *row);

/* Moves u and v, uniform in a patch, so that what is drawn is in proportion to what the values at its corners
 * are between them; one of them is not 0. */
static inline void aur_patch_draw(const aur_bilinear *corners, float *u, float *v) {
    const float *const w = corners->corner;
    const float scale = 1.0f / (w[0] + w[1] + w[2] + w[3]);
    aur_bilinear weights; /* which squares of neither overflow, nor are 0 beside each other */
    for (size_t k = 0; k < 4; ++k)
        weights.corner[k] = aur_larger(w[k] * scale, 1e-12f);
    aur_bilinear_draw(&weights, u, v);
}

/* The integral over all directions of the radiance that was given. */
static inline double aur_patches_integral(const aur_patches *patches) {
    return patches->rows.total * 2.0 * AUR_PI / (double)patches->columns;
}

/* The density, a steradian, of directions that are drawn in proportion to what is bright: where it is
 * `value`. Within a patch it may vary, if its mean over azimuth and height there is the one that was given.
 */
static inline float aur_patches_density(const aur_patches *patches, float value) {
    return patches->rows.total > 0.0 ? (float)((double)value / aur_patches_integral(patches)) : 0.0f;
}
