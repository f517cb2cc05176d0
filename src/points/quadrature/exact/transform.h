/* Sums of the functions of a basis over points, and their values at points: O(points * degree^2), in vector
 * code with a fixed order of sums, so that results are bit-identical for all instruction sets and threads. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"
#include "points/base/simd.h"

/* The basis of polynomials on a cap, orthonormal for a density that depends only on the height: Y(z, phi) =
 * q(z) (1 - z^2)^{m/2} times cos(m phi) or sin(m phi). On the whole sphere they are the spherical harmonics.
 * The polynomials of degree L in x, y, z are those of orders m <= l <= L. */

/* Beyond this degree powers of the sine underflow where the functions do not vanish. */
enum { AUR_BASIS_DEGREE_MAX = 1500 };

/* One step of the recurrence: q_l = (scale z + shift) q_{l-1} - before q_{l-2}. */
typedef struct aur_basis_step {
    double scale, shift, before;
} aur_basis_step;

typedef struct aur_basis {
    size_t degree;
    double *start;         /* degree + 1: q_mm is start[m] sin(theta) times q_{m-1,m-1}; start[0] is 1 */
    aur_basis_step *steps; /* at aur_basis_at(degree, m) + l - m; for l = m it is not used */
} aur_basis;

/* The index of order m among the pairs m <= l <= degree, and the number of pairs. */
static inline size_t aur_basis_at(size_t degree, size_t m) {
    return m * (degree + 1) - m * (m - 1) / 2;
}
static inline size_t aur_basis_pairs(size_t degree) {
    return (degree + 1) * (degree + 2) / 2;
}

/* The functions to a degree for the density z^exponent on the cap z >= `lowest`, normalised to integral 1;
 * `lowest` -1 is the sphere, 0 the hemisphere; `exponent` is 0 unless `lowest` is. The mean of each squared
 * function over the density is 1. Errors: MEMORY. On failure nothing needs to be released. */
aur_result aur_basis_create(size_t degree, double lowest, double exponent, aur_basis *basis,
                            aur_error *error);
void aur_basis_release(aur_basis *basis);

/* Directions as heights, sines of the polar angle, and cosines and sines of the azimuth. */
typedef struct aur_polar_points {
    size_t count;
    double *z, *sine, *cosine, *azimuth_sine; /* count each, one after the other from z on */
} aur_polar_points;

/* `storage` has 4 * count doubles. */
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
        progress; /* checked for cancellation within a transform; no reports if its function is NULL */
} aur_transform;

/* Of one band: its coefficients, and sums of one order side by side. */
static inline size_t aur_transform_room(size_t degree) {
    return aur_coefficient_count(degree) + 16 * (degree + 1);
}

/* The number of bands of points, for any number of threads. */
enum { AUR_TRANSFORM_BANDS = 16 };

/* coefficients[j] = sum over points of weights[i] Y_j(x_i). */
aur_result aur_transform_analyse(const aur_transform *transform, const double *weights, double *coefficients,
                                 aur_error *error);
/* values[i] = sum over j of coefficients[j] Y_j(x_i). */
aur_result aur_transform_synthesise(const aur_transform *transform, const double *coefficients,
                                    double *values, aur_error *error);

/* The functions of one order m at `count` points, a multiple of 16: `start` is q_mm, `steps` those of m, and
 * a and b belong to the cosine and the sine: [0] to the degrees m, m + 2, .. and [1] to the others, so that a
 * point also gives the values of its mirror image. */
typedef struct aur_transform_order {
    size_t degrees; /* degree + 1 - m */
    const aur_basis_step *steps;
    size_t count;
    const double *z, *start;
    double *a[2], *b[2];
} aur_transform_order;

/* Kernels for the points from `first` to `last`, one for each instruction set. `analyse` adds to the
 * coefficients at `sums`, which has the size of a band. */
typedef struct aur_transform_kernel {
    void (*analyse)(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                    const double *weights, double *sums);
    void (*synthesise)(const aur_basis *basis, const aur_polar_points *points, size_t first, size_t last,
                       const double *coefficients, double *values);
    /* Adds the sums of a and b times the functions to sums[2 * degrees]; `room` has 16 * degrees numbers. */
    void (*analyse_order)(const aur_transform_order *order, double *sums, double *room);
    /* Fills a and b with the sums over the degrees. */
    void (*synthesise_order)(const aur_transform_order *order, const double *coefficients);
    /* sums[r] = the dot product of row[count] and rows[r][count], of `row_count` rows that are `stride`
     * apart; sums are `step` apart. */
    void (*dots)(size_t count, const double *row, size_t row_count, size_t stride, const double *rows,
                 size_t step, double *sums);
} aur_transform_kernel;

AUR_KERNELS(const aur_transform_kernel, aur_transform_kernel);
