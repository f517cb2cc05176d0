#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/adaptive/adaptive.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* The largest square of a bias, relative to the target error's: less is left to the noise than a map is
 * worth.
 */
static const double BIAS_PART = 0.5;
/* The least square of the noise. */
static const double LEAST_LEVEL = 0.1;
/* The rays of corrections during the rounds, relative to the candidate's; and relative to a budget of rays.
 */
static const double CORRECTIONS_PART = 0.05;
/* Replicas of the race's blocks where the image has one. */
enum { COLOURS = 3, SPREAD = 4 };

static bool is_single(const aur_adaptive *adaptive) {
    return adaptive->target.replicas == 1;
}

/* --- targets */

uint64_t aur_adaptive_other_rays(const aur_adaptive *adaptive) {
    return adaptive->others.budget + adaptive->uses.rays - adaptive->candidate.shared;
}

/* Rays for samples and corrections. */
static uint64_t rays_left(const aur_adaptive *adaptive) {
    const uint64_t spent =
        aur_adaptive_other_rays(adaptive) + adaptive->candidate.shared + adaptive->candidate.alone;
    return adaptive->target.rays > spent ? adaptive->target.rays - spent : 1;
}

uint64_t aur_adaptive_reserve(const aur_adaptive *adaptive) {
    const bool corrects =
        adaptive->target.rays > 0 && aur_race_gathers(adaptive->row) && !is_single(adaptive);
    return corrects ? (uint64_t)(CORRECTIONS_PART * (double)rays_left(adaptive)) : 0;
}

double aur_adaptive_bias_room(const aur_adaptive *adaptive) {
    const aur_adaptive_options *const target = &adaptive->target;
    return aur_race_gathers(adaptive->row) ? target->error * sqrt(1.0 - adaptive->level) : target->bias;
}

aur_goal aur_adaptive_goal(const aur_adaptive *adaptive) {
    const aur_adaptive_options *const target = &adaptive->target;
    const double room = aur_adaptive_bias_room(adaptive);
    return (aur_goal){.error = target->error,
                      .noise = sqrt(fmax(target->error * target->error - room * room, 0.0)),
                      .rays = target->rays > 0 ? rays_left(adaptive) - aur_adaptive_reserve(adaptive) : 0};
}

aur_spent aur_adaptive_spent(const aur_adaptive *adaptive) {
    aur_spent sum = adaptive->races ? adaptive->race.spent : adaptive->others;
    aur_spent_add(&sum, &adaptive->corrections.replicas, 0);
    aur_candidate_add_spent(&adaptive->candidate, &sum);
    return sum;
}

/* --- candidates */

aur_result aur_adaptive_begin(aur_adaptive *adaptive, char *integrator, aur_error *error) {
    aur_candidate_release(&adaptive->candidate);
    aur_corrections_release(&adaptive->corrections);
    adaptive->others_rounds = adaptive->others_steps = 0;
    adaptive->candidate.integrator = integrator;
    aur_cache *const cache = aur_renderer_cache(adaptive->renderer);
    aur_cache_uses *const before = aur_cache_count(cache, &adaptive->uses);
    aur_result result =
        aur_candidate_create(adaptive->renderer, &adaptive->options, adaptive->target.replicas,
                             adaptive->target.measure, &adaptive->candidate, error);
    if (result == AUR_OK && aur_race_gathers(adaptive->row) && !is_single(adaptive)) {
        const uint64_t traced = aur_rays_traced;
        char *const text = aur_race_correction(adaptive->row, adaptive->path, adaptive->photons);
        result = text != NULL
                     ? aur_corrections_create(adaptive->renderer, &adaptive->options, text,
                                              adaptive->target.replicas, &adaptive->corrections, error)
                     : aur_fail_memory(error);
        adaptive->others.all.rays += aur_rays_traced - traced;
        free(text);
    }
    aur_cache_count(cache, before);
    return result;
}

