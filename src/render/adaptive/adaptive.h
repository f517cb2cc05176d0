/* The inside of an image to a target: its candidate, and how that was chosen. */
#pragma once

#include <aureole-render/adaptive.h>

#include "points/base/cache.h"
#include "points/base/parallel.h"
#include "render/adaptive/candidate.h"
#include "render/race/race.h"
#include "render/replicas/bias.h"

struct aur_adaptive {
    aur_adaptive_options target;
    aur_renderer *renderer;
    aur_render_options options; /* of all candidates, except for the integrator; the texts are copies */
    char *sampler, *filter;
    aur_progress progress;
    aur_progress_share share;
    char *identity;          /* if the image is resumable; else NULL */
    aur_candidate candidate; /* that renders the image */
    aur_spent others;        /* what the race, rejected candidates and their corrections cost */
    aur_cache_uses uses;     /* of all of them */
    atomic_bool cancelled;
    bool open;  /* the integrator is not chosen yet */
    bool races; /* ... and that is going on */
    aur_race race;
    char *path;     /* the integrator of path tracing; NULL where the integrator is named */
    size_t rank;    /* of the candidate in the race */
    size_t row;     /* the candidate's in the table; AUR_RACE_PATH where the integrator is named */
    size_t photons; /* of each replica's map */
    double level; /* of noise that leaves room for the candidate's bias: a square, relative to the error's */
    aur_corrections corrections;
    bool unchecked;                         /* the bias was not bounded since the last round */
    aur_bias bias[AUR_ERROR_MEASURE_COUNT]; /* of the candidate, by each measure */
    uint64_t others_rounds, others_steps; /* whose errors by other measures than the target's are computed */
};

/* What the bias of a candidate may be, in the units of the target error. */
double aur_adaptive_bias_room(const aur_adaptive *adaptive);
/* The target of the rounds. What is spent otherwise and counts is taken from the rays. */
aur_goal aur_adaptive_goal(const aur_adaptive *adaptive);
/* Rays that count besides those of the candidate and its corrections. */
uint64_t aur_adaptive_other_rays(const aur_adaptive *adaptive);
/* Rays reserved for corrections of a candidate with bias, if the target is a number of rays. */
uint64_t aur_adaptive_reserve(const aur_adaptive *adaptive);
/* All that was rendered. */
aur_spent aur_adaptive_spent(const aur_adaptive *adaptive);

/* Replaces the candidate by one with `integrator`, a new string, and creates corrections if a row of the
 * table has a bias. Errors: those of aur_render_create. */
aur_result aur_adaptive_begin(aur_adaptive *adaptive, char *integrator, aur_error *error);
/* Starts the candidate of a row. Errors: those of aur_render_create. */
aur_result aur_adaptive_take(aur_adaptive *adaptive, size_t row, size_t photons, aur_error *error);
/* Runs the race and takes the winner. Errors: CANCELLED, after which it begins again; MEMORY and others. */
aur_result aur_adaptive_race(aur_adaptive *adaptive, aur_error *error);

/* Computes the errors of the last finished round by the measures that no round depends on, unless that was
 * done. */
void aur_adaptive_measure_others(aur_adaptive *adaptive);
/* Must be called after each round; `last`: the noise target is met. Renders corrections, bounds the bias, and
 * switches to the next candidate if it is, or may be, too large, or if too much is left to do: then `again`
 * is true, and rounds start again. */
aur_result aur_adaptive_check_round(aur_adaptive *adaptive, bool last, bool *again, aur_error *error);
