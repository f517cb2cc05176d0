/* Which integrator answers a wish. */
#pragma once

#include "ask/bias.h"
#include "ask/trial.h"
#include "scene/scene.h"

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
    aur_trial trial; /* path tracing before, the one to go on with after; the caller releases it */
    size_t photons;  /* of its maps where that is final gathering, else 0 */
    aur_bias bias;   /* of the trial's integrator; 0 of path tracing */
    aur_render_statistics others; /* what the trials cost that are not gone on with */
} aur_choice;

/* Final gathering in place of "path[:max_depth=D]", with the same max_depth, and more keys (",key=value"). A
 * new text, or NULL where memory is short. */
char *aur_ask_gather_instead(const char *path, size_t photons, const char *more);

/* Path tracing has no bias; final gathering has less noise for its rays on most surfaces that scatter widely,
 * and the bias of its photon map. Path tracing is begun, until its error is some times the one asked, which
 * is cheap. Final gathering is then taken where it is seen to come to the error asked with half of the rays
 * or less, and where its bias is small beside that error, as the differences of pictures with and without the
 * photon map tell. Errors:
 * CANCELLED, MEMORY, and those of rendering. */
aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error);
