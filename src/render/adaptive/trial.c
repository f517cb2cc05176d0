#include "render/adaptive/trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/film/integrator.h"

/* Lamps that the camera sees, as the integrator shows them. */
static aur_result find_lamps(aur_trial *trial, const aur_scene *scene, uint64_t seed, aur_error *error) {
    const aur_render *const render = trial->replicas.renders[0];
    const aur_integrator *const integrator = aur_render_integrator(render);
    const aur_film_layout *const layout = &aur_render_film(render)->layout;
    if (!integrator->descriptor->shows_lamps)
        return AUR_OK;
    const aur_result found = aur_lamps_find(scene, layout, AUR_LAMP_POINTS, seed, &trial->lamps, error);
    if (found != AUR_OK)
        return found;
    if (integrator->refines_lamp_edges)
        aur_lamps_leave_edges(layout, &trial->lamps);
    aur_lamps_take_looks(layout, integrator->lamp_looks, &trial->lamps);
    return AUR_OK;
}

aur_result aur_trial_create(aur_renderer *renderer, const aur_render_options *options, size_t replica_count,
                            aur_trial *trial, aur_error *error) {
    aur_render_options own = *options;
    own.integrator = trial->integrator;
    own.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    trial->interval = (aur_error_interval){.estimate = INFINITY, .high = INFINITY};
    trial->bound = INFINITY;
    trial->rate = 1.0;
    aur_cache *const cache = aur_renderer_cache(renderer);
    aur_cache_uses uses = {.outer = aur_cache_count(cache, NULL)};
    const uint64_t before = aur_rays_traced;
    aur_cache_count(cache, &uses);
    const aur_result result = aur_replicas_create(renderer, &own, replica_count, &trial->replicas, error);
    aur_cache_count(cache, uses.outer);
    trial->traced = aur_rays_traced - before;
    trial->shared = uses.rays;
    aur_cache_uses_release(&uses);
    if (result != AUR_OK)
        return result;
    const size_t pattern = aur_render_integrator(trial->replicas.renders[0])->samples_a_pattern;
    trial->pattern_samples = pattern > 0 ? pattern : 1;
    const size_t pixels = trial->replicas.pixel_count;
    trial->value_count = replica_count * pixels;
    trial->targets = calloc(trial->value_count, sizeof *trial->targets);
    trial->earlier = calloc(trial->value_count, sizeof *trial->earlier);
    trial->variances = calloc(trial->value_count, sizeof *trial->variances);
    trial->measured = calloc(trial->value_count, sizeof *trial->measured);
    trial->pixels = calloc(pixels, sizeof *trial->pixels);
    trial->spreads = calloc(pixels, sizeof *trial->spreads);
    trial->scratch = calloc(2 * pixels, sizeof *trial->scratch);
    const bool made = trial->targets != NULL && trial->earlier != NULL && trial->variances != NULL &&
                      trial->measured != NULL && trial->pixels != NULL && trial->spreads != NULL &&
                      trial->scratch != NULL;
    if (!made)
        return aur_fail_memory(error);
    const uint64_t prepared = aur_rays_traced;
    const aur_result found = find_lamps(trial, aur_renderer_scene(renderer), options->seed, error);
    trial->alone = aur_rays_traced - prepared;
    trial->traced += trial->alone;
    return found;
}

void aur_trial_release(aur_trial *trial) {
    aur_replicas_release(&trial->replicas);
    free(trial->targets);
    free(trial->earlier);
    free(trial->variances);
    free(trial->measured);
    free(trial->pixels);
    free(trial->spreads);
    free(trial->scratch);
    aur_lamps_release(&trial->lamps);
    free(trial->integrator);
    *trial = (aur_trial){0};
}

void aur_trial_spent(const aur_trial *trial, aur_render_statistics *sum) {
    *sum =
        (aur_render_statistics){.size = sizeof *sum, .rays = trial->traced + (uint64_t)aur_trial_rays(trial)};
    for (size_t r = 0; r < trial->replicas.count; ++r) {
        aur_render_statistics one = {.size = sizeof one};
        aur_render_get_statistics(trial->replicas.renders[r], &one, NULL);
        sum->samples += one.samples;
        sum->invalid_samples += one.invalid_samples;
        sum->cut_paths += one.cut_paths;
        sum->unsolved_weights += one.unsolved_weights;
        for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
            sum->levels[l] += one.levels[l];
        sum->prepare_seconds += one.prepare_seconds;
        sum->render_seconds += one.render_seconds;
        sum->cpu_seconds += one.cpu_seconds;
    }
}