aur_result aur_adaptive_take(aur_adaptive *adaptive, size_t row, size_t photons, aur_error *error) {
    const uint64_t seed = is_single(adaptive) ? aur_race_seed(&adaptive->options) : 0; /* its map may exist */
    char *const text = aur_race_integrator(row, adaptive->path, photons, seed);
    adaptive->row = row;
    adaptive->photons = photons;
    adaptive->level = AUR_NOISE_LEVEL;
    memset(adaptive->bias, 0, sizeof adaptive->bias);
    if (text == NULL)
        return aur_fail_memory(error);
    adaptive->open = true; /* nothing is saved while replicas and their maps are created */
    const aur_result result = aur_adaptive_begin(adaptive, text, error);
    adaptive->open = result != AUR_OK;
    return result != AUR_ERROR_MEMORY
               ? result
               : aur_fail(error, result,
                          "out of memory: '%s' was chosen; '--integrator %s' takes less memory",
                          adaptive->candidate.integrator, adaptive->path);
}

/* Continues with the candidate of this rank in the race. */
static aur_result take_ranked(aur_adaptive *adaptive, size_t rank, aur_error *error) {
    const aur_race *const race = &adaptive->race;
    const size_t row = race->order[rank];
    /* Without a target, bias is not worth as many photons; but denoisers keep the noise of a single map. */
    const double of_time = is_single(adaptive) ? 1.0 : 0.4;
    const double work = adaptive->target.rays > 0      ? (double)adaptive->target.rays
                        : adaptive->target.error > 0.0 ? race->entries[row].need
                                                       : of_time * race->work;
    adaptive->others = aur_adaptive_spent(adaptive);
    adaptive->rank = rank;
    return aur_adaptive_take(
        adaptive, row, aur_race_gathers(row) ? aur_race_photons(work, adaptive->target.replicas) : 0, error);
}

aur_result aur_adaptive_race(aur_adaptive *adaptive, aur_error *error) {
    const aur_film_layout *const layout = &aur_render_film(adaptive->candidate.replicas.renders[0])->layout;
    aur_race *const race = &adaptive->race;
    aur_race_release(race);
    *race = (aur_race){.renderer = adaptive->renderer,
                       .options = &adaptive->options,
                       .path = adaptive->path,
                       .width = layout->x1 - layout->x0,
                       .height = layout->y1 - layout->y0,
                       .replica_count = is_single(adaptive) ? SPREAD : adaptive->target.replicas,
                       .image_replicas = adaptive->target.replicas,
                       .measure = adaptive->target.measure,
                       .error = adaptive->target.error,
                       .budget = (double)adaptive->target.rays,
                       .seconds = adaptive->target.seconds,
                       .apart = adaptive->target.independent_pixels != 0,
                       .cancelled = &adaptive->cancelled,
                       .spent.all = adaptive->others.all};
    aur_cache *const cache = aur_renderer_cache(adaptive->renderer);
    aur_cache_uses *const before = aur_cache_count(cache, &adaptive->uses);
    adaptive->races = true;
    const aur_result result = aur_race_run(race, error);
    adaptive->races = false;
    aur_cache_count(cache, before);
    adaptive->others = race->spent; /* including an interrupted race */
    aur_race_release(race);
    return result == AUR_OK ? take_ranked(adaptive, 0, error) : result;
}

/* --- bias */

/* By the measure of the candidate's weights; irradiance shared by neighbours adds a bias. */
static void bound_bias_by(aur_adaptive *adaptive, aur_error_measure measure) {
    const aur_candidate *const candidate = &adaptive->candidate;
    const aur_film_layout *const layout = &aur_render_film(candidate->replicas.renders[0])->layout;
    adaptive->bias[measure] = aur_replicas_bias(
        &adaptive->corrections.replicas, layout->channel_count >= 2 * COLOURS ? &candidate->replicas : NULL,
        (aur_weighing){measure, candidate->weights}, (const double(*)[3])candidate->values,
        adaptive->target.confidence);
}

