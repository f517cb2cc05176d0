/* Which integrator answers a wish. */
#pragma once

#include <aureole-render/adaptive.h>

#include "points/base/cache.h"
#include "points/base/parallel.h"
#include "render/adaptive/candidate.h"
#include "render/adaptive/gather_size.h"
#include "render/adaptive/replicas.h"
#include "render/scene/scene.h"

/* How far two ways to render a picture are from each other in the mean: the bias of one, if the other has
 * none. */

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

/* NAME[:key=value] as aur_render_options take it; NULL keeps the scene's own. A new text. `open` tells
 * whether nobody has said which, so that aur_adaptive_try may take another one. Errors: MEMORY. */
aur_result aur_adaptive_choose(const aur_scene *scene, const char *wanted, char **integrator, bool *open,
                               aur_error *error);

/* What a choice by trial takes and finds. */
typedef struct aur_choice {
    aur_goal goal;
    double seconds, confidence;
    size_t replica_count;
    aur_error_measure measure;
    const atomic_bool *cancelled;
    aur_candidate candidate; /* before: path tracing, which may not have begun; after: the one to go on with,
                        which the caller releases */
    aur_gather_size gather;  /* where that is final gathering; else 0 */
    size_t candidates;       /* where that is path tracing with more than one; else 0 */
    aur_bias bias;           /* of the trial's integrator; 0 of path tracing */
    aur_spent others;        /* what the trials cost that are not gone on with */
} aur_choice;

/* Of the photons of a picture by that seed, as a key takes it. */
static inline uint64_t aur_adaptive_photon_seed(uint64_t seed) {
    return (seed & UINT32_MAX) + 1;
}

/* Path tracing has no bias; final gathering has less noise for its rays on most surfaces that scatter widely,
 * and the bias of its photon map. Path tracing is begun, until its error is some times the one asked, which
 * is cheap. Final gathering is then taken where a pilot of few pixels says that it comes to the error asked
 * with so many fewer rays that trying it pays, and where its bias is small beside that error, as pictures of
 * what paths find over what the photon map says tell. Errors: CANCELLED, MEMORY, and those of rendering. */
aur_result aur_adaptive_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                            aur_error *error);

/* The inside of an asking. */

struct aur_adaptive {
    aur_adaptive_options target;
    aur_renderer *renderer;
    aur_render_options options; /* of all trials, but for the integrator; the texts are the asking's */
    char *sampler, *filter;
    aur_progress progress;
    aur_progress_share share;
    char *identity;          /* of a resumable asking; else NULL */
    aur_candidate candidate; /* what the picture is made of */
    aur_bias bias;           /* of its integrator */
    aur_spent others;        /* what integrators cost that were tried and not taken */
    aur_cache_uses uses;     /* of all trials */
    atomic_bool cancelled;
    bool open;                /* another integrator may turn out better: that is not tried yet */
    const aur_choice *choice; /* while it is tried; else NULL */
    aur_gather_size gather;   /* where it was final gathering, else 0 */
    size_t candidates;        /* where it was path tracing with more than one, else 0 */
};

/* Go on with final gathering of that size, or path tracing with so many candidates, from nothing. Errors:
 * those of aur_render_create. */
aur_result aur_adaptive_take_gather(aur_adaptive *adaptive, aur_gather_size size, aur_error *error);
aur_result aur_adaptive_take_candidates(aur_adaptive *adaptive, size_t candidates, aur_error *error);
