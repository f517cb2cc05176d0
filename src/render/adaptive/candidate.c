#include "render/adaptive/candidate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/film/integrator.h"

/* Samples without light after which an image is black: light that one of 8,192 samples meets is missed by all
 * with probability exp(-8). */
static const double DARK_SAMPLES = 65536.0;

/* Lamps that the camera sees, as the integrator shows them. */
static aur_result find_emitters(aur_candidate *candidate, const aur_scene *scene, uint64_t seed,
                                aur_error *error) {
    const aur_render *const render = candidate->replicas.renders[0];
    const aur_integrator *const integrator = aur_render_integrator(render);
    const aur_film_layout *const layout = &aur_render_film(render)->layout;
    if (!integrator->descriptor->shows_emitters || integrator->hides_emitters ||
        candidate->replicas.count == 1)
        return AUR_OK;
    const aur_result found =
        aur_visible_emitters_find(scene, layout, AUR_EMITTER_POINTS, seed, &candidate->visible, error);
    if (found != AUR_OK)
        return found;
    if (integrator->refines_emitter_edges)
        aur_visible_emitters_leave_edges(layout, &candidate->visible);
    aur_visible_emitters_take_probes(layout, integrator->emitter_probes, &candidate->visible);
    return AUR_OK;
}

static aur_result allocate(aur_candidate *candidate, aur_error *error) {
    const size_t pixels = candidate->replicas.pixel_count, values = candidate->value_count;
    const size_t blocks = candidate->replicas.columns * candidate->replicas.rows;
    aur_arena *const arena = &candidate->arena;
    const bool allocated =
        (candidate->targets = aur_arena_allocate(arena, values * sizeof *candidate->targets)) != NULL &&
        (candidate->earlier = aur_arena_allocate(arena, values * sizeof *candidate->earlier)) != NULL &&
        (candidate->variances = aur_arena_allocate(arena, values * sizeof *candidate->variances)) != NULL &&
        (candidate->measured = aur_arena_allocate(arena, values * sizeof *candidate->measured)) != NULL &&
        (candidate->needs = aur_arena_allocate(arena, values * sizeof *candidate->needs)) != NULL &&
        (candidate->blocks = aur_arena_allocate(arena, blocks * sizeof *candidate->blocks)) != NULL &&
        (candidate->scratch = aur_arena_allocate(arena, 2 * pixels * sizeof *candidate->scratch)) != NULL &&
        (candidate->light = aur_arena_allocate(arena, values * sizeof *candidate->light)) != NULL &&
        (candidate->values = aur_arena_allocate(arena, 2 * pixels * sizeof *candidate->values)) != NULL &&
        (candidate->weights = aur_arena_allocate(arena, pixels * sizeof *candidate->weights)) != NULL;
    return allocated ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_candidate_create(aur_renderer *renderer, const aur_render_options *options,
                                size_t replica_count, aur_error_measure measure, aur_candidate *candidate,
                                aur_error *error) {
    candidate->error_measure = measure;
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m)
        candidate->intervals[m] = (aur_error_interval){.estimate = INFINITY, .high = INFINITY};
    candidate->bound = INFINITY;
    candidate->pooled = 1.0;
    candidate->rate = 1.0;
    aur_cache *const cache = aur_renderer_cache(renderer);
    aur_cache_uses uses = {.outer = aur_cache_count(cache, NULL)};
    const uint64_t before = aur_rays_traced;
    aur_cache_count(cache, &uses);
    aur_result result = aur_replicas_create(renderer, options, candidate->integrator, replica_count,
                                            &candidate->replicas, error);
    aur_cache_count(cache, uses.outer);
    const uint64_t prepared = aur_rays_traced;
    candidate->shared = uses.rays;
    aur_cache_uses_release(&uses);
    if (result == AUR_OK) {
        const size_t pattern = aur_render_integrator(candidate->replicas.renders[0])->samples_a_pattern;
        candidate->pattern_samples = pattern > 0 ? pattern : 1;
        candidate->value_count = replica_count * candidate->replicas.pixel_count;
        result = allocate(candidate, error);
    }
    if (result == AUR_OK)
        result = find_emitters(candidate, aur_renderer_scene(renderer), options->seed, error);
    candidate->alone = aur_rays_traced - prepared;
    candidate->traced = aur_rays_traced - before;
    return result;
}

