/* How far the mean of independent, equally distributed images is from the truth, told from how far the
 * images are from each other. */
#pragma once

#include <stddef.h>

enum { AUR_REPLICAS_MAX = 16 };

/* Products of the deviations of `count` images from their mean, summed over the values of a block of pixels
 * and channels: the Gram matrix of the block. */
typedef struct aur_gram {
    size_t count;
    double products[AUR_REPLICAS_MAX][AUR_REPLICAS_MAX];
    double alike; /* an estimate of tr C^2 from values beside each other (aur_deviations) */
} aur_gram;

/* What the Gram matrices of all blocks of an image say together. With C the covariance of one replica's
 * values, whose blocks are taken to be independent of each other. Start with zero. */
typedef struct aur_deviations {
    double trace;          /* the sum of tr W; expectation (count - 1) tr C */
    double spread;         /* the sum of estimates of tr C^2 */
    double square_spreads; /* the sum of their squares */
    double alike;          /* the sum of the blocks' */
} aur_deviations;

/* The error of the mean and its estimate from the replicas' differences differ by the sum of Y_r.Y_s over r
 * != s, over count (count - 1), with Y the deviations from the truth: an identity. Its variance is 2 tr C^2
 * over count (count - 1), whatever the values' distribution, so tr C^2 is what an interval needs. Four
 * different replicas tell it: ((X_1 - X_2).(X_3 - X_4))^2 / 4 has it as its expectation, whatever the
 * distribution (Chen, Zhang and Zhong 2010), and the mean over all such fours is taken of each block. The
 * Gram matrix of normal values tells it with more degrees (Wishart), and those of rare large values several
 * times too high. Three replicas have only that: (tr W^2 - (tr W)^2 / n) / ((n - 1)(n + 2)) with n =
 * count - 1. */
void aur_deviations_add(aur_deviations *sum, const aur_gram *block);

/* tr C^2 of one block, from its Gram matrix. */
double aur_gram_spread(const aur_gram *block);

/* What rounds tell of a replica's value of a pixel: its variance, the channels together, and tr C^2. */
typedef struct aur_pixel_spread {
    double variance, spread;
} aur_pixel_spread;

/* Takes for the spread what all rounds say of the `pixels`, where that is more for the same error. Where one
 * pixel has most of the error and its replicas agree by chance now, the error looks small, and spread over
 * many pixels; what earlier rounds saw does not agree. Where four pixels or more have the spread, the last
 * round tells it well enough, and the rounds before, whose samples it has, tell too much of rare values. */
void aur_deviations_pool(aur_deviations *sum, size_t count, size_t pixel_count,
                         const aur_pixel_spread *pixels);

typedef struct aur_error_interval {
    double estimate, low, high; /* of the root mean square error, in the image's units */
    double degrees;             /* independent values of equal size that would make such an error */
} aur_error_interval;

/* The error of the mean of `count` >= 3 images of `values` values, and the interval that holds it with
 * probability `confidence` in (0,1). It is the error of this mean, not its expectation over other seeds: the
 * two vary independently, which makes the interval wider by a factor 1 + 1/(count - 1) in variance. The
 * larger of `spread` and `alike` is taken for tr C^2: the first has few degrees, and is low by chance where
 * the error itself is seen too low; the second has many, and is too low where neighbours differ. The
 * interval is made on the scale of cube roots, where sums of squares of (tr C)^2 / tr C^2 degrees
 * (Satterthwaite 1946) are nearly normal (Wilson and Hilferty 1931), with Student's quantile for the
 * uncertainty of tr C^2. */
aur_error_interval aur_replica_interval(const aur_deviations *sum, size_t count, size_t values,
                                        double confidence);
