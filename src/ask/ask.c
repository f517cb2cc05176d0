#include "ask/state.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/choose.h"
#include "ask/rounds.h"
#include "core/error.h"
#include "core/options.h"
#include "film/film.h"
#include "render/renderer.h"
#include "render/stopwatch.h"

enum { MOST_SAMPLES = 1 << 24 };

static aur_result check_wish(aur_ask_options *wish, aur_error *error) {
    if (!(wish->error >= 0.0 && wish->error <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an error of %g: from above 0 to 1 (100 %%) is wanted",
                        wish->error);
    if (!(wish->seconds >= 0.0 && wish->seconds < INFINITY))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a time of %g seconds: a positive one is wanted",
                        wish->seconds);
    if (wish->confidence == 0.0)
        wish->confidence = 0.95;
    if (!(wish->confidence >= 0.5 && wish->confidence <= 0.9999))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a confidence of %g: .5 to .9999 is wanted",
                        wish->confidence);
    if (wish->replicas == 0)
        wish->replicas = 4;
    if (wish->replicas < 3 || wish->replicas > AUR_REPLICAS_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%zu replicas: 3 to %d are wanted", wish->replicas,
                        (int)AUR_REPLICAS_MAX);
    if (wish->error == 0.0 && wish->seconds == 0.0 && wish->rays == 0 && wish->rounds == 0)
        wish->error = 0.01;
    return AUR_OK;
}

/* --- progress: one bar over all rounds and replicas, to where the wish is thought to be met */

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    aur_ask *const ask = user;
    if (atomic_load_explicit(&ask->cancelled, memory_order_relaxed))
        return 1;
    if (ask->progress.function == NULL)
        return 0;
    enum { STEPS = 10000 };
    const double part = ((double)ask->replica + (double)done / (double)total) / (double)ask->replicas.count;
    const double share = (ask->before + part * (ask->samples - ask->before)) / ask->whole;
    return ask->progress.function(ask->progress.user, what, (uint64_t)(STEPS * fmin(share, 1.0)), STEPS);
}

/* --- making */

static aur_result make_identity(aur_ask *ask, const aur_scene *scene, const aur_render_options *options,
                                aur_error *error) {
    char *render, wish[200];
    const aur_ask_options *const w = &ask->wish;
    const aur_result result = aur_render_identify(scene, options, &render, error);
    if (result != AUR_OK)
        return result;
    snprintf(wish, sizeof wish,
             "error %.15g\ntime %.15g s\nrays %" PRIu64 "\nrounds %" PRIu64
             "\nconfidence %.15g\nreplicas %zu\n",
             w->error, w->seconds, w->rays, w->rounds, w->confidence, w->replicas);
    ask->identity = malloc(strlen(render) + strlen(wish) + 1);
    if (ask->identity != NULL)
        strcat(strcpy(ask->identity, wish), render);
    free(render);
    return ask->identity != NULL ? AUR_OK : aur_fail_memory(error);
}

static aur_result prepare(aur_ask *ask, aur_renderer *renderer, const aur_render_options *given,
                          aur_error *error) {
    aur_render_options own = aur_render_options_default();
    aur_result result = aur_options_read(given, sizeof own, sizeof own, &own, "aur_render_options", error);
    if (result == AUR_OK)
        result = aur_ask_choose(aur_renderer_scene(renderer), own.integrator, &ask->integrator, error);
    if (result != AUR_OK)
        return result;
    ask->progress = own.progress;
    own.progress = (aur_progress){report, ask};
    own.integrator = ask->integrator;
    own.samples_per_pixel = MOST_SAMPLES;
    if (own.sampler == NULL)
        own.sampler = "sobol";
    if (own.shard_count != 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "an error, a time or a number of rays is of a whole picture: parts have none");
    if (own.resumable)
        result = make_identity(ask, aur_renderer_scene(renderer), &own, error);
    own.resumable = false;
    if (result != AUR_OK)
        return result;
    result = aur_replicas_create(renderer, &own, ask->wish.replicas, &ask->replicas, error);
    if (result != AUR_OK)
        return result;
    if (aur_render_film(ask->replicas.renders[0])->layout.channel_count > 3)
        aur_warn_at(
            &own.warnings, (aur_location){0},
            "a picture to an error, a time or a number of rays has R, G and B alone: the channels that "
            "the integrator adds are left out");
    ask->targets = calloc(ask->replicas.pixel_count, sizeof *ask->targets);
    ask->variances = calloc(ask->replicas.pixel_count, sizeof *ask->variances);
    ask->scratch = calloc(ask->replicas.pixel_count, sizeof *ask->scratch);
    return ask->targets != NULL && ask->variances != NULL && ask->scratch != NULL ? AUR_OK
                                                                                  : aur_fail_memory(error);
}