void aur_candidate_release(aur_candidate *candidate) {
    aur_replicas_release(&candidate->replicas);
    aur_arena_release(&candidate->arena);
    aur_visible_emitters_release(&candidate->visible);
    free(candidate->integrator);
    *candidate = (aur_candidate){0};
}

void aur_candidate_add_spent(const aur_candidate *candidate, aur_spent *sum) {
    aur_spent_add(sum, &candidate->replicas, candidate->traced);
    sum->budget += candidate->alone;
}

/* Where the error's square falls as samples^-rate. */
static double factor_to_error(const aur_candidate *candidate, double error) {
    if (!(candidate->bound < INFINITY))
        return 1.0 / AUR_MOST_GROWTH;
    const aur_error_interval *const interval = &candidate->intervals[candidate->error_measure];
    const double width = interval->high < INFINITY ? 1.0 - interval->estimate / interval->high : 0.0;
    const double margin = 0.98 - 0.7 * width, least_fall = fmin(0.005 + 1.5 * width, 0.3);
    const double fall = fmin(margin * error / candidate->bound, 1.0 - least_fall);
    return pow(fall * fall, 1.0 / candidate->rate);
}

/* Where rounds lead first, in target errors: variances of few samples are too uncertain to plan further. */
static const double FIRST_ERROR = 6.0;

/* The next level below the bound, but not below the goal. */
static double next_noise(const aur_candidate *candidate, const aur_goal *goal) {
    double square = AUR_NOISE_LEVEL * goal->error * goal->error;
    while (square > goal->noise * goal->noise && candidate->bound * candidate->bound <= square)
        square *= AUR_NEXT_NOISE_LEVEL;
    return fmax(sqrt(square), goal->noise);
}

double aur_candidate_factor(const aur_candidate *candidate, const aur_goal *goal) {
    const double growth = 1.5, first = FIRST_ERROR * goal->error;
    double factor = 1.0 / growth;
    if (goal->error > 0.0)
        factor = factor_to_error(candidate, candidate->bound > first ? first : next_noise(candidate, goal));
    if (goal->rays > 0)
        factor = fmax(factor, fmin(aur_replicas_rays(&candidate->replicas) / (double)goal->rays, 1.0));
    return factor;
}

bool aur_candidate_ends(const aur_candidate *candidate, const aur_goal *goal) {
    return candidate->looked_at && candidate->bound <= FIRST_ERROR * goal->error;
}

/* The nearest number of whole patterns to a target; or the next one, if `more` is almost a pattern. */
static uint32_t whole_patterns(const aur_candidate *candidate, size_t i, size_t more) {
    const size_t pattern = candidate->pattern_samples;
    const size_t rounded = (candidate->targets[i] + more) / pattern * pattern;
    return (uint32_t)fmin(fmax((double)rounded, candidate->earlier[i]), AUR_SAMPLES_PER_PIXEL_MAX);
}

/* Rounds targets to the nearest numbers of whole patterns; up if that would leave all unchanged. */
static void round_to_patterns(aur_candidate *candidate) {
    size_t more = candidate->pattern_samples / 2;
    bool raised = false;
    for (size_t i = 0; i < candidate->value_count; ++i)
        raised = raised || whole_patterns(candidate, i, more) > candidate->earlier[i];
    if (!raised)
        more = candidate->pattern_samples - 1;
    for (size_t i = 0; i < candidate->value_count; ++i)
        if (candidate->targets[i] > candidate->earlier[i])
            candidate->targets[i] = whole_patterns(candidate, i, more);
}

bool aur_candidate_is_dark(const aur_candidate *candidate) {
    return candidate->rounds > 0 && !(candidate->measure.mean > 0.0);
}

bool aur_candidate_is_black(const aur_candidate *candidate) {
    return aur_candidate_is_dark(candidate) && !(candidate->bound > 0.0);
}

/* A bound of the part of a value's variance due to emitters that replicas may not have hit yet. */
static double visible_variance(const aur_candidate *candidate, size_t i) {
    const aur_visible_emitters *const visible = &candidate->visible;
    const size_t pixel = i % candidate->replicas.pixel_count;
    const uint32_t samples = candidate->targets[i];
    const double variance = aur_visible_emitters_variance(visible, pixel, samples);
    if (variance == 0.0)
        return 0.0;
    const aur_rare_light rare = {variance, visible->share[pixel], samples, (double)candidate->replicas.count};
    return aur_error_variance_bound(candidate->error_measure, &candidate->weights[pixel], &rare);
}

