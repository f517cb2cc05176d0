/* Rows of patches that cover the sphere between circles of latitude. Directions are sampled in proportion to
 * the patches' brightness, and within a patch by bilinear interpolation of its corner values, so that the pdf
 * is continuous. */
#pragma once

#include <math.h>

#include "points/base/error.h"
#include "points/base/vector.h"

/* A discrete distribution. */

typedef struct aur_distribution {
    size_t count;
    double total;
    double *sums; /* count + 1 running sums, the last one `total`, then the guide table of distribution.c */
} aur_distribution;

/* Copies the weights (>= 0, finite); a total of 0 is allowed. */
aur_result aur_distribution_create(aur_distribution *distribution, size_t count, const double *weights,
                                   aur_error *error);
void aur_distribution_release(aur_distribution *distribution);

/* The item selected by u in [0,1), never one of weight 0; *u becomes the remainder, again in [0,1). The total
 * must not be 0. */
size_t aur_distribution_choose(const aur_distribution *distribution, float *u);
/* The same in double precision: 24 bits are too few for a selection and two coordinates. */
size_t aur_distribution_choose_double(const aur_distribution *distribution, double *u);

/* Prefetch for the selection by u: first the guide table entry, then the items that it refers to. */
void aur_distribution_prefetch_guide(const aur_distribution *distribution, double u);
void aur_distribution_prefetch_items(const aur_distribution *distribution, double u);

static inline double aur_distribution_probability(const aur_distribution *distribution, size_t index) {
    return (distribution->sums[index + 1] - distribution->sums[index]) / distribution->total;
}

/* Sampling of the unit square in proportion to the bilinear interpolation of four corner values (Pharr,
 * Jakob, Humphreys 2023, section A.5.3). Branch-free, for loops over lanes. */

/* At (0,0), (1,0), (0,1) and (1,1). */
typedef struct aur_bilinear {
    float corner[4];
} aur_bilinear;

/* Samples [0,1] by a linear density from `first` to `last`, which are positive; returns u if they are equal.
 */
static inline float aur_line_draw(float first, float last, float u) {
    return u * (first + last) / (first + sqrtf(first * first + u * (last * last - first * first)));
}

/* Warps uniform u, v. */
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

/* The pdf; its mean is 1. */
static inline float aur_bilinear_density(const aur_bilinear *weights, float u, float v) {
    const float *const w = weights->corner;
    return 4.0f * aur_bilinear_value(weights, u, v) / ((w[0] + w[1]) + (w[2] + w[3]));
}

typedef struct aur_patches {
    size_t row_count, columns;
    aur_distribution rows;   /* by integrals of luminance */
    aur_distribution *cells; /* [row_count], each over the columns, by luminance */
} aur_patches;

/* radiance[row_count][columns], >= 0 and finite, and for each row the difference of heights (cosines of polar
 * angles). Errors: MEMORY; it must be released then too. */
aur_result aur_patches_create(aur_patches *patches, size_t row_count, size_t columns, const double *radiance,
                              const double *rises, aur_error *error);
void aur_patches_release(aur_patches *patches);

/* The patch selected by u (along the columns) and v (along the rows) in [0,1), which become the remainders.
 * The integral must not be 0. */
void aur_patches_choose(const aur_patches *patches, float *u, float *v, size_t *column, size_t *row);

/* Warps u and v, uniform in a patch, to the bilinear interpolation of the corner values, not all of which are
 * 0. */
static inline void aur_patch_draw(const aur_bilinear *corners, float *u, float *v) {
    const float *const w = corners->corner;
    const float scale = 1.0f / (w[0] + w[1] + w[2] + w[3]);
    aur_bilinear weights; /* scaled so that squares neither overflow nor underflow */
    for (size_t k = 0; k < 4; ++k)
        weights.corner[k] = aur_larger(w[k] * scale, 1e-12f);
    aur_bilinear_draw(&weights, u, v);
}

/* The integral over all directions of the radiance given. */
static inline double aur_patches_integral(const aur_patches *patches) {
    return patches->rows.total * 2.0 * AUR_PI / (double)patches->columns;
}

/* The pdf by solid angle of directions sampled by luminance, at luminance `value`. It may vary within a patch
 * if its mean over azimuth and height equals the patch's value. */
static inline float aur_patches_density(const aur_patches *patches, float value) {
    return patches->rows.total > 0.0 ? (float)((double)value / aur_patches_integral(patches)) : 0.0f;
}
