/* Sums of the functions of a basis over points, and their values at points: O(points * degree^2), in vector
 * code whose sums have one order, so that bits depend on neither instruction set nor threads. */
#pragma once

#include <aureole/core.h>

#include "points/base/simd.h"
#include "points/quadrature/exact/basis.h"

/* Directions as heights, sines of the polar angle, and cosines and sines of the azimuth. */
typedef struct aur_polar_points {
    size_t count;
    double *z, *sine, *cosine, *azimuth_sine; /* count each, one after the other from z on */
} aur_polar_points;

/* `storage` has room for 4 * count doubles. */
aur_polar_points aur_polar_points_make(size_t count, const double *xyz, double *storage);

/* A coefficient for the cosine and one for the sine, at [2 (aur_basis_at(degree, m) + l - m)]; those of sin
 * 0 are 0. */
static inline size_t aur_coefficient_count(size_t degree) {
    return 2 * aur_basis_pairs(degree);
}

typedef struct aur_transform {
    const aur_basis *basis;
    const aur_polar_points *points;
    size_t threads;
    double *sums; /* AUR_TRANSFORM_BANDS * aur_transform_room(degree) */
    aur_progress
        progress; /* asked whether to stop, within a transform; no reports where its function is NULL */
} aur_transform;

/* Of one band: its coefficients, and sums of one order side by side. */
static inline size_t aur_transform_room(size_t degree) {
    return aur_coefficient_count(degree) + 16 * (degree + 1);
}

/* Points are worked on in so many bands, whatever the threads. */
enum { AUR_TRANSFORM_BANDS = 16 };

/* coefficients[j] = sum over points of weights[i] Y_j(x_i). */
aur_result aur_transform_analyse(const aur_transform *transform, const double *weights, double *coefficients,
                                 aur_error *error);
/* values[i] = sum over j of coefficients[j] Y_j(x_i). */
aur_result aur_transform_synthesise(const aur_transform *transform, const double *coefficients,
                                    double *values, aur_error *error);

/* The functions of one order m at `count` points, a multiple of 16: `start` is q_mm, `steps` those of m,
 * and a and b belong to the cosine and the sine. */
typedef struct aur_transform_order {
    size_t degrees; /* degree + 1 - m */
    const aur_basis_step *steps;
    size_t count;
    const double *z, *start;
    double *a, *b;
} aur_transform_order;

/* The work on the points from `first` to `last`, once for each instruction set. `analyse` adds to the
 * coefficients at `sums`, which has the room of a band. */
typedef struct aur_transform_kernel {
    void (*analyse)(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                    const double *weights, double *sums);
    void (*synthesise)(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                       const double *coefficients, double *values);
    /* Adds the sums of a and b times the functions to sums[2 * degrees]; `room` has 16 * degrees numbers. */
    void (*analyse_order)(const aur_transform_order *order, double *sums, double *room);
    /* Fills a and b with the sums over the degrees. */
    void (*synthesise_order)(const aur_transform_order *order, const double *coefficients);
    /* sums[r] = the dot product of row[count] and rows[r][count], of `row_count` rows that lie `stride`
     * apart; sums lie `step` apart. */
    void (*dots)(size_t count, const double *row, size_t row_count, size_t stride, const double *rows,
                 size_t step, double *sums);
} aur_transform_kernel;

AUR_KERNELS(const aur_transform_kernel, aur_transform_kernel);
