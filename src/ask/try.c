#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/choose.h"
#include "ask/rounds.h"
#include "core/error.h"

/* Errors in units of the one asked: path tracing's when others are first compared with it, and the bias that
 * may be left, of whose square the noise makes the rest. */
static const double FIRST_ERROR = 5.0, BIAS_PART = 0.6;
/* The part of the rays of path tracing that finding a bias may take, and the part at which another integrator
 * is worth it: its rays cost more, for each ends at a look at the photon map. */
static const double TRIAL_PART = 0.35, WORTH = 0.5;

/* Few directions a sample: those of a pattern are for the samples of eight. */
#define GATHER "finalgather:split=8,diffuse_samples=16,glossy_samples=16,short_rays=4"

static double rays_of(const aur_trial *trial) {
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    return (double)spent.rays;
}

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_trial *trial, double error) {
    const double part = error / trial->interval.high;
    return rays_of(trial) *
           aur_growth_to(trial->value_count, trial->variances, fmin(part * part, 1.0), trial->targets);
}

static bool is_black(const aur_trial *trial) {
    return trial->rounds > 0 && !(trial->measure.mean > 0.0);
}

/* As many samples in every pixel. Samples that go where the first ones differ make a picture whose mean is
 * not quite that of its integrator, which would pass for a difference between integrators. */
static aur_result render_evenly(const aur_choice *choice, aur_trial *trial, uint32_t samples,
                                aur_error *error) {
    aur_trial_plan_evenly(trial, samples);
    return aur_trial_render(trial, choice->confidence, choice->cancelled, error);
}

/* Rounds until the noise is at most `error` or so many rays are spent. */
static aur_result render_to(const aur_choice *choice, aur_trial *trial, double error, double most_rays,
                            aur_error *failure) {
    aur_result result = AUR_OK;
    while (result == AUR_OK && trial->interval.high > error && rays_of(trial) < most_rays &&
           !is_black(trial) &&
           aur_trial_plan(trial, trial->rounds > 0 ? aur_trial_factor(trial, error) : 1.0))
        result = aur_trial_render(trial, choice->confidence, choice->cancelled, failure);
    return result;
}

char *aur_ask_gather_instead(const char *path, const char *more) {
    const char *const keys = strchr(path, ':');
    const size_t capacity = sizeof GATHER + strlen(more) + (keys != NULL ? strlen(keys) + 1 : 0);
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity, GATHER "%s%s%s", more, keys != NULL ? "," : "",
                 keys != NULL ? keys + 1 : "");
    return text;
}

/* What is compared with path tracing. */
typedef struct aur_rivals {
    aur_trial gather; /* with samples where they are needed */
    /* The same with as many samples in every pixel, and with all light of the photon map replaced by that of
     * paths. */
    aur_trial even, corrected;
} aur_rivals;

/* The bias of final gathering, from pictures with and without the map. They have the same seeds, camera rays
 * and gather rays, so that all that they have in common, above all the edges of lights, is not in their
 * differences. Both go on until it is known whether the bias is under what may be left, or until that has
 * cost so many rays. */
static aur_result find_bias(const aur_choice *choice, aur_rivals *rivals, double mean, double most,
                            double most_rays, aur_bias *bias, aur_error *error) {
    for (uint32_t samples = 1;; samples *= 2) {
        aur_result result = render_evenly(choice, &rivals->even, samples, error);
        if (result == AUR_OK)
            result = render_evenly(choice, &rivals->corrected, samples, error);
        if (result != AUR_OK)
            return result;
        *bias =
            aur_replicas_bias(&rivals->even.replicas, &rivals->corrected.replicas, mean, choice->confidence);
        /* At best the bound falls as samples grow. */
        const double growth = fmax(2.0, sqrt(bias->high) / most);
        if (sqrt(bias->high) <= most || sqrt(bias->low) > most ||
            growth * (rays_of(&rivals->even) + rays_of(&rivals->corrected)) > most_rays)
            return AUR_OK;
    }
}

static aur_result create_trial(aur_renderer *renderer, const aur_render_options *options,
                               const aur_choice *choice, const char *keys, aur_trial *trial,
                               aur_error *error) {
    trial->integrator = aur_ask_gather_instead(choice->trial.integrator, keys);
    if (trial->integrator == NULL)
        return aur_fail_memory(error);
    return aur_trial_create(renderer, options, choice->replica_count, trial, error);
}

static aur_result compare(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                          aur_rivals *rivals, bool *better, aur_error *error) {
    const aur_trial *const path = &choice->trial;
    const double wanted = choice->error, most_bias = BIAS_PART * wanted;
    const double noise = sqrt(wanted * wanted - most_bias * most_bias);
    aur_result result =
        render_to(choice, &rivals->gather, fmax(0.5 * path->interval.high, noise), rays_of(path), error);
    const double path_rays = rays_to(path, wanted);
    if (result != AUR_OK || is_black(&rivals->gather) || rays_to(&rivals->gather, noise) > WORTH * path_rays)
        return result;
    result = create_trial(renderer, options, choice, ",edges=0", &rivals->even, error);
    if (result == AUR_OK)
        result = create_trial(renderer, options, choice, ",edges=0,debias=true,continued=1",
                              &rivals->corrected, error);
    if (result == AUR_OK)
        result = find_bias(choice, rivals, path->measure.mean, most_bias, TRIAL_PART * path_rays,
                           &choice->bias, error);
    *better = result == AUR_OK && sqrt(choice->bias.high) <= most_bias;
    return result;
}

static void add_spent(const aur_trial *trial, aur_render_statistics *sum) {
    aur_render_statistics one;
    if (trial->replicas.count == 0)
        return;
    aur_trial_spent(trial, &one);
    sum->rays += one.rays;
    sum->prepare_seconds += one.prepare_seconds;
    sum->render_seconds += one.render_seconds;
    sum->cpu_seconds += one.cpu_seconds;
}

aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error) {
    aur_trial *const path = &choice->trial;
    aur_result result = render_to(choice, path, FIRST_ERROR * choice->error, INFINITY, error);
    if (result != AUR_OK || path->interval.high <= choice->error || is_black(path))
        return result;
    aur_rivals rivals = {0};
    aur_error refused;
    bool better = false;
    result = create_trial(renderer, options, choice, "", &rivals.gather, &refused);
    if (result == AUR_OK)
        result = compare(renderer, options, choice, &rivals, &better, error);
    else if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        result = AUR_OK; /* final gathering says that the scene is not for it */
    else if (error != NULL)
        *error = refused;
    if (better) {
        const aur_trial left = *path;
        *path = rivals.gather;
        rivals.gather = left;
        choice->gathers = true;
    } else {
        choice->bias = (aur_bias){0};
    }
    add_spent(&rivals.gather, &choice->others);
    add_spent(&rivals.even, &choice->others);
    add_spent(&rivals.corrected, &choice->others);
    aur_trial_release(&rivals.gather);
    aur_trial_release(&rivals.even);
    aur_trial_release(&rivals.corrected);
    return result;
}
