#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/rivals.h"
#include "ask/rounds.h"
#include "core/error.h"
#include "film/film.h"
#include "render/renderer.h"

/* Final gathering is worth it at this part of path tracing's rays, all that it takes to know together: what
 * its rays cost differs by scene (in two boxes as much and half as much again as those of paths, in the room
 * nearly three times as much, where it was twice as slow as path tracing with .6), and a guess from few
 * pixels may be wrong. It is chosen: it costs time, never truth. */
static const double WORTH = 0.45;
/* Of path tracing's rays, what the pilot's map may cost: final gathering is not looked at in small pictures.
 */
static const double PILOT_PART = 0.01;
/* Of path tracing's rays, what it may cost to choose its candidates. */
static const double CANDIDATES_PART = 0.08;
/* Of final gathering's rays, what each further pilot may cost, which takes about twice the first one's. */
static const double FURTHER_PILOT_PART = 0.1;
/* More than so many times the rays of a first pattern are not spent on shared ones. What is shared comes to
 * whole tiles, so that a few pixels that have the error, as of a lamp's edge, would cost all about them. */
static const double MOST_GROWTH_SHARED = 2.0;

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_trial *trial, double error) {
    return aur_trial_rays(trial) * aur_trial_growth(trial, error);
}

/* The next round, as whoever goes on with the trial would plan it. False where no pixel can have more. */
static aur_result render_round(const aur_choice *choice, const aur_goal *goal, aur_trial *trial, bool *more,
                               aur_error *error) {
    aur_trial_look_ahead(trial, goal);
    *more = aur_trial_plan(trial, trial->rounds > 0 ? aur_trial_factor(trial, goal) : 1.0);
    return *more ? aur_trial_render(trial, choice->confidence, choice->cancelled, error) : AUR_OK;
}

/* The part of the rays or of the time that path tracing of the whole picture would have spent. */
static double part_spent(const aur_choice *choice, const aur_trial *path, double pixels) {
    aur_render_statistics spent;
    aur_trial_spent(path, &spent);
    const double rays = choice->goal.rays > 0 ? (double)spent.rays / (double)choice->goal.rays : 0.0;
    const double seconds =
        choice->seconds > 0.0 ? (spent.prepare_seconds + spent.render_seconds) / choice->seconds : 0.0;
    return pixels * fmax(rays, seconds);
}

/* Path tracing until it has come so far that its error at the end can be told, which is that asked, or the
 * one when rays or time will be spent. */
static aur_result render_path(const aur_choice *choice, aur_trial *path, aur_rivals *rivals,
                              aur_error *error) {
    aur_goal goal = choice->goal;
    goal.rays = (uint64_t)ceil((double)goal.rays / rivals->pixels);
    aur_result result = AUR_OK;
    double left = 0.0;
    for (bool more = true; result == AUR_OK && more;) {
        const double spent = part_spent(choice, path, rivals->pixels);
        left = fmax(goal.error, path->bound * sqrt(spent));
        if (path->rounds > 1 && path->bound <= AUR_PILOT_ERROR * left)
            break;
        result = render_round(choice, &goal, path, &more, error);
        more = more && !aur_trial_is_black(path);
    }
    rivals->wanted = left;
    return result;
}

static double noise_beside(double wanted, double square_bias) {
    return sqrt(fmax(wanted * wanted - square_bias, 0.0));
}

/* Without rays at edges, of which coarse pixels have more, and which cost little. */
static aur_pilot_outcome outcome_of(const aur_trial *pilot) {
    double rays = 0.0;
    for (size_t r = 0; r < pilot->replicas.count; ++r) {
        const aur_counters counted = aur_film_counted(aur_render_film(pilot->replicas.renders[r]));
        rays += (double)(counted.rays - counted.edge_rays);
    }
    return (aur_pilot_outcome){pilot->interval.estimate, rays / (double)pilot->replicas.pixel_count};
}

static aur_result render_pilot(const aur_rivals *rivals, const aur_render_options *coarse,
                               const aur_choice *choice, size_t lights, size_t bright, aur_trial *pilot,
                               aur_error *error) {
    char *const text = aur_ask_gather_pilot(choice->trial.integrator, choice->gather.seed, lights, bright);
    const aur_result result = aur_rivals_create(rivals, choice, coarse, text, pilot, error);
    bool goes_on;
    return result == AUR_OK ? render_round(choice, &choice->goal, pilot, &goes_on, error) : result;
}

/* Rays of final gathering whose bias is all that may be left. */
static double rays_planned(const aur_choice *choice, const aur_rivals *rivals) {
    return aur_rivals_gather_rays(rivals, choice, pow(AUR_BIAS_PART * rivals->wanted, 2.0));
}