aur_result aur_ask_create(aur_renderer *renderer, const aur_render_options *render,
                          const aur_ask_options *options, aur_ask **out, aur_error *error) {
    *out = NULL;
    aur_ask *const ask = calloc(1, sizeof *ask);
    if (ask == NULL)
        return aur_fail_memory(error);
    atomic_init(&ask->cancelled, false);
    ask->wish = aur_ask_options_default();
    ask->interval = (aur_error_interval){.estimate = INFINITY, .high = INFINITY};
    ask->rate = 1.0;
    ask->whole = 1.0;
    aur_result result =
        aur_options_read(options, sizeof ask->wish, sizeof ask->wish, &ask->wish, "aur_ask_options", error);
    if (result == AUR_OK)
        result = check_wish(&ask->wish, error);
    if (result == AUR_OK)
        result = prepare(ask, renderer, render, error);
    if (result != AUR_OK) {
        aur_ask_destroy(ask);
        return result;
    }
    *out = ask;
    return AUR_OK;
}

void aur_ask_destroy(aur_ask *ask) {
    if (ask == NULL)
        return;
    aur_replicas_release(&ask->replicas);
    free(ask->targets);
    free(ask->variances);
    free(ask->scratch);
    free(ask->integrator);
    free(ask->identity);
    free(ask);
}

/* --- rounds */

