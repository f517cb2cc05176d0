#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/adaptive/comparison.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Final gathering is worth it at this part of path tracing's rays, all that it takes to know together: what
 * its rays cost differs by scene (in two boxes as much and half as much again as those of paths, in the room
 * nearly three times as much, where it was twice as slow as path tracing with .6), and a guess from few
 * pixels may be wrong: of the plates to 5 % by three times. It is chosen: it costs time, never truth. */
static const double WORTH = 0.5;
/* Of path tracing's rays, what the pilot's map may cost: final gathering is not looked at in small pictures.
 */
static const double PILOT_PART = 0.01;
/* Of path tracing's rays, what it may cost to choose its candidates. */
static const double CANDIDATES_PART = 0.12;

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_candidate *candidate, double error) {
    return aur_candidate_rays(candidate) * aur_candidate_growth(candidate, error);
}

/* The part of the rays or of the time that path tracing of the whole picture would have spent. */
static double part_spent(const aur_choice *choice, const aur_candidate *path, double pixels) {
    aur_render_statistics spent;
    aur_candidate_spent(path, &spent);
    const double rays = choice->goal.rays > 0 ? aur_candidate_rays(path) / (double)choice->goal.rays : 0.0;
    const double seconds =
        choice->seconds > 0.0 ? (spent.prepare_seconds + spent.render_seconds) / choice->seconds : 0.0;
    return pixels * fmax(rays, seconds);
}

/* Path tracing until it has come so far that its error at the end can be told, which is that asked, or the
 * one when rays or time will be spent. */
static aur_result render_path(const aur_choice *choice, aur_candidate *path, aur_comparison *comparison,
                              aur_error *error) {
    aur_goal goal = choice->goal;
    goal.rays = (uint64_t)ceil((double)goal.rays / comparison->pixels);
    aur_result result = AUR_OK;
    double left = 0.0;
    for (bool more = true; result == AUR_OK && more;) {
        const double spent = part_spent(choice, path, comparison->pixels);
        left = fmax(goal.error, path->bound * sqrt(spent));
        if (path->rounds > 1 && path->bound <= AUR_PILOT_ERROR * left)
            break;
        result = aur_comparison_round(choice, &goal, path, &more, error);
        more = more && !aur_candidate_is_black(path);
    }
    comparison->wanted = comparison->path_error = left;
    return result;
}

/* At more than so many times the rays of a first pattern that is shared, one that is not takes its place. It
 * is chosen: it costs time, never truth. */
static const double MOST_GROWTH_SHARED = 2.0;

static double noise_beside(double wanted, double square_bias) {
    return sqrt(fmax(wanted * wanted - square_bias, 0.0));
}

static void leave(aur_candidate *candidate, aur_choice *choice) {
    aur_candidate_add_spent(candidate, &choice->others);
    aur_candidate_release(candidate);
}

/* The first pattern of the picture beside the map's bias, and the noise that may be left beside that and what
 * sharing adds. */
static aur_result render_pattern(aur_choice *choice, aur_comparison *comparison, aur_bias map, double *noise,
                                 aur_error *error) {
    choice->gather = aur_gather_size_of(&comparison->model, comparison->wanted, map.high,
                                        choice->gather.photons, choice->gather.seed);
    aur_candidate *const gather = &comparison->gather;
    bool goes_on;
    aur_result result = aur_comparison_create(
        comparison, choice, comparison->options,
        aur_adaptive_gather(choice->candidate.integrator, choice->gather), gather, error);
    if (result == AUR_OK)
        result = aur_comparison_round(choice, &choice->goal, gather, &goes_on, error);
    if (result != AUR_OK || aur_candidate_is_black(gather))
        return result;
    choice->bias = aur_bias_of_both(
        map, aur_replicas_sharing_bias(&gather->replicas, gather->measure.mean, choice->confidence));
    *noise = noise_beside(comparison->wanted, choice->bias.high);
    return AUR_OK;
}

/* More samples of what is shared come to whole tiles, so that places that are hard, as those about a lamp's
 * image in a mirror, cost all that is beside them. */
static bool is_better_alone(const aur_choice *choice, const aur_candidate *gather, double noise) {
    return aur_gather_is_shared(choice->gather.directions) &&
           (!(noise > 0.0) || aur_candidate_growth(gather, noise) > MOST_GROWTH_SHARED);
}

/* The pilots are rendered; at `worth` rays final gathering is worth it. */
static aur_result compare(aur_choice *choice, double worth, aur_comparison *comparison, bool *better,
                          aur_error *error) {
    aur_candidate *const gather = &comparison->gather;
    const double rays = aur_comparison_planned_rays(comparison, choice);
    double noise = 0.0;
    if (rays > worth)
        return AUR_OK;
    aur_result result = aur_comparison_find_map(comparison, choice, rays, worth, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= AUR_BIAS_PART * comparison->path_error))
        return result;
    const aur_bias map = choice->bias;
    comparison->wanted = fmax(comparison->wanted, sqrt(map.high) / AUR_BIAS_PART);
    result = render_pattern(choice, comparison, map, &noise, error);
    if (result == AUR_OK && !aur_candidate_is_black(gather) && is_better_alone(choice, gather, noise)) {
        comparison->model.alone = true;
        leave(gather, choice);
        result = render_pattern(choice, comparison, map, &noise, error);
    }
    noise = noise_beside(comparison->path_error, choice->bias.high);
    if (result == AUR_OK && !aur_candidate_is_black(gather) && noise > 0.0)
        *better = rays_to(gather, noise) - aur_candidate_rays(gather) <= worth;
    return result;
}