void aur_trial_add_spent(const aur_trial *trial, aur_spent *sum) {
    aur_render_statistics one;
    aur_trial_spent(trial, &one);
    sum->rays += one.rays;
    sum->budget += one.rays - trial->traced + trial->alone;
    sum->prepare_seconds += one.prepare_seconds;
    sum->render_seconds += one.render_seconds;
    sum->cpu_seconds += one.cpu_seconds;
}

double aur_trial_rays(const aur_trial *trial) {
    uint64_t rays = 0;
    for (size_t r = 0; r < trial->replicas.count; ++r)
        rays += aur_film_counted(aur_render_film(trial->replicas.renders[r])).rays;
    return (double)rays;
}

double aur_goal_noise(const aur_goal *goal) {
    return sqrt(fmax(goal->error * goal->error - goal->bias * goal->bias, 0.0));
}

/* The bound for the planning of the next round, whose variances take half the place of those of all before:
 * of what these are above the ones seen now, half is left. */
static double bound_expected(const aur_trial *trial) {
    const double high = trial->interval.high, bound = trial->bound;
    return bound > high && high > 0.0 ? sqrt(0.5 * (high * high + bound * bound)) : bound;
}

/* Where the error's square falls as samples^-rate. */
static double factor_to_error(const aur_trial *trial, double error, double rate) {
    if (!(trial->bound < INFINITY))
        return 1.0 / AUR_MOST_GROWTH;
    const aur_error_interval *const seen = &trial->interval;
    const double width = seen->high < INFINITY ? 1.0 - seen->estimate / seen->high : 0.0;
    const double margin = 0.98 - 0.7 * width, least_fall = fmin(0.005 + 1.5 * width, 0.3);
    const double wanted = fmin(margin * error / bound_expected(trial), 1.0 - least_fall);
    return pow(wanted * wanted, 1.0 / rate);
}

double aur_trial_factor(const aur_trial *trial, const aur_goal *goal) {
    const double growth = 1.5, pilot = AUR_PILOT_ERROR * goal->error;
    double factor = 1.0 / growth;
    if (goal->error > 0.0)
        factor = factor_to_error(trial, trial->bound > pilot ? pilot : aur_goal_noise(goal), trial->rate);
    if (goal->rays > 0)
        factor = fmax(factor, fmin(aur_trial_rays(trial) / (double)goal->rays, 1.0));
    return factor;
}

/* The first samples may make the error fall faster than it does later: by the rate of six samples a pixel the
 * statue to 4 % seemed to need a fifth of the samples that it takes. */
double aur_trial_growth(const aur_trial *trial, double error) {
    const double most = 1.25; /* of path tracing by Sobol' points in the bundled scenes (bench/ask_speed.c) */
    const double factor = factor_to_error(trial, error, fmin(trial->rate, most));
    return aur_growth_to(trial->value_count, trial->variances, fmin(factor, 1.0), trial->targets);
}

void aur_trial_look_ahead(aur_trial *trial, const aur_goal *goal) {
    const double noise = aur_goal_noise(goal);
    const aur_integrator *const integrator = aur_render_integrator(trial->replicas.renders[0]);
    const bool lawful = !integrator->whole_tiles && trial->pattern_samples == 1;
    trial->whole = 0.0;
    if (trial->bound < INFINITY && noise > 0.0 && lawful)
        trial->whole = trial->samples * aur_trial_growth(trial, noise);
}

/* What the variances are thought to be with the samples that are planned. */
static void predict(aur_trial *trial) {
    for (size_t i = 0; i < trial->value_count; ++i)
        if (trial->targets[i] > trial->earlier[i])
            trial->variances[i] *= pow((double)trial->earlier[i] / (double)trial->targets[i], trial->rate);
}

