#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/choose.h"
#include "ask/rounds.h"
#include "core/error.h"

/* Of the error asked, the bias that may be left; the noise makes the rest of the square. */
static const double BIAS_PART = 0.6;
/* Final gathering is worth it at this part of path tracing's rays: its rays cost more, for each ends at a
 * look at the photon map. Parts of path tracing's rays that may be spent on photon maps, on final gathering
 * until it can be compared, and on finding its bias: so one who goes on with path tracing has lost little. */
static const double WORTH = 0.5, MAP_PART = 0.05, PILOT_PART = 0.03, BIAS_SEARCH_PART = 0.2;
/* Tracing and sorting a photon takes the time of so many rays of path tracing: 2.4 in the Cornell box by
 * `render --stats`. Other scenes were not measured: a wrong ratio costs time, never truth. */
static const double RAYS_A_PHOTON = 2.5;
enum { MOST_PHOTONS = 500000, LEAST_PHOTONS = 15000 };

/* Few directions a sample: those of a pattern are for the samples of eight. */
#define GATHER "finalgather:split=8,diffuse_samples=16,glossy_samples=16,short_rays=4,photons=%zu"

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_trial *trial, double error) {
    const double part = error / trial->interval.high;
    return aur_trial_rays(trial) *
           aur_growth_to(trial->value_count, trial->variances, fmin(part * part, 1.0), trial->targets);
}

/* As many samples in every pixel. Samples that go where the first ones differ make a picture whose mean is
 * not quite that of its integrator, which would pass for a difference between integrators. */
static aur_result render_evenly(const aur_choice *choice, aur_trial *trial, uint32_t samples,
                                aur_error *error) {
    aur_trial_plan_evenly(trial, samples);
    return aur_trial_render(trial, choice->confidence, choice->cancelled, error);
}

/* The next round, as whoever goes on with the trial would plan it. False where no pixel can have more. */
static aur_result render_round(const aur_choice *choice, aur_trial *trial, bool *more, aur_error *error) {
    *more = aur_trial_plan(trial, trial->rounds > 0 ? aur_trial_factor(trial, &choice->goal) : 1.0);
    return *more ? aur_trial_render(trial, choice->confidence, choice->cancelled, error) : AUR_OK;
}

/* The part of the rays or of the time that is spent. */
static double part_spent(const aur_choice *choice, const aur_trial *trial) {
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    const double rays = choice->goal.rays > 0 ? (double)spent.rays / (double)choice->goal.rays : 0.0;
    const double seconds =
        choice->seconds > 0.0 ? (spent.prepare_seconds + spent.render_seconds) / choice->seconds : 0.0;
    return fmax(rays, seconds);
}

/* Path tracing until it has come so far that its error at the end can be told, which is that asked, or the
 * one when rays or time will be spent. */
static aur_result render_path(aur_choice *choice, double *wanted, aur_error *error) {
    aur_trial *const path = &choice->trial;
    aur_result result = AUR_OK;
    double left = 0.0;
    for (bool more = true; result == AUR_OK && more;) {
        const double spent = part_spent(choice, path);
        left = fmax(choice->goal.error, path->bound * sqrt(spent));
        if (path->rounds > 1 && path->bound <= AUR_PILOT_ERROR * left)
            break;
        result = render_round(choice, path, &more, error);
        more = more && !aur_trial_is_black(path);
    }
    *wanted = left;
    return result;
}

/* Photons of a map of each replica that cost little beside path tracing to the error wanted; 0: it is not
 * worth it. */
static size_t photons_for(const aur_choice *choice, double path_rays) {
    const double affordable = MAP_PART * path_rays / (RAYS_A_PHOTON * (double)choice->replica_count);
    size_t photons = MOST_PHOTONS;
    while ((double)photons > affordable && photons >= LEAST_PHOTONS)
        photons /= 2;
    return photons >= LEAST_PHOTONS ? photons : 0;
}

char *aur_ask_gather_instead(const char *path, size_t photons, const char *more) {
    const char *const keys = strchr(path, ':');
    const size_t capacity = sizeof GATHER + 20 + strlen(more) + (keys != NULL ? strlen(keys) + 1 : 0);
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity, GATHER "%s%s%s", photons, more, keys != NULL ? "," : "",
                 keys != NULL ? keys + 1 : "");
    return text;
}