/* The side of the cells of pixels that get samples together; 0: single pixels. */
static size_t cell_of(const aur_candidate *candidate) {
    const aur_render *const render = candidate->replicas.renders[0];
    return aur_render_integrator(render)->whole_tiles ? AUR_TILE_SIZE : aur_render_film(render)->layout.cell;
}

/* Variances by which samples are allocated: at least what emitters need that may have been missed. That part
 * is not pooled over rounds, since it vanishes with more samples much faster than variances fall. What a
 * pixel needs for an emitter is averaged over its cell: otherwise the others' samples exceed their targets,
 * and their variances, divided by targets, come out too high. Returns the sum; `emitters`: what they need. */
static double find_needs(aur_candidate *candidate, double *emitters) {
    double sum = 0.0;
    *emitters = 0.0;
    for (size_t i = 0; i < candidate->value_count; ++i) {
        const double visible = visible_variance(candidate, i);
        candidate->needs[i] = fmax(candidate->variances[i], visible);
        sum += candidate->needs[i];
        *emitters += visible;
    }
    const size_t cell = cell_of(candidate);
    if (cell > 0)
        aur_replicas_average(&candidate->replicas, cell, candidate->needs);
    return sum;
}

double aur_candidate_rays_left(aur_candidate *candidate, double noise) {
    double emitters, samples = 0.0;
    if (candidate->bound <= noise)
        return 0.0;
    find_needs(candidate, &emitters);
    for (size_t i = 0; i < candidate->value_count; ++i)
        samples += candidate->targets[i];
    const double factor = noise * noise / (candidate->bound * candidate->bound);
    return aur_samples_left(candidate->value_count, candidate->needs, factor, candidate->targets) / samples *
           aur_replicas_rays(&candidate->replicas);
}

/* A single replica, and dark images, have no variances by which samples could go to some pixels. */
static bool raise_evenly(aur_candidate *candidate, double factor) {
    bool raised = false;
    for (size_t i = 0; i < candidate->value_count; ++i) {
        const double goal = fmin(ceil(candidate->targets[i] / factor), AUR_SAMPLES_PER_PIXEL_MAX);
        raised = raised || goal > candidate->targets[i];
        candidate->targets[i] = (uint32_t)goal;
    }
    round_to_patterns(candidate);
    return raised;
}

bool aur_candidate_plan(aur_candidate *candidate, double factor) {
    const double rounds = fmax(ceil(-log(factor) / log(AUR_MOST_GROWTH)), 1.0);
    memcpy(candidate->earlier, candidate->targets, candidate->value_count * sizeof *candidate->targets);
    candidate->looked_at = rounds == 1.0;
    candidate->begun = candidate->rounds == 0;
    if (candidate->begun)
        for (size_t i = 0; i < candidate->value_count; ++i)
            candidate->targets[i] = (uint32_t)candidate->pattern_samples;
    else if (candidate->replicas.count == 1)
        candidate->begun = raise_evenly(candidate, factor);
    else {
        double emitters;
        find_needs(candidate, &emitters);
        candidate->begun =
            aur_raise_targets(candidate->value_count, candidate->needs, pow(factor, 1.0 / rounds),
                              AUR_SAMPLES_PER_PIXEL_MAX, candidate->targets) ||
            (aur_candidate_is_dark(candidate) && candidate->bound > 0.0 &&
             raise_evenly(candidate, 1.0 / AUR_MOST_GROWTH));
        round_to_patterns(candidate);
    }
    double before = 0.0, after = 0.0;
    for (size_t i = 0; i < candidate->value_count; ++i) {
        before += candidate->earlier[i];
        after += candidate->targets[i];
    }
    candidate->rays_before = aur_replicas_rays(&candidate->replicas);
    candidate->rays_planned = before > 0.0 ? candidate->rays_before * (after / before - 1.0) : 0.0;
    return candidate->begun;
}

/* The rate at which the square error falls with samples, from the last round: 1 for random numbers, up to 2
 * for quasi-Monte Carlo points. Rounds with few samples have little weight. */
static void learn_rate(aur_candidate *candidate, double earlier_error, double earlier_samples) {
    const double growth = log(candidate->finished / earlier_samples);
    if (!(earlier_error < INFINITY) || growth < log(1.5))
        return;
    const double rate =
        2.0 * log(earlier_error / candidate->intervals[candidate->error_measure].estimate) / growth;
    candidate->rate = fmin(fmax(rate, 1.0), 2.0);
}