static uint32_t whole_patterns(const aur_trial *trial, size_t i, size_t more) {
    const size_t rounded = (trial->targets[i] + more) / trial->pattern_samples * trial->pattern_samples;
    return (uint32_t)fmin(fmax((double)rounded, trial->earlier[i]), AUR_SAMPLES_PER_PIXEL_MAX);
}

/* Targets become the nearest numbers of whole patterns; up, where that would leave all as they were. */
static void round_to_patterns(aur_trial *trial) {
    size_t more = trial->pattern_samples / 2;
    bool raised = false;
    for (size_t i = 0; i < trial->value_count; ++i)
        raised = raised || whole_patterns(trial, i, more) > trial->earlier[i];
    if (!raised)
        more = trial->pattern_samples - 1;
    for (size_t i = 0; i < trial->value_count; ++i)
        if (trial->targets[i] > trial->earlier[i])
            trial->targets[i] = whole_patterns(trial, i, more);
}

bool aur_trial_is_black(const aur_trial *trial) {
    return trial->rounds > 0 && !(trial->bound > 0.0) && !(trial->measure.mean > 0.0);
}

void aur_trial_plan_evenly(aur_trial *trial, uint32_t samples) {
    memcpy(trial->earlier, trial->targets, trial->value_count * sizeof *trial->targets);
    for (size_t i = 0; i < trial->value_count; ++i)
        trial->targets[i] = samples;
    predict(trial);
    trial->begun = trial->looked_at = true;
}

bool aur_trial_plan(aur_trial *trial, double factor) {
    if (trial->rounds == 0) {
        aur_trial_plan_evenly(trial, (uint32_t)trial->pattern_samples);
        return true;
    }
    const double rounds = fmax(ceil(-log(factor) / log(AUR_MOST_GROWTH)), 1.0);
    memcpy(trial->earlier, trial->targets, trial->value_count * sizeof *trial->targets);
    trial->looked_at = rounds == 1.0;
    trial->begun = aur_raise_targets(trial->value_count, trial->variances, pow(factor, 1.0 / rounds),
                                     AUR_SAMPLES_PER_PIXEL_MAX, trial->targets);
    round_to_patterns(trial);
    predict(trial);
    return trial->begun;
}

/* The rate at which the square error falls with samples, from the last round: 1 for random numbers, up to 2
 * where quasi-Monte Carlo points do better. Rounds that added little tell little. */
static void learn_rate(aur_trial *trial, double earlier_error) {
    const double growth = log(trial->samples / trial->before);
    if (!(earlier_error < INFINITY) || growth < log(1.5))
        return;
    const double rate = 2.0 * log(earlier_error / trial->interval.estimate) / growth;
    trial->rate = fmin(fmax(rate, 1.0), 2.0);
}

/* The samples of a pixel in all replicas. */
static double samples_in(const aur_trial *trial, const uint32_t *samples, size_t pixel) {
    double sum = 0.0;
    for (size_t r = 0; r < trial->replicas.count; ++r)
        sum += samples[r * trial->replicas.pixel_count + pixel];
    return sum;
}

/* Puts a pixel's variance and spread of now together with those of the rounds before, half and half. The
 * spread is that of the variance so made: the square of a sum, whose own squares are told without bias. */
static void pool_pixel(aur_pixel_spread *pool, double before, double variance, double spread) {
    const double earlier = pool->variance * before;
    pool->spread = 0.25 * (pool->spread * before * before + 2.0 * earlier * variance + spread);
    pool->variance = 0.5 * (earlier + variance);
}

/* What all rounds say of how few pixels have the error. */
static void pool_pixels(aur_trial *trial) {
    const aur_replicas *const replicas = &trial->replicas;
    for (size_t i = 0; i < replicas->pixel_count; ++i) {
        double now = 0.0;
        for (size_t r = 0; r < replicas->count; ++r) {
            const size_t value = r * replicas->pixel_count + i;
            now += trial->measured[value] / trial->targets[value] / (double)replicas->count;
        }
        const double growth = samples_in(trial, trial->earlier, i) / samples_in(trial, trial->targets, i);
        if (trial->rounds > 1)
            pool_pixel(&trial->pixels[i], pow(growth, trial->rate), now, trial->spreads[i]);
        else
            trial->pixels[i] = (aur_pixel_spread){now, trial->spreads[i]};
    }
    aur_deviations_pool(&trial->measure.deviations, replicas->count, replicas->pixel_count, trial->pixels);
}

