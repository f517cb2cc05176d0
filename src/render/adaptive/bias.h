/* The bias of final gathering: what its photon map is wrong by in the mean of all maps. The noise of the maps
 * themselves is in the spread of the replicas, for each has its own. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>

#include "render/adaptive/replicas.h"
#include "render/film/blocks.h"

/* Squares of root mean square errors in the units of a measure. */
typedef struct aur_bias {
    double estimate;  /* unbiased, so it may be negative */
    double low, high; /* of its interval, from 0 on; an estimate below 0 does not lower its upper end */
    double of_blocks, of_replicas; /* halves of the interval by what varies: blocks and replicas */
} aur_bias;

/* Replicas whose channels `first` to `first` + 2 have the bias as their mean; blocks of 4 x 4 pixels without
 * samples are left out. With D_r the mean difference of a block in the r-th replica, the mean of D_r D_s over
 * r != s has the square of the block's bias as its expectation, whatever the noise. The interval is the
 * larger of two: by Student's t over the replicas, of which each in turn is left out (jackknife: right where
 * the bias is larger than the noise, wider than needed where it is smaller), and over the blocks. `values`
 * are the image's. */
aur_bias aur_replicas_bias(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], double confidence);

/* Of two biases that add up pixel by pixel, by the triangle inequality. The estimate takes them for
 * independent. */
aur_bias aur_bias_of_both(aur_bias a, aur_bias b);

/* Images of corrections in some blocks of the image: what paths find over what the map has. */
typedef struct aur_corrections {
    aur_replicas replicas;
    aur_blocks blocks;
    uint32_t *targets; /* [pixels] */
    uint32_t samples;  /* of a pixel in each replica */
    size_t rendered;   /* blocks */
    uint64_t steps;    /* how they grew: 1, then a bit for each step, 1 for more samples; 0: none yet */
} aur_corrections;

/* To be released in every case; zero: there are none. Errors: those of aur_render_create. */
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
