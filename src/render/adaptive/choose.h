/* Which integrator answers a wish. */
#pragma once

#include "render/adaptive/bias.h"
#include "render/adaptive/gather_size.h"
#include "render/adaptive/trial.h"
#include "render/scene/scene.h"

/* NAME[:key=value] as aur_render_options take it; NULL keeps the scene's own. A new text. `open` tells
 * whether nobody has said which, so that aur_ask_try may take another one. Errors: MEMORY. */
aur_result aur_ask_choose(const aur_scene *scene, const char *wanted, char **integrator, bool *open,
                          aur_error *error);

/* What a choice by trial takes and finds. */
typedef struct aur_choice {
    aur_goal goal;
    double seconds, confidence;
    size_t replica_count;
    const atomic_bool *cancelled;
    aur_trial trial; /* before: path tracing, which may not have begun; after: the one to go on with, which
                        the caller releases */
    aur_gather_size gather; /* where that is final gathering; else 0 */
    size_t candidates;      /* where that is path tracing with more than one; else 0 */
    aur_bias bias;          /* of the trial's integrator; 0 of path tracing */
    aur_spent others;       /* what the trials cost that are not gone on with */
} aur_choice;

/* Of the photons of a picture by that seed, as a key takes it. */
static inline uint64_t aur_ask_photon_seed(uint64_t seed) {
    return (seed & UINT32_MAX) + 1;
}

/* Path tracing has no bias; final gathering has less noise for its rays on most surfaces that scatter widely,
 * and the bias of its photon map. Path tracing is begun, until its error is some times the one asked, which
 * is cheap. Final gathering is then taken where a pilot of few pixels says that it comes to the error asked
 * with so many fewer rays that trying it pays, and where its bias is small beside that error, as pictures of
 * what paths find over what the photon map says tell. Errors: CANCELLED, MEMORY, and those of rendering. */
aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error);
