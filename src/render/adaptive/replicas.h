/* Independent renderings of one image: the same everything but the seed. Their mean is the image, and
 * their differences say how good it is. */
#pragma once

#include <aureole-render/render.h>

#include "render/adaptive/interval.h"
#include "render/image/error_measure.h"

typedef struct aur_replicas {
    size_t count; /* of renders that were made: fewer than requested after a failure */
    aur_render *renders[AUR_REPLICAS_MAX];
    size_t pixel_count;
} aur_replicas;

/* `options` as for aur_render_create; the seeds follow from options->seed. Errors as there. The replicas are
 * to be released in every case. */
aur_result aur_replicas_create(aur_renderer *renderer, const aur_render_options *options, size_t count,
                               aur_replicas *replicas, aur_error *error);
void aur_replicas_release(aur_replicas *replicas);

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

/* How a pixel's errors count: all alike where weights are NULL. */
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
 * each replica and pixel, the sum over the differences of the variance of one sample, as the other replicas
 * tell it. A replica that shared out its samples by its own
 * values would leave pixels alone where these agree by chance: its error would look smaller than it is. */
void aur_replicas_measure(const aur_replicas *replicas, aur_weighing weighing, aur_replica_measure *measure,
                          const aur_pixel_measure *pixels);

/* Variances of single pixels are known too badly to share out samples by: each becomes what the pixels about
 * it say together, and then that of the replica's value, of which `samples`[count * pixel_count] are made.
 * `scratch` has room for 2 x pixel_count values. */
void aur_replicas_smooth(const aur_replicas *replicas, const uint32_t *samples, double *variances,
                         double *scratch);

/* Where the pixels of cells of `side` x `side` have as many samples: each variance becomes the mean of its
 * cell, by which most is gained for what the whole cell costs; and that of the replica's value, of which
 * `samples` are made (NULL: it is already). */
void aur_replicas_average(const aur_replicas *replicas, size_t side, const uint32_t *samples,
                          double *variances);

/* The mean of the replicas, and with `errors` three more channels with its standard error. May be called
 * while a replica is in a step. Errors: UNSUPPORTED before the replicas are made, MEMORY. */
aur_result aur_replicas_develop(const aur_replicas *replicas, bool errors, aur_image **image,
                                aur_error *error);
