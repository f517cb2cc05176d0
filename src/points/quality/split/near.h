/* Sums of the rest of a split kernel over the pairs that are near each other. */
#pragma once

#include "points/base/simd.h"
#include "points/quality/measure.h"
#include "points/quality/pairs/twofold.h"
#include "points/quality/split/kernel.h"

/* Points band by band of polar angle, and by azimuth in each band. */
typedef struct aur_near_points {
    size_t count, band_count;
    double width;          /* of a band, radians */
    size_t *first;         /* band_count + 1 */
    double *theta, *phi;   /* count each; azimuths from -pi to pi */
    double *x, *y, *z, *w; /* count each, and room for a vector behind */
} aur_near_points;

/* The arena holds them. Bands are a third of `reach` wide, a chord. */
aur_result aur_near_points_create(const aur_points_view *points, double reach, aur_arena *arena,
                                  aur_near_points *near, aur_error *error);

/* The sum over the unordered pairs of w_i w_j (k - F)(|x_i - x_j|), as far as the kernel reaches. */
aur_result aur_near_sum(const aur_near_points *near, const aur_split_kernel *kernel,
                        const aur_measure_request *request, double *sum, aur_error *error);

/* Of point `i` with the points [first, last). */
typedef double (*aur_near_row)(const aur_near_points *near, const aur_split_kernel *kernel, size_t i,
                               size_t first, size_t last);
typedef struct aur_near_kernel {
    aur_near_row row;
} aur_near_kernel;
AUR_KERNELS(const aur_near_kernel, aur_near);
