#include "ask/trial.h"

#include <math.h>
#include <stdlib.h>

#include "ask/rounds.h"
#include "core/error.h"
#include "film/film.h"
#include "render/stopwatch.h"

aur_result aur_trial_create(aur_renderer *renderer, const aur_render_options *options, size_t replica_count,
                            aur_trial *trial, aur_error *error) {
    aur_render_options own = *options;
    own.integrator = trial->integrator;
    own.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    trial->interval = (aur_error_interval){.estimate = INFINITY, .high = INFINITY};
    trial->rate = 1.0;
    const aur_result result = aur_replicas_create(renderer, &own, replica_count, &trial->replicas, error);
    if (result != AUR_OK)
        return result;
    const size_t pixels = trial->replicas.pixel_count;
    trial->value_count = replica_count * pixels;
    trial->targets = calloc(trial->value_count, sizeof *trial->targets);
    trial->variances = calloc(trial->value_count, sizeof *trial->variances);
    trial->scratch = calloc(pixels, sizeof *trial->scratch);
    return trial->targets != NULL && trial->variances != NULL && trial->scratch != NULL
               ? AUR_OK
               : aur_fail_memory(error);
}

void aur_trial_release(aur_trial *trial) {
    aur_replicas_release(&trial->replicas);
    free(trial->targets);
    free(trial->variances);
    free(trial->scratch);
    free(trial->integrator);
    *trial = (aur_trial){0};
}

void aur_trial_spent(const aur_trial *trial, aur_render_statistics *sum) {
    *sum = (aur_render_statistics){.size = sizeof *sum};
    for (size_t r = 0; r < trial->replicas.count; ++r) {
        aur_render_statistics one = {.size = sizeof one};
        aur_render_get_statistics(trial->replicas.renders[r], &one, NULL);
        sum->rays += one.rays;
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

double aur_trial_rays(const aur_trial *trial) {
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    return (double)spent.rays;
}

double aur_goal_noise(const aur_goal *goal) {
    return sqrt(fmax(goal->error * goal->error - goal->bias * goal->bias, 0.0));
}

static double factor_to_error(const aur_trial *trial, double error) {
    const aur_error_interval *const seen = &trial->interval;
    const double width = seen->high < INFINITY ? 1.0 - seen->estimate / seen->high : 0.0;
    const double margin = 0.98 - 0.7 * width, least_fall = fmin(0.005 + 1.5 * width, 0.3);
    const double wanted = fmin(margin * error / seen->high, 1.0 - least_fall);
    return pow(wanted * wanted, 1.0 / trial->rate);
}

double aur_trial_factor(const aur_trial *trial, const aur_goal *goal) {
    const double growth = 1.5, pilot = AUR_PILOT_ERROR * goal->error;
    double factor = 1.0 / growth;
    if (goal->error > 0.0)
        factor = factor_to_error(trial, trial->interval.high > pilot ? pilot : aur_goal_noise(goal));
    if (goal->rays > 0)
        factor = fmax(factor, fmin(aur_trial_rays(trial) / (double)goal->rays, 1.0));
    return factor;
}

void aur_trial_plan_evenly(aur_trial *trial, uint32_t samples) {
    for (size_t i = 0; i < trial->value_count; ++i)
        trial->targets[i] = samples;
    trial->begun = true;
}

bool aur_trial_plan(aur_trial *trial, double factor) {
    if (trial->rounds == 0) {
        aur_trial_plan_evenly(trial, 1);
        return true;
    }
    const double rounds = fmax(ceil(-log(factor) / log(AUR_MOST_GROWTH)), 1.0);
    trial->begun = aur_raise_targets(trial->value_count, trial->variances, pow(factor, 1.0 / rounds),
                                     AUR_SAMPLES_PER_PIXEL_MAX, trial->targets);
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
    aur_replicas_measure(replicas, &trial->measure, trial->variances);
    aur_replicas_smooth(replicas, trial->targets, trial->variances, trial->scratch);
    const aur_error_interval absolute = aur_replica_interval(&trial->measure.deviations, replicas->count,
                                                             3 * replicas->pixel_count, confidence);
    const double mean = trial->measure.mean;
    trial->interval = (aur_error_interval){.estimate = mean > 0.0 ? absolute.estimate / mean : INFINITY,
                                           .low = mean > 0.0 ? absolute.low / mean : INFINITY,
                                           .high = mean > 0.0 ? absolute.high / mean : INFINITY,
                                           .degrees = absolute.degrees};
    learn_rate(trial, earlier_error);
    return AUR_OK;
}
