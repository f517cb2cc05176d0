/* The bias of final gathering: the error of its photon map in the mean over all maps. The noise of a single
 * map is in the spread of the replicas, because each has a separate map. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>

#include "render/replicas/replicas.h"
#include "render/film/blocks.h"

/* Squares of root mean square errors in the units of a measure. */
typedef struct aur_bias {
    double estimate;  /* unbiased, so it may be negative */
    double low, high; /* of its interval, from 0 on; an estimate below 0 does not lower its upper end */
    double of_blocks, of_replicas; /* halves of the interval by what varies: blocks and replicas */
} aur_bias;

/* Estimates the bias of replicas whose channels `first` to `first` + 2 have it as their mean; blocks of 4 x 4
 * pixels without samples are excluded. With D_r the mean difference of a block in the r-th replica, the mean
 * of D_r D_s over r != s has the square of the block's bias as its expectation, for any noise. The interval
 * is the wider of two. One is Student's t over the replicas by the jackknife (right if the bias is larger
 * than the noise, too wide if it is smaller); the other is over the blocks. Its upper end is that of the
 * square of the replicas' mean, if that is smaller: the square of the bias of these replicas' own maps, whose
 * noise no number of samples removes, and of the samples' noise, which they do. `values` are the image's. */
aur_bias aur_replicas_bias(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], double confidence);

/* The bound of the sum of two biases that add up pixel by pixel, by the triangle inequality. The estimate
 * assumes that they are independent. */
aur_bias aur_bias_of_both(aur_bias a, aur_bias b);

/* Images of corrections in some blocks of the image: paths' radiance less the map's. */
typedef struct aur_corrections {
    aur_replicas replicas;
    aur_blocks blocks;
    uint32_t *targets; /* [pixels] */
    uint32_t samples;  /* of a pixel in each replica */
    size_t rendered;   /* blocks */
    uint64_t steps;    /* history of growth: 1, then a bit for each step, 1 for more samples; 0: none yet */
} aur_corrections;

/* Must be released in every case; zero: there are none. Errors: those of aur_render_create. */
aur_result aur_corrections_create(aur_renderer *renderer, const aur_render_options *options,
                                  const char *integrator, size_t replica_count, aur_corrections *corrections,
                                  aur_error *error);
void aur_corrections_release(aur_corrections *corrections);
/* Renders the first blocks, then twice as many samples or blocks. Errors: CANCELLED, MEMORY. */
aur_result aur_corrections_grow(aur_corrections *corrections, bool more_samples, const atomic_bool *cancelled,
                                aur_error *error);
/* The same steps again. */
aur_result aur_corrections_repeat(aur_corrections *corrections, uint64_t steps, const atomic_bool *cancelled,
                                  aur_error *error);
