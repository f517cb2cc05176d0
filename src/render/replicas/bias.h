/* The bias of final gathering: the error of its photon map in the mean over all maps. The noise of a single
 * map is in the spread of the replicas, because each has a separate map. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>

#include "render/film/blocks.h"
#include "render/replicas/replicas.h"

/* Squares of root mean square errors in the units of a measure. */
typedef struct aur_bias {
    double estimate;  /* unbiased, so it may be negative */
    double low, high; /* of its interval, from 0 on; an estimate below 0 does not lower its upper end */
    double half;      /* half the interval's width by what varies over blocks: noise and the bias itself */
    double of_noise;  /* and by the noise of samples alone */
} aur_bias;

/* Estimates the bias of replicas that have it as the mean of `corrections`, plus the bias in channels 3 to 5
 * of `shared`, if not NULL; blocks of 4 x 4 pixels without corrections are excluded. With D_r the mean
 * difference of a block in the r-th replica, the mean of D_r D_s over r != s has the square of the block's
 * bias as its expectation, for any noise. The interval is Student's t over the blocks, and at least as wide
 * as noise of the replicas' spread makes it: rare large values seldom meet in two replicas. What replica r's
 * map adds to the bias b, m_r, varies in all blocks together: given the maps, the expectation is (b + mean of
 * m_r)^2 less the square of the standard error of the mean of m_r, which the spread of the replicas has in
 * it. So the sum of both is right for these maps. `values` are the image's. */
aur_bias aur_replicas_bias(const aur_replicas *corrections, const aur_replicas *shared, aur_weighing weighing,
                           const double (*values)[3], double confidence);

/* The upper end of the interval of noise and bias together, from the noise's estimate and upper end: both are
 * independent, so the widths are added in squares. A bias without a half is certain. */
double aur_bias_with_noise(const aur_bias *bias, double noise, double noise_high);

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
/* Renders the first blocks, then half as many samples or blocks again. Errors: CANCELLED, MEMORY. */
aur_result aur_corrections_grow(aur_corrections *corrections, bool more_samples, const atomic_bool *cancelled,
                                aur_error *error);
/* The same steps again. */
aur_result aur_corrections_repeat(aur_corrections *corrections, uint64_t steps, const atomic_bool *cancelled,
                                  aur_error *error);