void aur_adaptive_measure_others(aur_adaptive *adaptive) {
    aur_candidate *const candidate = &adaptive->candidate;
    const aur_error_measure target = adaptive->target.measure;
    const uint64_t rounds = candidate->rounds, steps = adaptive->corrections.steps;
    if (adaptive->others_rounds == rounds && adaptive->others_steps == steps)
        return;
    for (size_t k = 1; k < AUR_ERROR_MEASURE_COUNT; ++k) {
        const aur_error_measure m = (aur_error_measure)((target + k) % AUR_ERROR_MEASURE_COUNT);
        aur_candidate_measure_by(candidate, m, adaptive->target.confidence);
        if (steps > 0 && !aur_candidate_is_dark(candidate))
            bound_bias_by(adaptive, m);
    }
    aur_candidate_weigh(candidate, target);
    adaptive->others_rounds = rounds;
    adaptive->others_steps = steps;
}

/* More samples narrow the interval of the bias, not more blocks. */
static bool are_samples_due(const aur_adaptive *adaptive) {
    const aur_corrections *const corrections = &adaptive->corrections;
    const aur_bias *const bias = &adaptive->bias[adaptive->target.measure];
    return bias->half * bias->half <= 2.0 * bias->of_noise * bias->of_noise ||
           corrections->rendered == corrections->blocks.count;
}

static aur_result correct(aur_adaptive *adaptive, aur_error *error) {
    const aur_result result =
        aur_corrections_grow(&adaptive->corrections, are_samples_due(adaptive), &adaptive->cancelled, error);
    bound_bias_by(adaptive, adaptive->target.measure);
    return result;
}

/* Continues with the next candidate in the race instead. */
static aur_result reject(aur_adaptive *adaptive, const char *reason, bool *again, aur_error *error) {
    aur_race_entry *const entry = &adaptive->race.entries[adaptive->row];
    *again = true;
    snprintf(entry->reason, sizeof entry->reason, "rejected: %s", reason);
    return take_ranked(adaptive, aur_race_next(&adaptive->race, adaptive->rank), error);
}

/* What is left to do, as a square of the noise, the rest of the error's square for the upper end of the bias,
 * and the rays of both, at the least work. The noise's square falls in proportion to one over rays, which go
 * to few pixels where it is concentrated; the width of the bias's interval too by more samples, but to the
 * root by more blocks. */
typedef struct rest_of_work {
    double noise, bias;
    double rays; /* INFINITY: the bias is larger than the error */
} rest_of_work;

static rest_of_work find_rest(aur_adaptive *adaptive) {
    enum { DIVISIONS = 64 };
    const aur_bias *const bias = &adaptive->bias[adaptive->target.measure];
    const double square = adaptive->target.error * adaptive->target.error;
    const double certain = fmax(bias->estimate - 0.5 * bias->half, 0.0);
    const double noise = adaptive->candidate.bound * adaptive->candidate.bound;
    const double level = adaptive->level * square;
    const double price =
        noise > level ? aur_candidate_rays_left(&adaptive->candidate, sqrt(level)) / (noise / level - 1.0)
                      : aur_replicas_rays(&adaptive->candidate.replicas);
    rest_of_work least = {0.0, 0.0, INFINITY};
    for (int k = 1; k < DIVISIONS && square > certain; ++k) {
        const double x = fmin((square - certain) * k / DIVISIONS, noise);
        const double growth = fmax((bias->high - certain) / (square - x - certain), 1.0);
        const double rays = (noise > x ? noise / x - 1.0 : 0.0) * price +
                            (pow(growth, are_samples_due(adaptive) ? 1.0 : 2.0) - 1.0) *
                                aur_replicas_rays(&adaptive->corrections.replicas);
        if (rays < least.rays)
            least = (rest_of_work){x, square - x, rays};
    }
    return least;
}

static bool is_met(const aur_adaptive *adaptive) {
    const size_t measure = adaptive->target.measure;
    return aur_bias_with_noise(&adaptive->bias[measure], adaptive->candidate.intervals[measure].estimate,
                               adaptive->candidate.bound) <= adaptive->target.error;
}

/* The noise leaves too little to the bias: more corrections if these are behind, else less noise. Rejects the
 * candidate if path tracing takes fewer rays from the start than are left here. */
