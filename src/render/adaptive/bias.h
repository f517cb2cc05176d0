/* How far two ways to render a picture are from each other in the mean: the bias of one, if the other has
 * none. */
#pragma once

#include "render/adaptive/replicas.h"

/* Squares of root mean square errors over the picture's values, relative to the square of its mean. */
typedef struct aur_bias {
    double estimate;  /* unbiased, so it may be negative */
    double low, high; /* of its interval, from 0 on; an estimate below 0 does not lower its upper end */
} aur_bias;

/* Both have the same pixels and as many replicas, all with samples in every pixel; without `unbiased` (NULL)
 * the first are differences already. With D_r the difference of
 * the r-th replicas, the mean of D_r D_s over r != s has the squared bias as its expectation, whatever the
 * noise. Its uncertainty comes from how blocks of pixels differ, which are taken to be independent; that
 * their bias differs too makes the interval a little too wide. */
aur_bias aur_replicas_bias(const aur_replicas *biased, const aur_replicas *unbiased, double mean,
                           double confidence);

/* The bias of light that neighbouring pixels share, from replicas whose channels after R, G and B are what
 * sharing adds to them (finalgather's share=near); 0 of those that have none. */
aur_bias aur_replicas_sharing_bias(const aur_replicas *replicas, double mean, double confidence);

/* Of two biases that add up pixel by pixel, by the triangle inequality. The estimate takes them for
 * independent. */
aur_bias aur_bias_of_both(aur_bias a, aur_bias b);