/* What another pilot may cost. */
static double further_rays(const aur_choice *choice, const aur_rivals *rivals) {
    return FURTHER_PILOT_PART * rays_planned(choice, rivals);
}

/* Pilots of final gathering, with few points on lights and, where that costs little beside the picture, with
 * more, and then with points on bright texels. */
static aur_result render_pilots(const aur_render_options *coarse, const aur_choice *choice,
                                aur_rivals *rivals, aur_error *error) {
    aur_result result = render_pilot(rivals, coarse, choice, AUR_PILOT_LIGHTS, 0, &rivals->pilot, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->pilot))
        return result;
    const aur_pilot_outcome few = outcome_of(&rivals->pilot);
    rivals->pattern = aur_gather_pattern_of(few, few);
    if (2.0 * aur_trial_rays(&rivals->pilot) > further_rays(choice, rivals))
        return AUR_OK;
    result = render_pilot(rivals, coarse, choice, AUR_PILOT_LIGHTS_MORE, 0, &rivals->lit_pilot, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->lit_pilot))
        return result;
    const aur_pilot_outcome more = outcome_of(&rivals->lit_pilot);
    rivals->pattern = aur_gather_pattern_of(few, more);
    if (aur_trial_rays(&rivals->lit_pilot) > further_rays(choice, rivals))
        return AUR_OK;
    result = render_pilot(rivals, coarse, choice, AUR_PILOT_LIGHTS_MORE, AUR_PILOT_BRIGHT,
                          &rivals->bright_pilot, error);
    if (result == AUR_OK && !aur_trial_is_black(&rivals->bright_pilot))
        rivals->pattern = aur_gather_pattern_best(few, more, outcome_of(&rivals->bright_pilot));
    return result;
}

/* The pilots are rendered; at `worth` rays final gathering is worth it. */
static aur_result compare(aur_choice *choice, double worth, aur_rivals *rivals, bool *better,
                          aur_error *error) {
    const char *const path = choice->trial.integrator;
    const double rays = rays_planned(choice, rivals), wanted = rivals->wanted;
    if (rays > worth)
        return AUR_OK;
    choice->rays = rays;
    aur_result result = aur_rivals_find_map(rivals, choice, rays, worth, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= AUR_BIAS_PART * wanted))
        return result;
    choice->gather = aur_gather_size_of(&rivals->pattern, wanted, choice->bias.high, choice->gather.photons,
                                        choice->gather.seed);
    aur_trial *const gather = &rivals->gather;
    bool goes_on;
    result = aur_rivals_create(rivals, choice, rivals->options, aur_ask_gather(path, choice->gather), gather,
                               error);
    if (result == AUR_OK)
        result = render_round(choice, &choice->goal, gather, &goes_on, error);
    if (result != AUR_OK || aur_trial_is_black(gather))
        return result;
    const aur_bias sharing =
        aur_replicas_sharing_bias(&gather->replicas, gather->measure.mean, choice->confidence);
    choice->bias = aur_bias_of_both(choice->bias, sharing);
    const double noise = noise_beside(wanted, choice->bias.high);
    if (!(noise > 0.0) || (aur_gather_is_shared(choice->gather.directions) &&
                           aur_trial_growth(gather, noise) > MOST_GROWTH_SHARED))
        return AUR_OK;
    *better = rays_to(gather, noise) - aur_trial_rays(gather) <= worth;
    return result;
}

static double rays_of(const aur_trial *trial) {
    const bool made = trial->replicas.pixel_count > 0;
    return made ? aur_trial_rays(trial) : 0.0;
}

double aur_choice_part_done(const aur_choice *choice) {
    const aur_rivals *const rivals = choice->rivals;
    if (rivals == NULL || !(choice->rays > 0.0))
        return 0.0;
    const double gathered = rays_of(&rivals->gather);
    const double others = (double)choice->others.rays + rays_of(&choice->trial) + rays_of(&rivals->path) +
                          rays_of(&rivals->pilot) + rays_of(&rivals->lit_pilot) +
                          rays_of(&rivals->bright_pilot) + rays_of(&rivals->difference);
    return (others + gathered) / (others + fmax(choice->rays, gathered));
}