/* What earlier rounds predict of variances in the last one. They fall as samples^-1 for random numbers, to
 * samples^-2 for quasi-Monte Carlo points: `part` of the second law and the rest of the first give the sum
 * that was measured. Edges of emitters, for which most first samples are taken, are closer to the second. */
typedef struct prediction {
    double random, quasi, measured; /* sums */
    double part;
} prediction;

/* A value of whose samples `share` are earlier ones. */
static void add_to_prediction(prediction *sum, double earlier, double share, double measured) {
    sum->random += earlier * share;
    sum->quasi += earlier * share * share;
    sum->measured += measured;
}

static void fit(prediction *sum) {
    const double range = sum->random - sum->quasi;
    sum->part = range > 0.0 ? fmin(fmax((sum->random - sum->measured) / range, 0.0), 1.0) : 0.0;
}

static double fall_of(const prediction *sum, double share) {
    return share * (1.0 + sum->part * (share - 1.0));
}

/* Pools the estimates of all rounds of how concentrated the error is on few pixels: averages of the last
 * round's and of what the earlier ones predict, as tr C^2 falls as the square of a variance. */
static void pool_blocks(aur_candidate *candidate) {
    const aur_replicas *const replicas = &candidate->replicas;
    const size_t count = replicas->columns * replicas->rows;
    double *const earlier = candidate->scratch, *const targets = candidate->scratch + count;
    double pooled = 0.0;
    prediction sum = {.part = 0.0};
    memset(candidate->scratch, 0, 2 * count * sizeof *candidate->scratch);
    for (size_t i = 0; i < candidate->value_count; ++i) {
        const size_t block = aur_replicas_block_of(replicas, i % replicas->pixel_count);
        earlier[block] += candidate->earlier[i];
        targets[block] += candidate->targets[i];
    }
    for (size_t b = 0; b < count; ++b)
        add_to_prediction(&sum, candidate->blocks[b].variance, earlier[b] / targets[b],
                          replicas->blocks[b].variance);
    fit(&sum);
    for (size_t b = 0; b < count; ++b) {
        const aur_block_spread *const now = &replicas->blocks[b];
        aur_block_spread *const pool = &candidate->blocks[b];
        const double fall = fall_of(&sum, earlier[b] / targets[b]), half = candidate->rounds > 1 ? 0.5 : 1.0;
        pool->variance = half * now->variance + (1.0 - half) * pool->variance * fall;
        pool->own = half * now->own + (1.0 - half) * pool->own * fall * fall;
        pool->spread = half * now->spread + (1.0 - half) * pool->spread * fall * fall;
        pooled += pool->variance;
    }
    candidate->pooled = sum.measured > 0.0 ? pooled / sum.measured : 1.0;
    aur_deviations_pool(&candidate->measure.deviations, replicas->count, replicas->columns, replicas->rows,
                        candidate->blocks);
}

/* The share of a value's samples that are from before the last round. */
static double share_of(const aur_candidate *candidate, size_t i) {
    return (double)candidate->earlier[i] / (double)candidate->targets[i];
}

/* Combines the last round's variances with the prediction from the rounds before. A variance from a few
 * replicas has few degrees of freedom: they may agree by chance in this round but did not in earlier ones. If
 * these showed more error, or emitters may have been missed, the bound has that variance beside the end of
 * the interval, which has the uncertainty of what was measured. */
static void pool_variances(aur_candidate *candidate) {
    prediction sum = {.part = 0.0};
    double emitters;
    for (size_t i = 0; i < candidate->value_count; ++i)
        add_to_prediction(&sum, candidate->variances[i], share_of(candidate, i), candidate->measured[i]);
    fit(&sum);
    for (size_t i = 0; i < candidate->value_count; ++i) {
        const double before = candidate->variances[i] * fall_of(&sum, share_of(candidate, i));
        const double now = candidate->measured[i];
        candidate->variances[i] = candidate->rounds > 1 ? 0.5 * (before + now) : now;
    }
    const double pooled = find_needs(candidate, &emitters);
    const aur_error_interval *const noise = &candidate->intervals[candidate->error_measure];
    const double count = (double)candidate->replicas.count; /* each replica is one part of the mean */
    if (!(candidate->measure.mean > 0.0))
        candidate->bound =
            emitters > 0.0 || candidate->finished * (double)candidate->replicas.pixel_count < DARK_SAMPLES
                ? INFINITY
                : 0.0;
    else if (sum.measured > 0.0)
        candidate->bound = hypot(noise->high, noise->estimate * sqrt(fmax(pooled / sum.measured - 1.0, 0.0)));
    else
        candidate->bound = sqrt(pooled / (count * 3.0 * (double)candidate->value_count));
}