static double rays_of(const aur_candidate *candidate) {
    const bool made = candidate->replicas.pixel_count > 0;
    return made ? aur_candidate_rays(candidate) : 0.0;
}

/* What path tracing of the whole picture takes to the error asked, or all rays that will be spent. */
static double rays_of_path(const aur_choice *choice, const aur_candidate *path,
                           const aur_comparison *comparison) {
    if (choice->goal.error > 0.0)
        return comparison->candidates.cost * comparison->pixels * rays_to(path, comparison->wanted);
    return comparison->pixels * aur_candidate_rays(path) / part_spent(choice, path, comparison->pixels);
}

/* Final gathering beside path tracing, whose trial says what that takes. */
static aur_result compare_with(const aur_render_options *coarse, aur_choice *choice, aur_candidate *path,
                               aur_comparison *comparison, bool *better, aur_error *error) {
    const double rays = rays_of_path(choice, path, comparison);
    if (aur_photon_rays(AUR_PILOT_PHOTONS) > PILOT_PART * rays)
        return AUR_OK;
    aur_error refused;
    const double worth = WORTH * (rays - rays_of(&choice->candidate));
    const aur_result result = aur_comparison_render_pilots(comparison, coarse, choice, worth, path, &refused);
    if (result == AUR_OK && aur_candidate_is_black(&comparison->pilots[AUR_PILOT_FEW]))
        return AUR_OK;
    if (result == AUR_OK)
        return compare(choice, worth, comparison, better, error);
    if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        return AUR_OK; /* final gathering says that the scene is not for it */
    if (error != NULL)
        *error = refused;
    return result;
}

/* Where there is a choice of points on lights, and where it costs little beside the picture. */
static aur_result choose_candidates(const aur_render_options *coarse, aur_choice *choice,
                                    const aur_candidate *path, aur_comparison *comparison, aur_error *error) {
    const aur_scene *const scene = aur_renderer_scene(comparison->renderer);
    if (!aur_light_chooses(scene) && !aur_scene_has_environment(scene))
        return AUR_OK;
    const double sample = (double)choice->replica_count * aur_candidate_rays(path) / path->samples;
    if (AUR_CANDIDATE_CHOICES * AUR_CANDIDATE_SAMPLES * sample >
        CANDIDATES_PART * comparison->pixels * rays_to(path, comparison->wanted))
        return AUR_OK;
    return aur_adaptive_candidates(comparison->renderer, coarse, choice, &comparison->candidates,
                                   &choice->others, error);
}

/* Path tracing with its candidates in place of that of the choice, which has not begun. Who looks at that
 * meanwhile finds it whole. */
static aur_result take_candidates(const aur_comparison *comparison, aur_choice *choice, aur_error *error) {
    const size_t candidates = comparison->candidates.count;
    aur_candidate left = {0};
    const aur_result result =
        aur_comparison_create(comparison, choice, comparison->options,
                              aur_adaptive_path(choice->candidate.integrator, candidates), &left, error);
    if (result == AUR_OK) {
        const aur_candidate taken = left;
        left = choice->candidate;
        choice->candidate = taken;
        choice->candidates = candidates;
    }
    leave(&left, choice);
    return result;
}

aur_result aur_adaptive_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                            aur_error *error) {
    aur_comparison comparison = {
        .renderer = renderer, .options = options, .pixels = 1.0, .candidates = {1, 1.0}};
    const aur_render_options coarse =
        aur_comparison_coarse(&comparison, &choice->candidate, AUR_COARSE_PIXELS);
    aur_candidate *const whole = &choice->candidate;
    aur_candidate *path = whole;
    bool better = false;

    aur_result result = AUR_OK;
    if (coarse.width < aur_render_film(whole->replicas.renders[0])->layout.width) {
        path = &comparison.path;
        result = aur_comparison_create(&comparison, choice, &coarse, strdup(whole->integrator), path, error);
        comparison.pixels = (double)whole->replicas.pixel_count / (double)path->replicas.pixel_count;
    }
    if (result == AUR_OK)
        result = render_path(choice, path, &comparison, error);
    choice->gather = (aur_gather_size){.seed = aur_adaptive_photon_seed(options->seed)};
    const bool goes_on = result == AUR_OK && path->bound > comparison.wanted && !aur_candidate_is_black(path);
    if (goes_on && path != whole)
        result = choose_candidates(&coarse, choice, path, &comparison, error);
    if (goes_on && result == AUR_OK)
        result = compare_with(&coarse, choice, path, &comparison, &better, error);
    if (result == AUR_ERROR_MEMORY && choice->gather.photons > 0)
        result = aur_fail(error, result,
                          "out of memory: final gathering was tried with %zu photons; who names the "
                          "integrator '%s' needs none",
                          choice->gather.photons, whole->integrator);
    if (better) {
        const aur_candidate left = *whole;
        *whole = comparison.gather;
        comparison.gather = left;
    } else {
        choice->gather = (aur_gather_size){0};
        choice->bias = (aur_bias){0};
        if (result == AUR_OK && comparison.candidates.count > 1)
            result = take_candidates(&comparison, choice, error);
    }
    for (size_t i = 0; i < AUR_PILOT_KINDS; ++i)
        leave(&comparison.pilots[i], choice);
    leave(&comparison.path, choice);
    leave(&comparison.difference, choice);
    leave(&comparison.gather, choice);
    return result;
}