static void count_spent(const aur_ask *ask, aur_render_statistics *sum) {
    *sum = (aur_render_statistics){.size = sizeof *sum};
    for (size_t r = 0; r < ask->replicas.count; ++r) {
        aur_render_statistics one = {.size = sizeof one};
        aur_render_get_statistics(ask->replicas.renders[r], &one, NULL);
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

static bool is_met(const aur_ask *ask) {
    const aur_ask_options *const wish = &ask->wish;
    aur_render_statistics spent;
    count_spent(ask, &spent);
    return (wish->error > 0.0 && ask->interval.high <= wish->error) ||
           (wish->seconds > 0.0 && spent.prepare_seconds + spent.render_seconds >= wish->seconds) ||
           (wish->rays > 0 && spent.rays >= wish->rays) ||
           (wish->rounds > 0 && ask->rounds >= wish->rounds) || ask->measure.mean <= 0.0;
}

/* What the next round is to make of the error's square. It aims a little below the error asked, so that the
 * last round is seldom followed by a tiny one, and half as many samples again where nobody asks for an error.
 */
static double next_factor(const aur_ask *ask) {
    const double growth = 1.5, margin = 0.98;
    double factor = 1.0 / growth;
    if (ask->wish.error > 0.0) {
        const double wanted = margin * ask->wish.error / ask->interval.high;
        factor = pow(fmin(wanted * wanted, 0.99), 1.0 / ask->rate);
    }
    if (ask->wish.rays > 0) {
        aur_render_statistics spent;
        count_spent(ask, &spent);
        factor = fmax(factor, (double)spent.rays / (double)ask->wish.rays);
    }
    return factor;
}

static double mean_samples(const aur_ask *ask) {
    aur_render_statistics spent;
    count_spent(ask, &spent);
    return (double)spent.samples / (double)ask->replicas.pixel_count;
}

static void plan_samples(aur_ask *ask) {
    double sum = 0.0;
    for (size_t i = 0; i < ask->replicas.pixel_count; ++i)
        sum += ask->targets[i];
    ask->before = ask->samples;
    ask->samples = sum / (double)ask->replicas.pixel_count * (double)ask->replicas.count;
    const double factor = ask->rounds > 0 ? next_factor(ask) : 0.1;
    ask->whole = fmax(ask->samples, ask->before / factor);
}

/* The rate at which the square error falls with samples, from the last round: 1 for random numbers, up to 2
 * where quasi-Monte Carlo points do better. Rounds that added little tell little. */
static void learn_rate(aur_ask *ask, double earlier_error, double earlier_samples) {
    const double growth = log(ask->samples / earlier_samples);
    if (!(earlier_error < INFINITY) || growth < log(1.5))
        return;
    const double rate = 2.0 * log(earlier_error / ask->interval.estimate) / growth;
    ask->rate = fmin(fmax(rate, 1.0), 2.0);
}

static aur_result render_round(aur_ask *ask, aur_error *error) {
    const double earlier_error = ask->interval.estimate, earlier_samples = ask->samples;
    plan_samples(ask);
    for (ask->replica = 0; ask->replica < ask->replicas.count; ++ask->replica) {
        aur_result result = atomic_load(&ask->cancelled) ? AUR_ERROR_CANCELLED : AUR_OK;
        if (result == AUR_OK)
            result = aur_render_step_pixels(ask->replicas.renders[ask->replica], ask->replicas.pixel_count,
                                            ask->targets, error);
        if (result != AUR_OK) {
            ask->samples = ask->before;
            return result;
        }
    }
    ask->begun = false;
    ++ask->rounds;
    ask->samples = mean_samples(ask);
    aur_replicas_measure(&ask->replicas, &ask->measure, ask->variances);
    aur_replicas_smooth(&ask->replicas, ask->targets, ask->variances, ask->scratch);
    const aur_error_interval absolute = aur_replica_interval(
        &ask->measure.deviations, ask->replicas.count, 3 * ask->replicas.pixel_count, ask->wish.confidence);
    const double mean = ask->measure.mean;
    ask->interval = (aur_error_interval){.estimate = mean > 0.0 ? absolute.estimate / mean : INFINITY,
                                         .low = mean > 0.0 ? absolute.low / mean : INFINITY,
                                         .high = mean > 0.0 ? absolute.high / mean : INFINITY,
                                         .degrees = absolute.degrees};
    learn_rate(ask, earlier_error, earlier_samples);
    return AUR_OK;
}

/* False when all pixels have all the samples that they can have. */
static bool plan_round(aur_ask *ask) {
    if (ask->rounds > 0)
        return aur_raise_targets(ask->replicas.pixel_count, ask->variances, next_factor(ask), MOST_SAMPLES,
                                 ask->targets);
    for (size_t i = 0; i < ask->replicas.pixel_count; ++i)
        ask->targets[i] = 1;
    return true;
}

aur_result aur_ask_run(aur_ask *ask, aur_error *error) {
    aur_result result = AUR_OK;
    while (result == AUR_OK && (ask->rounds == 0 || ask->begun || !is_met(ask))) {
        if (!ask->begun && !plan_round(ask))
            break;
        ask->begun = true;
        result = render_round(ask, error);
    }
    atomic_store(&ask->cancelled, false);
    return result == AUR_ERROR_CANCELLED ? aur_fail(error, result, "rendering: %s", aur_result_string(result))
                                         : result;
}

void aur_ask_cancel(aur_ask *ask) {
    atomic_store_explicit(&ask->cancelled, true, memory_order_relaxed);
}

/* --- what came out */

aur_result aur_ask_get_report(const aur_ask *ask, aur_ask_report *out, aur_error *error) {
    aur_ask_report own = {.error = ask->interval.estimate,
                          .error_low = ask->interval.low,
                          .error_high = ask->interval.high,
                          .mean = ask->measure.mean,
                          .degrees = ask->interval.degrees,
                          .rounds = ask->rounds,
                          .samples_per_pixel = ask->samples,
                          .replicas = ask->replicas.count};
    count_spent(ask, &own.statistics);
    return aur_description_write(&own, sizeof own, sizeof own, out, "aur_ask_report", error);
}

const char *aur_ask_integrator(const aur_ask *ask) {
    return ask->integrator != NULL ? ask->integrator : "";
}

aur_result aur_ask_develop(const aur_ask *ask, bool errors, aur_image **image, aur_error *error) {
    return aur_replicas_develop(&ask->replicas, errors, image, error);
}
