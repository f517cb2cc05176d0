/* Independent renderings of one image that differ only in their random numbers. Their mean is the image, and
 * their differences give its error. */
#pragma once

#include <aureole-render/render.h>
#include <stdatomic.h>

#include "render/image/error_interval.h"
#include "render/image/error_measure.h"

typedef struct aur_replicas {
    size_t count; /* created renders: fewer than requested after a failure */
    aur_render *renders[AUR_REPLICAS_MAX];
    size_t pixel_count;
    size_t columns, rows;     /* of blocks of pixels */
    double *products;         /* of the replicas' deviations, by blocks; scratch */
    aur_block_spread *blocks; /* [rows][columns] as measured last */
} aur_replicas;

/* `options` as for aur_render_create, but with this integrator (NULL: the scene's) and any number of samples;
 * the seeds follow from options->seed. Errors as there. The replicas must be released in every case. */
aur_result aur_replicas_create(aur_renderer *renderer, const aur_render_options *options,
                               const char *integrator, size_t count, aur_replicas *replicas,
                               aur_error *error);
void aur_replicas_release(aur_replicas *replicas);

/* Renders pixels up to targets[pixel_count]; those of replica r begin at r * stride. *done counts the
 * replicas. Errors: CANCELLED, after which another call continues; MEMORY. */
aur_result aur_replicas_step(aur_replicas *replicas, const uint32_t *targets, size_t stride, size_t *done,
                             const atomic_bool *cancelled, aur_error *error);

/* The rays of all samples. */
double aur_replicas_rays(const aur_replicas *replicas);

/* The cost of renders. */
typedef struct aur_spent {
    aur_render_statistics all;
    uint64_t budget; /* of the rays, those independent of caches: without shared preparation */
} aur_spent;

/* Adds the cost of replicas, whose preparation took `prepared` rays. */
void aur_spent_add(aur_spent *sum, const aur_replicas *replicas, uint64_t prepared);

/* Estimates from the samples so far. */
typedef struct aur_replica_measure {
    aur_deviations deviations;
    double mean; /* over pixels and channels R, G, B */
} aur_replica_measure;

/* R, G, B of each replica's pixels, light[count * pixel_count], and their means over the replicas. */
void aur_replicas_mean(const aur_replicas *replicas, double (*light)[3], double (*values)[3]);

/* How the errors of pixels count: unchanged where weights are NULL. */
typedef struct aur_weighing {
    aur_error_measure measure;
    const aur_error_weight *weights; /* [pixel_count] */
} aur_weighing;

/* The values of three channels, as aur_film_colours gives them, in each replica: those of replica r begin at
 * r * stride. */
void aur_replicas_read(const aur_replicas *replicas, const size_t corners[2], size_t first, size_t stride,
                       double (*values)[3]);
/* Converts deviations d[channel][replica] of `count` replicas from `mean` to those of a pixel's differences.
 */
void aur_replicas_weigh(size_t count, aur_weighing weighing, size_t pixel, const double mean[3],
                        double d[3][AUR_REPLICAS_MAX]);

/* From the replicas' `light`. All results are in the units of the weighing, except for the mean. `variances`,
 * which may be NULL, get for each replica and pixel the sum over the differences of the variance of one
 * sample, from the other replicas alone: [count * pixel_count]. If a replica allocated samples by its own
 * values, it would starve pixels where these agree by chance, and underestimate its error. */
void aur_replicas_measure(const aur_replicas *replicas, const double (*light)[3], aur_weighing weighing,
                          aur_replica_measure *measure, double *variances);

/* Variances of single pixels are too uncertain for allocating samples: each becomes a mean over the pixels
 * around it. `scratch` has space for 2 x pixel_count values. */
void aur_replicas_smooth(const aur_replicas *replicas, double *variances, double *scratch);
/* Each becomes the mean of its cell of `side` x `side` pixels, which get equal numbers of samples. */
void aur_replicas_average(const aur_replicas *replicas, size_t side, double *variances);

/* The block in which a pixel is. */
size_t aur_replicas_block_of(const aur_replicas *replicas, size_t pixel);

/* Whether channels 3 to 5 have the mean of the light removed by the clamp. */
bool aur_replicas_clamp(const aur_replicas *replicas);

/* The mean of the replicas first, first + step, ...; with `errors` three more channels with its standard
 * error by the spread of all of them; three more if aur_replicas_clamp. May be called while a replica is in a
 * step. Errors: UNSUPPORTED before the replicas are created, MEMORY. */
aur_result aur_replicas_develop(const aur_replicas *replicas, size_t first, size_t step, bool errors,
                                aur_image **image, aur_error *error);
