/* Mean kernels of pairs of points on the sphere to a stated accuracy, in less time than all pairs take: the
 * kernel k(d) = d^-S, or log 1/d for S = 0, is split as Ewald (1921) does into a part that is as smooth as a
 * Gaussian, whose mean over pairs is a sum over spherical harmonics to a degree L, and a part that vanishes
 * beyond a distance, which is summed over near pairs. */
#pragma once

#include "points/quality/measure.h"

/* The exponents S for which there is a split. */
static const double aur_split_least = -1.95, aur_split_most = 16.0;
static inline bool aur_split_has(double exponent) {
    return exponent > aur_split_least && exponent <= aur_split_most;
}

/* From here on a split is tried. */
enum { AUR_SPLIT_COUNT = 4096 };

typedef struct aur_split_mean {
    double mean;   /* of k over two independent points of the sphere; 0 for S >= 2, which have none */
    double excess; /* of sum_{i != j} w_i w_j k(|x_i - x_j|) / (sum w)^2 over the mean; infinite for S >= 0
                      where points coincide */
    double bound;  /* of the error of the excess */
} aur_split_mean;

/* `pair_cost`: how long a pair of the sum over all pairs takes, as a multiple of a distance by the widest
 * vectors. `tolerance`: of the excess; bound may come out larger where rounding and the transform allow no
 * better. `points` is a set of directions. `found` is false where the pair sum would be done sooner; nothing
 * else is set then. Errors: MEMORY, CANCELLED. */
aur_result aur_split_pairs(const aur_measure_request *request, double exponent, double pair_cost,
                           double tolerance, bool *found, aur_split_mean *mean, aur_error *error);