static aur_result make_room(aur_adaptive *adaptive, const rest_of_work *rest, bool *again, aur_error *error) {
    const double bound = adaptive->candidate.bound / adaptive->target.error;
    const double least =
        fmax(adaptive->race.entries[AUR_RACE_PATH].need, aur_replicas_rays(&adaptive->candidate.replicas));
    if (!(rest->rays <= least) || adaptive->level < LEAST_LEVEL)
        return reject(adaptive, "more rays are needed to bound the bias of its photon map than are saved",
                      again, error);
    if (adaptive->bias[adaptive->target.measure].high > rest->bias)
        return correct(adaptive, error);
    while (adaptive->level >= bound * bound)
        adaptive->level *= AUR_NEXT_NOISE_LEVEL;
    *again = true;
    return AUR_OK;
}

static bool can_be_left(const aur_adaptive *adaptive) {
    return adaptive->target.error > 0.0 && adaptive->rank + 1 < adaptive->race.order_count;
}

/* More is left than another candidate is expected to need from its start, which then follows. The race's few
 * blocks see neither the noise of photon maps, which samples do not remove, nor rare bright paths. What is
 * left is known badly at first, too: once half of the other's need is spent, at most one and a half times
 * that need is lost, as far as it is right (ski rental with predictions, Purohit and others 2018). */
static bool is_overtaken(aur_adaptive *adaptive, const rest_of_work *rest) {
    const double spent = aur_replicas_rays(&adaptive->candidate.replicas);
    const double expected = adaptive->race.entries[adaptive->row].need, whole = spent + rest->rays;
    const double wrong = whole < INFINITY ? fmax(whole / expected, 1.0) : 1.0;
    return can_be_left(adaptive) &&
           aur_race_overtake(&adaptive->race, adaptive->rank, wrong, 2.0 * spent, rest->rays);
}

/* During rounds corrections have a part of the candidate's rays, or of a budget, if they are behind. */
static bool are_corrections_due(const aur_adaptive *adaptive, const rest_of_work *rest) {
    const double rays = aur_replicas_rays(&adaptive->candidate.replicas);
    const double reserve = adaptive->target.rays > 0 ? (double)aur_adaptive_reserve(adaptive) : INFINITY;
    const bool small = adaptive->bias[adaptive->target.measure].high <= rest->bias;
    if (adaptive->corrections.steps == 0)
        return true;
    return 1.5 * aur_replicas_rays(&adaptive->corrections.replicas) <=
               fmin(CORRECTIONS_PART * rays, reserve) &&
           !(adaptive->target.error > 0.0 && small);
}

aur_result aur_adaptive_check_round(aur_adaptive *adaptive, bool last, bool *again, aur_error *error) {
    const aur_bias *const bias = &adaptive->bias[adaptive->target.measure];
    const double square = adaptive->target.error * adaptive->target.error;
    const char *const behind = "more rays were left than the next one needs";
    aur_result result = AUR_OK;
    *again = false;
    adaptive->unchecked = true;
    const bool dark = aur_candidate_is_dark(&adaptive->candidate);
    if (adaptive->corrections.replicas.pixel_count == 0 || dark) {
        const rest_of_work rest = !dark && can_be_left(adaptive) ? find_rest(adaptive) : (rest_of_work){0};
        if (is_overtaken(adaptive, &rest))
            result = reject(adaptive, behind, again, error);
        adaptive->unchecked = result != AUR_OK;
        return result;
    }
    if (!last && adaptive->corrections.steps > 0) /* by the values of the round */
        bound_bias_by(adaptive, adaptive->target.measure);
    const bool ends = square > 0.0 && last && adaptive->candidate.bound <= aur_adaptive_goal(adaptive).noise;
    for (bool done = false; result == AUR_OK && !done;) {
        const rest_of_work rest = find_rest(adaptive);
        if (are_corrections_due(adaptive, &rest))
            result = correct(adaptive, error);
        else if (square > 0.0 && bias->low > BIAS_PART * square)
            result = reject(adaptive, "the bias of its photon map is too large for the target error", again,
                            error);
        else if (is_overtaken(adaptive, &rest))
            result = reject(adaptive, behind, again, error);
        else if (ends && !is_met(adaptive))
            result = make_room(adaptive, &rest, again, error);
        else
            done = true;
        done = done || *again;
    }
    adaptive->unchecked = result != AUR_OK;
    return result;
}