/* What is compared with path tracing, and what its photon map is wrong by. */
typedef struct aur_rivals {
    aur_trial gather, difference;
} aur_rivals;

/* Samples a pixel at which the bound of a bias is thought to come to `most`, when it is known from `samples`:
 * what is uncertain of its square falls as they grow. */
static double samples_to_know(const aur_bias *bias, double most, double samples) {
    const double seen = fmax(bias->estimate, 0.0), room = most * most - seen;
    return room > 0.0 ? samples * (bias->high - seen) / room : INFINITY;
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left, or it is seen that it will not be before so many rays are
 * spent. */
static aur_result find_bias(const aur_choice *choice, aur_rivals *rivals, double mean, double most,
                            double most_rays, aur_bias *bias, aur_error *error) {
    for (uint32_t samples = 1;; samples *= 2) {
        const aur_result result = render_evenly(choice, &rivals->difference, samples, error);
        if (result != AUR_OK)
            return result;
        *bias = aur_replicas_bias(&rivals->difference.replicas, NULL, mean, choice->confidence);
        const double rays = aur_trial_rays(&rivals->difference);
        const double growth = fmax(samples_to_know(bias, most, samples) / samples, 2.0);
        if (sqrt(bias->high) <= most || sqrt(bias->low) > most || growth * rays > most_rays)
            return AUR_OK;
    }
}

static aur_result create_trial(aur_renderer *renderer, const aur_render_options *options,
                               const aur_choice *choice, const char *keys, aur_trial *trial,
                               aur_error *error) {
    trial->integrator = aur_ask_gather_instead(choice->trial.integrator, choice->photons, keys);
    if (trial->integrator == NULL)
        return aur_fail_memory(error);
    return aur_trial_create(renderer, options, choice->replica_count, trial, error);
}

static aur_result compare(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                          double wanted, aur_rivals *rivals, bool *better, aur_error *error) {
    const aur_trial *const path = &choice->trial;
    const double most_bias = BIAS_PART * wanted, noise = sqrt(wanted * wanted - most_bias * most_bias);
    const double path_rays = rays_to(path, wanted);
    aur_trial *const gather = &rivals->gather;
    aur_result result = AUR_OK;
    for (bool more = true; result == AUR_OK && more && !aur_trial_is_black(gather) &&
                           gather->bound > AUR_PILOT_ERROR * wanted &&
                           aur_trial_rays(gather) < PILOT_PART * path_rays;)
        result = render_round(choice, gather, &more, error);
    if (result != AUR_OK || aur_trial_is_black(gather) || rays_to(gather, noise) > WORTH * path_rays)
        return result;
    result = create_trial(renderer, options, choice, ",edges=0,debias=true,continued=1,incident=correction",
                          &rivals->difference, error);
    if (result == AUR_OK)
        result = find_bias(choice, rivals, path->measure.mean, most_bias, BIAS_SEARCH_PART * path_rays,
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
    double wanted;
    aur_result result = render_path(choice, &wanted, error);
    if (result != AUR_OK || path->bound <= wanted || aur_trial_is_black(path))
        return result;
    choice->photons = photons_for(choice, rays_to(path, wanted));
    if (choice->photons == 0)
        return AUR_OK;
    aur_rivals rivals = {0};
    aur_error refused;
    bool better = false;
    result = create_trial(renderer, options, choice, "", &rivals.gather, &refused);
    if (result == AUR_OK)
        result = compare(renderer, options, choice, wanted, &rivals, &better, error);
    else if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        result = AUR_OK; /* final gathering says that the scene is not for it */
    else if (error != NULL)
        *error = refused;
    if (better) {
        const aur_trial left = *path;
        *path = rivals.gather;
        rivals.gather = left;
    } else {
        choice->photons = 0;
        choice->bias = (aur_bias){0};
    }
    add_spent(&rivals.gather, &choice->others);
    add_spent(&rivals.difference, &choice->others);
    aur_trial_release(&rivals.gather);
    aur_trial_release(&rivals.difference);
    return result;
}
