#include "render/adaptive/choose.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/adaptive/rivals.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

static aur_result check_wish(aur_ask_options *wish, aur_error *error) {
    if (!(wish->error >= 0.0 && wish->error <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the target error must be above 0 and at most 1 (100 %%), not %g", wish->error);
    if (!(wish->seconds >= 0.0 && wish->seconds < INFINITY))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the time must be above 0 seconds, not %g", wish->seconds);
    if (!(wish->bias >= 0.0 && wish->bias < (wish->error > 0.0 ? wish->error : INFINITY)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the bias must be at least 0 and below the target error, not %g", wish->bias);
    if (wish->confidence == 0.0)
        wish->confidence = 0.95;
    if (!(wish->confidence >= 0.5 && wish->confidence <= 0.9999))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the confidence must be from .5 to .9999, not %g",
                        wish->confidence);
    if (wish->replicas == 0)
        wish->replicas = 4;
    if (wish->replicas < 3 || wish->replicas > AUR_REPLICAS_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be 3 to %d replicas, not %zu",
                        (int)AUR_REPLICAS_MAX, wish->replicas);
    if (wish->error == 0.0 && wish->seconds == 0.0 && wish->rays == 0 && wish->rounds == 0)
        wish->error = 0.01;
    return AUR_OK;
}

/* --- progress: one bar over all rounds and replicas, to where the wish is thought to be met */

/* Rays, of all integrators that are tried; infinitely many left: nobody knows. */
typedef struct rays_on_the_way {
    double done, left;
} rays_on_the_way;

/* On the way to an error, where `part` of a step is done. */
static double left_to_error(const aur_trial *trial, double part) {
    const double before = trial->begun ? trial->before : trial->samples;
    const double now = before + (trial->begun ? part * (trial->samples - before) : 0.0);
    if (!(before > 0.0 && trial->whole > 0.0))
        return INFINITY;
    /* A round that is planned is rendered to its end. */
    const double whole = fmax(trial->whole, trial->begun ? trial->samples : 0.0);
    return aur_trial_rays(trial) * fmax(whole / now - 1.0, 0.0);
}

/* What is left by whatever ends the work first. */
static rays_on_the_way find_rays(const aur_ask *ask, double done) {
    const aur_ask_options *const wish = &ask->wish;
    const aur_trial *const trial = ask->choice != NULL ? &ask->choice->trial : &ask->trial;
    const double part = ((double)trial->replica + done) / (double)trial->replicas.count;
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    rays_on_the_way rays = {aur_trial_rays(trial) + (double)ask->others.rays, INFINITY};
    if (ask->choice == NULL && wish->error > 0.0) /* a choice takes what it finds out */
        rays.left = left_to_error(trial, part);
    double share = 0.0;
    if (wish->rays > 0)
        share = (aur_trial_rays(trial) + (double)(trial->shared + trial->alone + ask->others.budget)) /
                (double)wish->rays;
    if (wish->seconds > 0.0)
        share = fmax(share, (spent.prepare_seconds + spent.render_seconds + ask->others.prepare_seconds +
                             ask->others.render_seconds) /
                                wish->seconds);
    if (wish->rounds > 0)
        share = fmax(share, ((double)trial->rounds + part) / (double)wish->rounds);
    if (share > 0.0)
        rays.left = fmin(rays.left, rays.done * fmax(1.0 / share - 1.0, 0.0));
    rays.left = fmax(rays.left, 0.01 * rays.done); /* no estimate is surer than that */
    return rays;
}

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    aur_ask *const ask = user;
    if (atomic_load_explicit(&ask->cancelled, memory_order_relaxed))
        return 1;
    if (ask->progress.function == NULL)
        return 0;
    if (ask->trial.replicas.pixel_count == 0) /* it is being prepared */
        return ask->progress.function(ask->progress.user, what, 0, 0);
    const rays_on_the_way rays = find_rays(ask, total > 0 ? (double)done / (double)total : 0.0);
    const bool renders = ask->choice == NULL && ask->trial.rounds > 0;
    return aur_progress_tell(&ask->progress, renders ? "rendering" : "planning", &ask->share, rays.done,
                             rays.left);
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
             "\nbias %.15g\nconfidence %.15g\nreplicas %zu\n",
             w->error, w->seconds, w->rays, w->rounds, w->bias, w->confidence, w->replicas);
    ask->identity = malloc(strlen(render) + strlen(wish) + 1);
    if (ask->identity != NULL)
        strcat(strcpy(ask->identity, wish), render);
    free(render);
    return ask->identity != NULL ? AUR_OK : aur_fail_memory(error);
}

/* A trial by `integrator`, a new text, in place of the asking's own, whose rays were traced for it. */
static aur_result begin_trial(aur_ask *ask, char *integrator, aur_error *error) {
    aur_render_statistics spent;
    aur_trial_spent(&ask->trial, &spent);
    aur_trial_release(&ask->trial);
    ask->trial.integrator = integrator;
    aur_cache *const cache = aur_renderer_cache(ask->renderer);
    aur_cache_uses *const before = aur_cache_count(cache, &ask->uses);
    const aur_result result =
        aur_trial_create(ask->renderer, &ask->options, ask->wish.replicas, &ask->trial, error);
    aur_cache_count(cache, before);
    ask->trial.traced += spent.rays;
    return result;
}

aur_result aur_ask_take_gather(aur_ask *ask, aur_gather_size size, aur_error *error) {
    char *const integrator = aur_ask_gather(ask->trial.integrator, size);
    ask->gather = size;
    ask->open = false;
    return integrator != NULL ? begin_trial(ask, integrator, error) : aur_fail_memory(error);
}

aur_result aur_ask_take_candidates(aur_ask *ask, size_t candidates, aur_error *error) {
    char *const integrator = aur_ask_path(ask->trial.integrator, candidates);
    ask->candidates = candidates;
    ask->open = false;
    return integrator != NULL ? begin_trial(ask, integrator, error) : aur_fail_memory(error);
}

/* What the rounds lead to. Rays of other trials, and those that prepared this one, are spent, and are no
 * matter of its rounds, which are those of an asking that names its integrator. */
static aur_goal goal_of(const aur_ask *ask) {
    const aur_ask_options *const wish = &ask->wish;
    const uint64_t spent = ask->others.budget + ask->trial.shared + ask->trial.alone;
    return (aur_goal){.error = wish->error,
                      .bias = sqrt(ask->bias.high),
                      .rays = wish->rays > spent ? wish->rays - spent : wish->rays > 0};
}

/* Goes on with whichever integrator turns out best. What was tried before an interruption is tried anew, so
 * that the picture is the same. */
static aur_result choose(aur_ask *ask, aur_error *error) {
    aur_result result = AUR_OK;
    if (ask->trial.rounds > 0 || ask->trial.begun) {
        char *const integrator = ask->trial.integrator;
        ask->trial.integrator = NULL;
        result = begin_trial(ask, integrator, error);
    }
    if (result != AUR_OK)
        return result;
    aur_choice choice = {.goal = goal_of(ask),
                         .seconds = ask->wish.seconds,
                         .confidence = ask->wish.confidence,
                         .replica_count = ask->wish.replicas,
                         .cancelled = &ask->cancelled,
                         .others.rays = ask->others.rays,
                         .trial = ask->trial};
    aur_render_options own = ask->options;
    own.warnings = (aur_warnings){0};
    ask->choice = &choice;
    aur_cache *const cache = aur_renderer_cache(ask->renderer);
    aur_cache_uses *const before = aur_cache_count(cache, &ask->uses);
    result = aur_ask_try(ask->renderer, &own, &choice, error);
    aur_cache_count(cache, before);
    ask->choice = NULL;
    ask->trial = choice.trial;
    ask->bias = choice.bias;
    ask->others = choice.others;
    ask->others.budget += ask->uses.rays - ask->trial.shared;
    ask->gather = choice.gather;
    ask->candidates = choice.candidates;
    ask->open = result != AUR_OK;
    return result;
}

/* Another trial may be made when the caller's texts are gone. */
static aur_result keep_options(aur_ask *ask, aur_renderer *renderer, const aur_render_options *options,
                               aur_error *error) {
    ask->renderer = renderer;
    ask->options = *options;
    ask->sampler = strdup(options->sampler);
    ask->filter = options->filter != NULL ? strdup(options->filter) : NULL;
    ask->options.sampler = ask->sampler;
    ask->options.filter = ask->filter;
    ask->options.integrator = NULL;
    const bool kept = ask->sampler != NULL && (options->filter == NULL || ask->filter != NULL);
    return kept ? AUR_OK : aur_fail_memory(error);
}

static aur_result prepare(aur_ask *ask, aur_renderer *renderer, const aur_render_options *given,
                          aur_error *error) {
    aur_render_options own = {.size = sizeof own};
    aur_render_options_init(&own, NULL);
    aur_result result = aur_options_read(given, sizeof own, &own, "aur_render_options", error);
    if (result == AUR_OK)
        result = aur_ask_choose(aur_renderer_scene(renderer), own.integrator, &ask->trial.integrator,
                                &ask->open, error);
    if (result != AUR_OK)
        return result;
    ask->progress = own.progress;
    own.progress = (aur_progress){report, ask};
    own.integrator = ask->trial.integrator;
    own.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
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
    result = keep_options(ask, renderer, &own, error);
    char *const integrator = ask->trial.integrator;
    ask->trial.integrator = NULL;
    result = result == AUR_OK ? begin_trial(ask, integrator, error) : result;
    if (result != AUR_OK)
        return result;
    if (aur_render_film(ask->trial.replicas.renders[0])->layout.channel_count > 3)
        aur_warn_at(
            &own.warnings, (aur_location){0},
            "a picture to an error, a time or a number of rays has R, G and B alone: the channels that "
            "the integrator adds are left out");
    ask->open = ask->open && (ask->wish.error > 0.0 || ask->wish.seconds > 0.0 || ask->wish.rays > 0);
    if (ask->open && ask->wish.bias > 0.0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a bias of %g: it goes with an integrator that is named, else it is measured",
                        ask->wish.bias);
    ask->bias.high = ask->wish.bias * ask->wish.bias;
    return AUR_OK;
}

aur_result aur_ask_create(aur_renderer *renderer, const aur_render_options *render,
                          const aur_ask_options *options, aur_ask **out, aur_error *error) {
    *out = NULL;
    aur_ask *const ask = calloc(1, sizeof *ask);
    if (ask == NULL)
        return aur_fail_memory(error);
    atomic_init(&ask->cancelled, false);
    ask->wish.size = sizeof(aur_ask_options);
    aur_ask_options_init(&ask->wish, NULL);
    aur_result result = aur_options_read(options, sizeof ask->wish, &ask->wish, "aur_ask_options", error);
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
    aur_trial_release(&ask->trial);
    aur_cache_uses_release(&ask->uses);
    free(ask->identity);
    free(ask->sampler);
    free(ask->filter);
    free(ask);
}

/* --- rounds */

static void count_spent(const aur_ask *ask, aur_render_statistics *sum) {
    aur_trial_spent(&ask->trial, sum);
    sum->rays += ask->others.rays;
    sum->prepare_seconds += ask->others.prepare_seconds;
    sum->render_seconds += ask->others.render_seconds;
    sum->cpu_seconds += ask->others.cpu_seconds;
}

/* The interval of noise and bias together; its ends are those of both. */
static aur_error_interval whole_error(const aur_ask *ask) {
    const aur_error_interval *const noise = &ask->trial.interval;
    return (aur_error_interval){.estimate =
                                    sqrt(noise->estimate * noise->estimate + fmax(ask->bias.estimate, 0.0)),
                                .low = sqrt(noise->low * noise->low + ask->bias.low),
                                .high = sqrt(noise->high * noise->high + ask->bias.high),
                                .degrees = noise->degrees};
}

static bool is_met(const aur_ask *ask) {
    const aur_ask_options *const wish = &ask->wish;
    aur_render_statistics spent;
    count_spent(ask, &spent);
    const aur_goal goal = goal_of(ask);
    return (wish->error > 0.0 && ask->trial.looked_at && ask->trial.bound <= aur_goal_noise(&goal)) ||
           (wish->seconds > 0.0 && spent.prepare_seconds + spent.render_seconds >= wish->seconds) ||
           (wish->rays > 0 && aur_trial_rays(&ask->trial) >= (double)goal.rays) ||
           (wish->rounds > 0 && ask->trial.rounds >= wish->rounds) || aur_trial_is_black(&ask->trial);
}

static double next_factor(const aur_ask *ask) {
    const aur_goal goal = goal_of(ask);
    return aur_trial_factor(&ask->trial, &goal);
}

static void look_ahead(aur_ask *ask) {
    const aur_goal goal = goal_of(ask);
    aur_trial_look_ahead(&ask->trial, &goal);
}

aur_result aur_ask_run(aur_ask *ask, aur_error *error) {
    aur_result result = ask->open ? choose(ask, error) : AUR_OK;
    aur_trial *const trial = &ask->trial;
    while (result == AUR_OK && (trial->rounds == 0 || trial->begun || !is_met(ask))) {
        if (!trial->begun)
            look_ahead(ask);
        if (!trial->begun && !aur_trial_plan(trial, trial->rounds > 0 ? next_factor(ask) : 1.0))
            break;
        result = aur_trial_render(trial, ask->wish.confidence, &ask->cancelled, error);
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
    const aur_error_interval interval = whole_error(ask);
    aur_ask_report own = {.error = interval.estimate,
                          .error_low = interval.low,
                          .error_high = interval.high,
                          .mean = ask->trial.measure.mean,
                          .degrees = interval.degrees,
                          .rounds = ask->trial.rounds,
                          .samples_per_pixel = ask->trial.begun ? ask->trial.before : ask->trial.samples,
                          .replicas = ask->trial.replicas.count,
                          .trial_rays = ask->others.budget,
                          .bias_high = sqrt(ask->bias.high)};
    count_spent(ask, &own.statistics);
    return aur_description_write(&own, sizeof own, out, "aur_ask_report", error);
}

const char *aur_ask_integrator(const aur_ask *ask) {
    return ask->trial.integrator != NULL ? ask->trial.integrator : "";
}

aur_result aur_ask_develop(const aur_ask *ask, bool errors, aur_image **image, aur_error *error) {
    return aur_replicas_develop(&ask->trial.replicas, errors, image, error);
}

aur_result aur_ask_options_init(aur_ask_options *options, aur_error *error) {
    static const aur_ask_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_ask_options", error);
}