/* What is thought of the variances. */
typedef struct variance_sums {
    double measured, pooled, lamps; /* by the last round; by all; and of lamps that it need not have met */
} variance_sums;

/* Puts what the last round says of the variances together with what the rounds before led to expect. A
 * variance seen in a few replicas has few degrees of freedom: where they agree by chance now, they did not
 * always. */
static variance_sums pool_variances(aur_trial *trial) {
    const size_t pixels = trial->replicas.pixel_count;
    variance_sums sums = {.measured = 0.0};
    for (size_t i = 0; i < trial->value_count; ++i) {
        const double now = trial->measured[i];
        const double all = trial->rounds > 1 ? 0.5 * (trial->variances[i] + now) : now;
        const double lamps = aur_lamps_variance(&trial->lamps, i % pixels, trial->targets[i]);
        trial->variances[i] = fmax(all, lamps);
        sums.measured += now;
        sums.pooled += trial->variances[i];
        sums.lamps += lamps;
    }
    return sums;
}

/* The interval's end where the rounds before told of more error, or lamps do that were not met. */
static double bound_of(const aur_trial *trial, const variance_sums *sums) {
    if (!(trial->measure.mean > 0.0))
        return sums->lamps > 0.0 ? INFINITY : 0.0;
    if (sums->measured > 0.0)
        return trial->interval.high * sqrt(fmax(sums->pooled / sums->measured, 1.0));
    const double count = (double)trial->replicas.count; /* each replica has one part of the mean */
    return sqrt(sums->pooled / (count * 3.0 * (double)trial->value_count)) / trial->measure.mean;
}

static void plan_samples(aur_trial *trial) {
    double sum = 0.0;
    for (size_t i = 0; i < trial->value_count; ++i)
        sum += trial->targets[i];
    trial->before = trial->samples;
    trial->samples = sum / (double)trial->replicas.pixel_count;
}

aur_result aur_trial_render(aur_trial *trial, double confidence, const atomic_bool *cancelled,
                            aur_error *error) {
    const double earlier_error = trial->interval.estimate;
    aur_replicas *const replicas = &trial->replicas;
    plan_samples(trial);
    for (trial->replica = 0; trial->replica < replicas->count; ++trial->replica) {
        aur_result result = atomic_load(cancelled) ? AUR_ERROR_CANCELLED : AUR_OK;
        if (result == AUR_OK)
            result = aur_render_step_pixels(replicas->renders[trial->replica], replicas->pixel_count,
                                            trial->targets + trial->replica * replicas->pixel_count, error);
        if (result != AUR_OK) {
            trial->samples = trial->before;
            return result;
        }
    }
    trial->begun = false;
    ++trial->rounds;
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    trial->samples = (double)spent.samples / (double)replicas->pixel_count;
    const aur_pixel_measure pixels = {trial->measured, trial->spreads};
    aur_replicas_measure(replicas, &trial->measure, &pixels);
    pool_pixels(trial);
    if (aur_render_integrator(replicas->renders[0])->whole_tiles)
        aur_replicas_average_tiles(replicas, trial->targets, trial->measured);
    else
        aur_replicas_smooth(replicas, trial->targets, trial->measured, trial->scratch);
    const aur_error_interval absolute = aur_replica_interval(&trial->measure.deviations, replicas->count,
                                                             3 * replicas->pixel_count, confidence);
    const double mean = trial->measure.mean;
    trial->interval = (aur_error_interval){.estimate = mean > 0.0 ? absolute.estimate / mean : INFINITY,
                                           .low = mean > 0.0 ? absolute.low / mean : INFINITY,
                                           .high = mean > 0.0 ? absolute.high / mean : INFINITY,
                                           .degrees = absolute.degrees};
    const variance_sums sums = pool_variances(trial);
    trial->bound = bound_of(trial, &sums);
    learn_rate(trial, earlier_error);
    return AUR_OK;
}
