/* Mean kernels of pairs of points on the sphere to a stated accuracy, in less time than a sum over all pairs.
 * The kernel k(d) = d^-S, or log 1/d for S = 0, is split as Ewald (1921) does into a part that is as smooth
 * as a Gaussian, whose mean over pairs is a sum over spherical harmonics to a degree L, and a part that
 * vanishes beyond a distance and is summed over near pairs. */
#pragma once

#include <stddef.h>

#include "points/base/simd.h"
#include "points/quality/measure.h"
#include "points/quality/pairs/twofold.h"

/* The exponents S for which there is a split. */
static const double aur_split_least = -1.95, aur_split_most = 16.0;
static inline bool aur_split_has(double exponent) {
    return exponent > aur_split_least && exponent <= aur_split_most;
}

/* The number of points from which a split is tried. */
enum { AUR_SPLIT_COUNT = 4096 };

typedef struct aur_split_mean {
    double mean;   /* of k over two independent points of the sphere; 0 for S >= 2, which have none */
    double excess; /* of sum_{i != j} w_i w_j k(|x_i - x_j|) / (sum w)^2 over the mean; infinite for S >= 0
                      where points coincide */
    double bound;  /* of the error of the excess */
} aur_split_mean;

/* `pair_cost`: how long a pair of the sum over all pairs takes, as a multiple of a distance by the widest
 * vectors. `tolerance`: of the excess; bound may be larger because of rounding and the transform. `points` is
 * a set of directions. `found` is false if the pair sum is faster; nothing else is set then. Errors: MEMORY,
 * CANCELLED. */
aur_result aur_split_pairs(const aur_measure_request *request, double exponent, double pair_cost,
                           double tolerance, bool *found, aur_split_mean *mean, aur_error *error);

/* The two parts of the kernel d^-S or log 1/d: F(d) = a^S g(S/2, a^2 d^2) is smooth and the rest is
 * negligible for a d >> 1. g is Tricomi's incomplete gamma function, g(s, q) = q^-s (1 - Gamma(s, q) /
 * Gamma(s)), which has no singularity (DLMF 8.7.1). */

enum { AUR_SPLIT_TERMS = 64 };

typedef struct aur_split_kernel {
    double exponent; /* S */
    double scale;    /* a */
    double reach;    /* the distance beyond which the rest is neglected */
    double rest;     /* an upper bound of the neglected rest */
    size_t term_count;
    double terms[AUR_SPLIT_TERMS]; /* F as a Chebyshev series in d^2 over [0, reach^2] */
} aur_split_kernel;

/* The kernel itself; `square` is d^2 > 0. */
double aur_split_whole(double exponent, double square);
/* F, and F(0) for 0. */
double aur_split_smooth(const aur_split_kernel *kernel, double square);
/* With the rest neglected where (a d)^2 > `range`. */
aur_split_kernel aur_split_kernel_make(double exponent, double reach, double range);

/* Sums of the rest of a split kernel over the pairs that are near each other. */

/* Points band by band of polar angle, and by azimuth in each band. */
typedef struct aur_near_points {
    size_t count, band_count;
    double width;          /* of a band, radians */
    size_t *first;         /* band_count + 1 */
    double *theta, *phi;   /* count each; azimuths from -pi to pi */
    double *x, *y, *z, *w; /* count each, and room for a vector behind */
} aur_near_points;

/* The arena owns them. Bands are a third of `reach` wide, a chord. */
aur_result aur_near_points_create(const aur_points_view *points, double reach, aur_arena *arena,
                                  aur_near_points *near, aur_error *error);

/* The sum over the unordered pairs of w_i w_j (k - F)(|x_i - x_j|), within the reach of the kernel. */
aur_result aur_near_sum(const aur_near_points *near, const aur_split_kernel *kernel,
                        const aur_measure_request *request, double *sum, aur_error *error);

/* Of point `i` with the points [first, last). */
typedef double (*aur_near_row)(const aur_near_points *near, const aur_split_kernel *kernel, size_t i,
                               size_t first, size_t last);
typedef struct aur_near_kernel {
    aur_near_row row;
} aur_near_kernel;
AUR_KERNELS(const aur_near_kernel, aur_near);

/* The power of directions at each degree of spherical harmonics, in O(points + degree^3). */

/* powers[l] = sum_ij w_i w_j P_l(x_i . x_j), 1 <= l <= degree, which is at most AUR_BASIS_DEGREE_MAX. The
 * error of the root of each is at most AUR_WINDOW_ERROR times the sum of the absolute weights. Errors:
 * MEMORY. */
aur_result aur_powers_find(const aur_points_view *points, size_t degree, size_t threads, double *powers,
                           aur_error *error);
