/* A candidate for rendering an image: replicas by one integrator, and estimates from their samples so far. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/array.h"
#include "render/replicas/replicas.h"
#include "render/vertex/visible_emitters.h"

typedef struct aur_candidate {
    char *integrator; /* as aur_render_options take it; NULL: the scene's */
    aur_replicas replicas;
    aur_arena arena;    /* of the arrays */
    size_t value_count; /* replicas x pixels */
    uint32_t *targets;  /* [value_count] samples of each replica's pixels after the round planned last */
    uint32_t *earlier;  /* [value_count] before it */
    double *variances;  /* [value_count] of the replicas' pixels, by the other replicas in all rounds */
    double *measured;   /* the same of the last round alone */
    double *needs;      /* `variances`, or what emitters not hit yet need if that is more */
    aur_block_spread *blocks;     /* [replicas.rows][replicas.columns] by all rounds */
    double *scratch;              /* [2 x pixel_count] */
    aur_visible_emitters visible; /* where the integrator shows them */
    double (*light)[3];           /* [value_count] R, G, B of the replicas after the last round */
    double (*values)[3];          /* [2 x pixel_count] R, G, B of the mean, and these smoothed */
    aur_error_weight *weights;    /* [pixel_count] of the target's measure */
    aur_error_measure error_measure;
    aur_replica_measure measure;
    aur_error_interval intervals[AUR_ERROR_MEASURE_COUNT];
    double bound; /* of the error, from earlier rounds and emitters not hit yet: at least the interval's upper
                     end */
    double pooled;       /* the sum of variances pooled over all rounds, relative to that of the last one */
    double rate;         /* the error's square falls as samples^-rate */
    double finished;     /* samples per pixel of all replicas after the last complete round */
    double rays_before;  /* of the samples before the round that is planned or rendered */
    double rays_planned; /* predicted for that round at the cost per sample of earlier ones */
    size_t pattern_samples; /* of a pixel that complete a pattern: pixels get whole patterns */
    uint64_t rounds;
    uint64_t traced; /* rays that prepared it */
    uint64_t shared; /* cost of data shared with other candidates, whichever created it */
    uint64_t alone;  /* and what it does not share */
    bool begun;      /* a round is planned and not all rendered */
    bool looked_at;  /* the round planned last leads to the target, and may be the last of all */
    size_t replica;  /* replicas done of this round */
} aur_candidate;

/* `options` as for aur_replicas_create, with the candidate's integrator. The candidate must be released in
 * every case. Errors as there. */
aur_result aur_candidate_create(aur_renderer *renderer, const aur_render_options *options,
                                size_t replica_count, aur_error_measure measure, aur_candidate *candidate,
                                aur_error *error);
void aur_candidate_release(aur_candidate *candidate);

/* Adds the cost of a candidate, which may not have been created. */
void aur_candidate_add_spent(const aur_candidate *candidate, aur_spent *sum);

/* Computes `values` and `weights` from the films, as each round does. */
void aur_candidate_measure(aur_candidate *candidate);
/* Sets the weights and the interval by a measure that no round depends on. */
void aur_candidate_measure_by(aur_candidate *candidate, aur_error_measure measure, double confidence);
/* Sets `weights` to those of a measure, from the values of the last round. */
void aur_candidate_weigh(aur_candidate *candidate, aur_error_measure measure);

/* Stopping target; all zero: none. */
typedef struct aur_goal {
    double error, noise; /* of the error, what its bias leaves */
    uint64_t rays;       /* for this candidate's samples */
} aur_goal;

/* Levels of the noise, as squares relative to the target error's, at which rounds pause on their way to the
 * goal. There it is known whether the bias needs more room, which a lower level gives. */
#define AUR_NOISE_LEVEL (15.0 / 16)
#define AUR_NEXT_NOISE_LEVEL 0.8

/* Where rounds lead next, as a part of the noise's square of now. To an error: so that the interval's upper
 * end comes to six times that, then to each level, then to what the bias leaves, and below it by what the
 * error seen varies, so that the last round is seldom followed by another. One that follows lowers the error
 * by more than that: repeated tests on nearly the same samples bias the stopping time. Without an error half
 * as many samples again are taken, or fewer where the rays are spent then. It depends on the candidate and
 * its goal alone, so that a chosen candidate can be rendered again by itself. */
double aur_candidate_factor(const aur_candidate *candidate, const aur_goal *goal);

/* The rays until the bound of the noise is `noise`, at the cost per sample of earlier ones. */
double aur_candidate_rays_left(aur_candidate *candidate, double noise);

/* The round planned last leads to the error of the goal, and is seldom followed by another. */
bool aur_candidate_ends(const aur_candidate *candidate, const aur_goal *goal);

/* No sample has met light. */
bool aur_candidate_is_dark(const aur_candidate *candidate);
/* ... and further ones are not expected to: many were taken, and no visible emitter is known. */
bool aur_candidate_is_black(const aur_candidate *candidate);

/* Plans the samples of a round; the first is one pattern per pixel. If more than one round is needed for the
 * factor, all grow equally, so that the last is not a small one that nearly repeats the one before. False if
 * all pixels have their maximum. */
bool aur_candidate_plan(aur_candidate *candidate, double factor);
/* Renders the planned round. Errors: CANCELLED, after which another call continues the round. */
aur_result aur_candidate_render(aur_candidate *candidate, double confidence, const atomic_bool *cancelled,
                                aur_error *error);

/* Allocation of the next samples to pixels. */

enum { AUR_MOST_GROWTH = 4 }; /* of a pixel's samples in one round */

/* `variances` of the pixels with `targets` samples each; one more sample reduces a variance by variance /
 * samples^2. Raises the targets to whole numbers so that the sum of the variances falls by `factor` in (0,1)
 * at the least cost: samples in proportion to the root of a pixel's variance of one sample (Lagrange). No
 * pixel grows more than AUR_MOST_GROWTH times in one round, because a variance from few samples is uncertain.
 * All pixels get at least a quarter of the mean, and half of it up to 32 samples. False if no target was
 * raised: all pixels have `most` samples or no variance. */
bool aur_raise_targets(size_t count, const double *variances, double factor, uint32_t most,
                       uint32_t *targets);

/* The samples that are missing until the sum of the variances has fallen by `factor` so, in one round or
 * many: few where most of it is in few pixels. */
double aur_samples_left(size_t count, const double *variances, double factor, const uint32_t *targets);