void aur_candidate_weigh(aur_candidate *candidate, aur_error_measure measure) {
    const size_t count = candidate->replicas.pixel_count;
    aur_error_weigh(measure, count, (const double(*)[3])candidate->values,
                    (const double(*)[3])candidate->values + count, candidate->weights);
}

static aur_error_interval interval_of(const aur_candidate *candidate, const aur_replica_measure *measure,
                                      double confidence) {
    if (!(measure->mean > 0.0))
        return (aur_error_interval){.estimate = INFINITY, .low = INFINITY, .high = INFINITY, .degrees = 1.0};
    return aur_replica_interval(&measure->deviations, candidate->replicas.count,
                                3 * candidate->replicas.pixel_count, confidence);
}

void aur_candidate_measure(aur_candidate *candidate) {
    const aur_film_layout *const layout = &aur_render_film(candidate->replicas.renders[0])->layout;
    aur_replicas_mean(&candidate->replicas, candidate->light, candidate->values);
    aur_error_smooth(layout->x1 - layout->x0, layout->y1 - layout->y0, (const double(*)[3])candidate->values,
                     candidate->values + candidate->replicas.pixel_count);
    aur_candidate_weigh(candidate, candidate->error_measure);
}

static double mean_of(const aur_candidate *candidate) {
    const size_t count = candidate->replicas.pixel_count;
    double sum = 0.0;
    for (size_t i = 0; i < 3 * count; ++i)
        sum += candidate->values[i / 3][i % 3];
    return sum / (3.0 * (double)count);
}

/* By the target's measure; a single replica has no error. */
static void measure(aur_candidate *candidate, double confidence) {
    const aur_error_measure m = candidate->error_measure;
    aur_candidate_measure(candidate);
    if (candidate->replicas.count == 1) {
        candidate->measure.mean = mean_of(candidate);
        return;
    }
    aur_replicas_measure(&candidate->replicas, (const double(*)[3])candidate->light,
                         (aur_weighing){m, candidate->weights}, &candidate->measure, candidate->measured);
    pool_blocks(candidate);
    candidate->intervals[m] = interval_of(candidate, &candidate->measure, confidence);
}

void aur_candidate_measure_by(aur_candidate *candidate, aur_error_measure m, double confidence) {
    aur_replica_measure other;
    if (candidate->replicas.count == 1)
        return;
    aur_candidate_weigh(candidate, m);
    aur_replicas_measure(&candidate->replicas, (const double(*)[3])candidate->light,
                         (aur_weighing){m, candidate->weights}, &other, NULL);
    candidate->intervals[m] = interval_of(candidate, &other, confidence);
}

/* Converts variances of single samples to those of the replicas' values, averaged over units that get samples
 * together. */
static void smooth(aur_candidate *candidate) {
    const aur_replicas *const replicas = &candidate->replicas;
    const size_t cell = cell_of(candidate);
    if (!aur_render_integrator(replicas->renders[0])->whole_tiles)
        aur_replicas_smooth(replicas, candidate->measured, candidate->scratch);
    for (size_t i = 0; i < candidate->value_count; ++i)
        candidate->measured[i] /= candidate->targets[i];
    if (cell > 0)
        aur_replicas_average(replicas, cell, candidate->measured);
}

aur_result aur_candidate_render(aur_candidate *candidate, double confidence, const atomic_bool *cancelled,
                                aur_error *error) {
    const double earlier_error = candidate->intervals[candidate->error_measure].estimate;
    const double earlier_samples = candidate->finished;
    const aur_result result =
        aur_replicas_step(&candidate->replicas, candidate->targets, candidate->replicas.pixel_count,
                          &candidate->replica, cancelled, error);
    if (result != AUR_OK)
        return result;
    candidate->begun = false;
    ++candidate->rounds;
    aur_spent spent = {.budget = 0};
    aur_spent_add(&spent, &candidate->replicas, 0);
    candidate->finished = (double)spent.all.samples / (double)candidate->replicas.pixel_count;
    measure(candidate, confidence);
    if (candidate->replicas.count == 1)
        return AUR_OK;
    smooth(candidate);
    pool_variances(candidate);
    learn_rate(candidate, earlier_error, earlier_samples);
    return AUR_OK;
}
