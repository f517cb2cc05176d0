/* Sums over all pairs of points on the sphere: each unordered pair once, in tiles, in an order that depends
 * only on the data. */
#pragma once

#include "points/base/simd.h"
#include "points/quality/measure.h"
#include "points/quality/pairs/twofold.h"

enum { AUR_TILE_POINTS = 1024 }; /* a tile's coordinates stay in the first-level cache */

/* Coordinates in one array per axis, each padded to a multiple of 8 and 64-byte aligned. One allocation, at
 * x. */
typedef struct aur_axes {
    size_t count;
    double *x, *y, *z;
    double *weights; /* NULL: all equal to 1 */
} aur_axes;

aur_result aur_axes_create(const aur_points_view *points, aur_axes *axes, aur_error *error);
void aur_axes_release(aur_axes *axes);

/* Rows [first_row, last_row) against columns [first_column, last_column); when both ranges are the same, the
 * pairs below the diagonal only. */
typedef struct aur_pair_tile {
    size_t first_row, last_row, first_column, last_column;
} aur_pair_tile;

typedef aur_twofold (*aur_pair_tile_function)(const aur_axes *axes, aur_pair_tile tile, double parameter);

/* Sums `function` over the tiles of the lower triangle. */
aur_result aur_pair_sum(const aur_axes *axes, aur_pair_tile_function function, double parameter,
                        const aur_measure_options *options, aur_twofold *sum, aur_error *error);

/* The sum of w_i w_j |x_i - x_j| over unordered pairs; relative error about 1e-16, or 2e-14 when
 * options->fast. */
aur_result aur_distance_sum(const aur_axes *axes, const aur_measure_options *options, aur_twofold *sum,
                            aur_error *error);

/* The sum over a tile: `exact` compensated, bit-identical on every processor; `fast` to 2e-14, for equal
 * weights only. */
typedef struct aur_distance_kernels {
    aur_pair_tile_function exact, fast;
} aur_distance_kernels;

AUR_KERNELS(const aur_distance_kernels, aur_distance);
