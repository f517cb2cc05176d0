/* Independent renderings of one image that differ in their random numbers alone. Their mean is the image, and
 * their differences give its error. */
#pragma once

#include <aureole-render/render.h>
#include <stdatomic.h>

#include "render/image/error_interval.h"
#include "render/image/error_measure.h"

typedef struct aur_replicas {
    size_t count; /* of renders that were made: fewer than requested after a failure */
    aur_render *renders[AUR_REPLICAS_MAX];
    size_t pixel_count;
} aur_replicas;

/* `options` as for aur_render_create, with an integrator in place of theirs (NULL: the scene's) and any
 * number of samples; the seeds follow from options->seed. Errors as there. The replicas are to be released in
 * every case. */
aur_result aur_replicas_create(aur_renderer *renderer, const aur_render_options *options,
                               const char *integrator, size_t count, aur_replicas *replicas,
                               aur_error *error);
void aur_replicas_release(aur_replicas *replicas);

/* Renders pixels up to targets[pixel_count], those of a replica `stride` after those of the one before. *done
 * counts the replicas. Errors: CANCELLED, after which another call goes on; MEMORY. */
aur_result aur_replicas_step(aur_replicas *replicas, const uint32_t *targets, size_t stride, size_t *done,
                             const atomic_bool *cancelled, aur_error *error);

/* The rays of all samples. */
double aur_replicas_rays(const aur_replicas *replicas);

/* What renders have cost. */
typedef struct aur_spent {
    aur_render_statistics all;
    uint64_t budget; /* of the rays, those that count whatever was there before: without what renders share */
} aur_spent;

/* Adds what replicas have cost, whose preparation took `prepared` rays. */
void aur_spent_add(aur_spent *sum, const aur_replicas *replicas, uint64_t prepared);

/* What the samples so far say. */
typedef struct aur_replica_measure {
    aur_deviations deviations; /* of blocks of 8 x 8 pixels */
    double mean;               /* over pixels and channels R, G, B */
} aur_replica_measure;

/* What they say of single pixels. */
typedef struct aur_pixel_measure {
    double *variances; /* [count * pixel_count] */
    double *spreads;   /* [pixel_count] tr C^2 of a replica's value */
} aur_pixel_measure;

/* The mean of the replicas: R, G, B of each pixel. */
void aur_replicas_mean(const aur_replicas *replicas, double (*values)[3]);

/* How the errors of pixels count: unchanged where weights are NULL. */
typedef struct aur_weighing {
    aur_error_measure measure;
    const aur_error_weight *weights; /* [pixel_count] */
} aur_weighing;

/* The value of a channel of a pixel in replica r: the mean of its samples; 0 without samples. */
double aur_replicas_value(const aur_replicas *replicas, size_t r, size_t pixel, size_t channel);
/* Deviations d[channel][replica] of `count` replicas from `mean` become those of a pixel's differences. */
void aur_replicas_weigh(size_t count, aur_weighing weighing, size_t pixel, const double mean[3],
                        double d[3][AUR_REPLICAS_MAX]);

/* All is in the units of the weighing, except for the mean. `pixels` may be NULL. Its `variances` get, for
 * each replica and pixel, the sum over the differences of the variance of one sample, from the other replicas
 * alone: a replica that shared out samples by its own values would starve pixels where these agree by chance,
 * and its error would look smaller than it is. */
void aur_replicas_measure(const aur_replicas *replicas, aur_weighing weighing, aur_replica_measure *measure,
                          const aur_pixel_measure *pixels);

/* Variances of single pixels are too uncertain to share out samples by: each becomes a mean over the pixels
 * around it. `scratch` has room for 2 x pixel_count values. */
void aur_replicas_smooth(const aur_replicas *replicas, double *variances, double *scratch);
/* Each becomes the mean of its cell of `side` x `side` pixels, which get equal numbers of samples. */
void aur_replicas_average(const aur_replicas *replicas, size_t side, double *variances);

/* Whether channels 3 to 5 have the mean of what a limit of samples takes away. */
bool aur_replicas_clamp(const aur_replicas *replicas);

/* The mean of the replicas first, first + step, ..., and with `errors` three more channels with its standard
 * error by the spread of all of them; three more where aur_replicas_clamp. May be called while a replica is
 * in a step. Errors: UNSUPPORTED before the replicas are made, MEMORY. */
aur_result aur_replicas_develop(const aur_replicas *replicas, size_t first, size_t step, bool errors,
                                aur_image **image, aur_error *error);
