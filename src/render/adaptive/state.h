/* The inside of an asking. */
#pragma once

#include <aureole-render/ask.h>

#include "points/base/cache.h"
#include "points/base/progress.h"
#include "render/adaptive/choose.h"

struct aur_ask {
    aur_ask_options wish;
    aur_renderer *renderer;
    aur_render_options options; /* of all trials, but for the integrator; the texts are the asking's */
    char *sampler, *filter;
    aur_progress progress;
    aur_progress_share share;
    char *identity;      /* of a resumable asking; else NULL */
    aur_trial trial;     /* what the picture is made of */
    aur_bias bias;       /* of its integrator */
    aur_spent others;    /* what integrators cost that were tried and not taken */
    aur_cache_uses uses; /* of all trials */
    atomic_bool cancelled;
    bool open;                /* another integrator may turn out better: that is not tried yet */
    const aur_choice *choice; /* while it is tried; else NULL */
    aur_gather_size gather;   /* where it was final gathering, else 0 */
    size_t candidates;        /* where it was path tracing with more than one, else 0 */
};

/* Go on with final gathering of that size, or path tracing with so many candidates, from nothing. Errors:
 * those of aur_render_create. */
aur_result aur_ask_take_gather(aur_ask *ask, aur_gather_size size, aur_error *error);
aur_result aur_ask_take_candidates(aur_ask *ask, size_t candidates, aur_error *error);
