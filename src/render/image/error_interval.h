/* The distance of the mean of independent, identically distributed images from their expectation, estimated
 * from the spread between the images. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { AUR_REPLICAS_MAX = 16, AUR_CELL_SIDE = 2, AUR_CELL_PIXELS = AUR_CELL_SIDE * AUR_CELL_SIDE };

/* The different entries of a Gram matrix, the products of images' deviations from their mean: those of image
 * r with images 0 to r, in order. The last is the square of r itself. */
#define AUR_GRAM_ENTRIES(count) ((count) * ((count) + 1) / 2)
#define AUR_GRAM_SQUARE(r) (AUR_GRAM_ENTRIES((r) + 1) - 1)

/* Sums over an image's pixels. C is the covariance of one replica's values. Initialise with zeros and
 * `overlap`. */
typedef struct aur_deviations {
    double trace;         /* the sum of tr W; expectation (count - 1) tr C */
    double others;        /* the same of the jackknife's deviations, where the error measure is not linear */
    double blocks;        /* the sum of the blocks' estimates of their shares of tr C^2 */
    double square_blocks; /* of their squares, and of their products with their neighbours as far as these
                             deviate together */
    double cells;         /* the sum of the cells' estimates of tr C^2 */
    double square_cells;  /* the sum of their squares */
    double overlap;       /* tr C^2 over the pixels' part, where they share samples whose noise is white */
} aur_deviations;

/* A replica's values in a block of pixels: tr C there, the sum of the squares of covariances of its values
 * with each other, and the block's share of tr C^2: that and the same with values of the up to eight blocks
 * around it. */
typedef struct aur_block_spread {
    double variance, own, spread;
} aur_block_spread;

/* Let Y be the deviations from the expectation. The error of the mean and its estimate from the replicas'
 * differences differ by the sum of Y_r.Y_s over r != s, divided by count (count - 1): an identity. Its
 * variance is 2 tr C^2 over count (count - 1) for any distribution, so the interval needs tr C^2. Four
 * distinct replicas estimate it without bias: ((X_1 - X_2).(X_3 - X_4))^2 / 4 (Chen, Zhang and Zhong 2010).
 * Each block takes the mean over all sets of four; a product of two blocks' inner products, instead of a
 * square, estimates what is between them, so that no border cuts what pixels have in common. With three
 * replicas, values are taken to be normal. `products`: for rows x columns blocks the entries of their Gram
 * matrices, summed over the values. */
void aur_blocks_measure(size_t count, size_t columns, size_t rows, const double *products,
                        aur_block_spread *blocks);

/* Sets the blocks' part of the sum. How far neighbours deviate together is the sum of what they have in
 * common over the root mean square of what each has alone, in all pairs: 0 for independent blocks, 1 for
 * those that one source of noise covers. */
void aur_deviations_set_blocks(aur_deviations *sum, size_t columns, size_t rows,
                               const aur_block_spread *blocks);

/* Sums over the pixels of a cell: of their channels' products of deviations, added up over the replicas, of
 * the traces of the squares of these, and of the pixels' estimates of tr C^2. */
typedef struct aur_cell {
    size_t count, pixels;
    double products[3][3], squares, spread;
} aur_cell;

/* Adds a pixel with deviations d[channel][replica] to its cell and to the sum, its tr C^2 from sets of four
 * as for a block. `products` are the entries of its Gram matrix; `others` is tr W of the jackknife's
 * deviations. */
void aur_deviations_add_pixel(aur_deviations *sum, const double *products, double d[3][AUR_REPLICAS_MAX],
                              double others, aur_cell *cell);

/* Where few replicas meet a pixel's light, sets of four seldom show its variance. Its neighbours' replicas
 * have met as much of it. The product of the variances of two pixels has no bias either, whatever their
 * values' distribution, if their noise is independent. If variances differ, the mean over all pairs in a cell
 * is lower than the mean of squares (Cauchy and Schwarz). A pixel's product with itself is its estimate from
 * sets of four. */
void aur_deviations_add_cell(aur_deviations *sum, const aur_cell *cell);

/* Replaces the blocks' part by the estimates from all rounds, at the error of the last one: if a block's
 * replicas agree by chance in the last round, the error looks small and evenly distributed; earlier rounds
 * reveal it. */
void aur_deviations_pool(aur_deviations *sum, size_t count, size_t columns, size_t rows,
                         const aur_block_spread *blocks);

typedef struct aur_error_interval {
    double estimate, low, high; /* of the root mean square error, in the image's units */
    double degrees;             /* independent values of equal variance that would have such an error */
} aur_error_interval;

/* The error of the mean of `count` >= 3 images of `values` values, and its interval of probability
 * `confidence` in (0,1). It is the error of this mean, not the expected error over other seeds: the two vary
 * independently, which widens the interval by a factor of 1 + 1/(count - 1) in variance. tr C^2 is the
 * larger of the estimates by blocks, and by cells with their overlap. The interval is computed on
 * the scale of cube roots, where sums of squares with (tr C)^2 / tr C^2 degrees (Satterthwaite 1946) are
 * nearly normal (Wilson and Hilferty 1931), with Student's quantile for the uncertainty of tr C^2. If the
 * error measure is not linear, the variances of one image and of the mean of all but one (jackknife, Efron
 * and Stein 1981) give the power of their number with which it falls, and so the variance of the mean of
 * all. tr C^2 is scaled with it. */
aur_error_interval aur_replica_interval(const aur_deviations *sum, size_t count, size_t values,
                                        double confidence);