/* Final gathering beside path tracing, whose trial says what that takes. */
static aur_result compare_with(const aur_render_options *coarse, aur_choice *choice, const aur_trial *path,
                               aur_rivals *rivals, bool *better, aur_error *error) {
    const double rays = rivals->candidates.cost * rivals->pixels * rays_to(path, rivals->wanted);
    if (aur_photon_rays(AUR_PILOT_PHOTONS) > PILOT_PART * rays)
        return AUR_OK;
    choice->rays = WORTH * rays;
    aur_error refused;
    const aur_result result = render_pilots(coarse, choice, rivals, &refused);
    if (result == AUR_OK && aur_trial_is_black(&rivals->pilot))
        return AUR_OK;
    if (result == AUR_OK)
        return compare(choice, WORTH * (rays - rays_of(&choice->trial)), rivals, better, error);
    if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        return AUR_OK; /* final gathering says that the scene is not for it */
    if (error != NULL)
        *error = refused;
    return result;
}

/* Where there is a choice of points on lights, and where it costs little beside the picture. */
static aur_result choose_candidates(const aur_render_options *coarse, aur_choice *choice,
                                    const aur_trial *path, aur_rivals *rivals, aur_error *error) {
    const aur_scene *const scene = aur_renderer_scene(rivals->renderer);
    if (!aur_light_chooses(scene) && !aur_scene_has_environment(scene))
        return AUR_OK;
    const double sample = (double)choice->replica_count * aur_trial_rays(path) / path->samples;
    if (AUR_CANDIDATE_CHOICES * AUR_CANDIDATE_SAMPLES * sample >
        CANDIDATES_PART * rivals->pixels * rays_to(path, rivals->wanted))
        return AUR_OK;
    return aur_ask_candidates(rivals->renderer, coarse, choice, &rivals->candidates, &choice->others, error);
}

/* Path tracing with its candidates in place of that of the choice, which has not begun. Who looks at that
 * meanwhile finds it whole. */
static aur_result take_candidates(const aur_rivals *rivals, aur_choice *choice, aur_error *error) {
    const size_t candidates = rivals->candidates.count;
    aur_trial left = {0};
    const aur_result result = aur_rivals_create(
        rivals, choice, rivals->options, aur_ask_path(choice->trial.integrator, candidates), &left, error);
    if (result == AUR_OK) {
        const aur_trial taken = left;
        left = choice->trial;
        choice->trial = taken;
        choice->candidates = candidates;
    }
    aur_trial_release(&left);
    return result;
}

aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error) {
    aur_rivals rivals = {.renderer = renderer, .options = options, .pixels = 1.0, .candidates = {1, 1.0}};
    const aur_render_options coarse = aur_rivals_coarse(&rivals, &choice->trial, AUR_COARSE_PIXELS);
    aur_trial *const whole = &choice->trial;
    aur_trial *path = whole;
    bool better = false;

    aur_result result = AUR_OK;
    choice->rivals = &rivals;
    if (coarse.width < aur_render_film(whole->replicas.renders[0])->layout.width) {
        path = &rivals.path;
        result = aur_rivals_create(&rivals, choice, &coarse, strdup(whole->integrator), path, error);
        rivals.pixels = (double)whole->replicas.pixel_count / (double)path->replicas.pixel_count;
    }
    if (result == AUR_OK)
        result = render_path(choice, path, &rivals, error);
    choice->gather = (aur_gather_size){.seed = aur_ask_photon_seed(options->seed)};
    const bool goes_on = result == AUR_OK && path->bound > rivals.wanted && !aur_trial_is_black(path);
    if (goes_on && path != whole)
        result = choose_candidates(&coarse, choice, path, &rivals, error);
    if (goes_on && result == AUR_OK)
        result = compare_with(&coarse, choice, path, &rivals, &better, error);
    if (result == AUR_ERROR_MEMORY && choice->gather.photons > 0)
        result = aur_fail(error, result,
                          "out of memory: final gathering was tried with %zu photons; who names the "
                          "integrator '%s' needs none",
                          choice->gather.photons, whole->integrator);
    choice->rivals = NULL;
    if (better) {
        const aur_trial left = *whole;
        *whole = rivals.gather;
        rivals.gather = left;
    } else {
        choice->gather = (aur_gather_size){0};
        choice->bias = (aur_bias){0};
        if (result == AUR_OK && rivals.candidates.count > 1)
            result = take_candidates(&rivals, choice, error);
    }
    aur_trial *const left[] = {&rivals.path,         &rivals.pilot,      &rivals.lit_pilot,
                               &rivals.bright_pilot, &rivals.difference, &rivals.gather};
    for (size_t i = 0; i < sizeof left / sizeof left[0]; ++i) {
        aur_trial_add_spent(left[i], &choice->others);
        aur_trial_release(left[i]);
    }
    return result;
}
