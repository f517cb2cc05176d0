#include "render/adaptive/adaptive.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/image/error_halves.h"

static aur_result check_target(aur_adaptive_options *target, aur_error *error) {
    if (!(target->error >= 0.0 && target->error <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the target error must be above 0 and at most 1 (100 %%), not %g", target->error);
    if (target->error > 0.0 && target->error < 1e-6)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the target error must be at least 1e-6, what 32-bit images resolve, not %g",
                        target->error);
    if (!(target->seconds >= 0.0 && target->seconds < INFINITY))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the time must be above 0 seconds and finite, not %g",
                        target->seconds);
    if (!(target->bias >= 0.0 && target->bias < (target->error > 0.0 ? target->error : INFINITY)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the bias must be at least 0 and below the target error, not %g", target->bias);
    if (target->confidence == 0.0)
        target->confidence = 0.95;
    if (!(target->confidence >= 0.5 && target->confidence <= 0.9999))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the confidence must be from .5 to .9999, not %g",
                        target->confidence);
    if ((size_t)target->measure >= AUR_ERROR_MEASURE_COUNT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown error measure %d", (int)target->measure);
    if (target->replicas == 0)
        target->replicas = 4;
    if (target->error == 0.0 && target->seconds == 0.0 && target->rays == 0 && target->rounds == 0)
        target->error = 0.01;
    if (target->replicas > AUR_REPLICAS_MAX ||
        (target->replicas < 3 && (target->replicas != 1 || target->error > 0.0)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "there must be 3 to %d replicas, or 1 without a target error, not %zu",
                        (int)AUR_REPLICAS_MAX, target->replicas);
    return AUR_OK;
}

/* --- progress */

/* The remaining rays, if known to a factor of two: of a budget, or of a round that is planned to be the last.
 * INFINITY if more rounds may follow or a bias is not yet bounded. `part` of a replica's step is done. */
static double rays_left(const aur_adaptive *adaptive, const aur_spent *spent, double part) {
    const aur_adaptive_options *const target = &adaptive->target;
    const aur_candidate *const candidate = &adaptive->candidate;
    const aur_goal goal = aur_adaptive_goal(adaptive);
    const double room = aur_adaptive_bias_room(adaptive);
    const bool bounded =
        adaptive->corrections.replicas.count == 0 ||
        (adaptive->corrections.steps > 0 && adaptive->bias[target->measure].high <= room * room);
    const bool last = (aur_candidate_ends(candidate, &goal) && bounded) ||
                      (target->rounds > 0 && candidate->rounds + 1 == target->rounds);
    const double share = ((double)candidate->replica + part) / fmax((double)candidate->replicas.count, 1.0);
    const bool begun = !adaptive->races && candidate->begun && candidate->rounds > 0;
    const double more = aur_replicas_rays(&candidate->replicas) - candidate->rays_before;
    const double rest = begun ? (1.0 - share) * (more + (1.0 - share) * candidate->rays_planned) : 0.0;
    double left = last && begun ? rest : INFINITY;
    if (target->rays > 0)
        left = fmin(left, fmax(rest, (double)target->rays - (double)(spent->budget + adaptive->uses.rays)));
    if (target->seconds > 0.0) {
        const double rate =
            (double)spent->all.rays / fmax(spent->all.prepare_seconds + spent->all.render_seconds, 1e-9);
        left = fmin(left, fmax(rest, target->seconds * rate - (double)spent->all.rays));
    }
    return fmax(left, 0.01 * (double)spent->all.rays); /* no estimate is surer than that */
}

static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    aur_adaptive *const adaptive = user;
    if (atomic_load_explicit(&adaptive->cancelled, memory_order_relaxed))
        return 1;
    if (adaptive->progress.function == NULL)
        return 0;
    const bool prepares = adaptive->candidate.replicas.pixel_count == 0;
    if (prepares && adaptive->share.share == 0.0) /* no estimate yet */
        return adaptive->progress.function(adaptive->progress.user, what, 0, 0);
    const double part = prepares || total == 0 ? 0.0 : (double)done / (double)total;
    const aur_spent spent = aur_adaptive_spent(adaptive);
    const bool renders = !adaptive->races && adaptive->candidate.rounds > 0;
    return aur_progress_report_work(&adaptive->progress, renders ? "rendering" : "planning", &adaptive->share,
                                    (double)spent.all.rays, rays_left(adaptive, &spent, part));
}

/* --- time */

/* Work that began at a time, when so much had been spent. */
typedef struct stretch {
    aur_stopwatch start;
    aur_render_statistics spent;
} stretch;

static stretch begin_lap(const aur_adaptive *adaptive) {
    return (stretch){aur_stopwatch_start(), aur_adaptive_spent(adaptive).all};
}

/* Adds what no render has counted: the time of statistics, plans and the race's decisions. Begins the next.
 */
static void end_lap(aur_adaptive *adaptive, stretch *lap) {
    const aur_render_statistics now = aur_adaptive_spent(adaptive).all, *const before = &lap->spent;
    double wall = 0.0, cpu = 0.0;
    aur_stopwatch_add(&lap->start, &wall, &cpu);
    wall -= now.prepare_seconds - before->prepare_seconds + now.render_seconds - before->render_seconds;
    adaptive->others.all.render_seconds += fmax(wall, 0.0);
    adaptive->others.all.cpu_seconds += fmax(cpu - (now.cpu_seconds - before->cpu_seconds), 0.0);
    *lap = begin_lap(adaptive);
}

/* --- making */

static aur_result make_identity(aur_adaptive *adaptive, const aur_scene *scene,
                                const aur_render_options *options, aur_error *error) {
    char *render;
    const aur_adaptive_options *const w = &adaptive->target;
    const aur_result result = aur_render_identify(scene, options, &render, error);
    if (result != AUR_OK)
        return result;
    adaptive->identity =
        aur_new_text("error %.15g %s\ntime %.15g s\nrays %" PRIu64 "\nrounds %" PRIu64
                     "\nbias %.15g\nconfidence %.15g\nreplicas %zu\napart %d\n%s",
                     w->error, aur_error_measure_name(w->measure), w->seconds, w->rays, w->rounds, w->bias,
                     w->confidence, w->replicas, w->independent_pixels != 0, render);
    free(render);
    return adaptive->identity != NULL ? AUR_OK : aur_fail_memory(error);
}

/* Copy the strings: later candidates outlive the caller's. */
static aur_result copy_options(aur_adaptive *adaptive, aur_renderer *renderer,
                               const aur_render_options *options, aur_error *error) {
    adaptive->renderer = renderer;
    adaptive->options = *options;
    adaptive->sampler = strdup(options->sampler);
    adaptive->filter = options->filter != NULL ? strdup(options->filter) : NULL;
    adaptive->options.sampler = adaptive->sampler;
    adaptive->options.filter = adaptive->filter;
    adaptive->options.integrator = NULL;
    const bool copied = adaptive->sampler != NULL && (options->filter == NULL || adaptive->filter != NULL);
    return copied ? AUR_OK : aur_fail_memory(error);
}

static aur_result prepare(aur_adaptive *adaptive, aur_renderer *renderer, const aur_render_options *given,
                          aur_error *error) {
    aur_render_options local = {.size = sizeof local};
    aur_render_options_init(&local, NULL);
    aur_result result = aur_options_read(given, sizeof local, &local, "aur_render_options", error);
    if (result == AUR_OK)
        result = aur_integrator_of_scene(aur_renderer_scene(renderer), local.integrator,
                                         &adaptive->candidate.integrator, &adaptive->open, error);
    if (result != AUR_OK)
        return result;
    adaptive->progress = local.progress;
    local.progress = (aur_progress){report, adaptive};
    local.integrator = adaptive->candidate.integrator;
    local.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX; /* in the identity */
    if (local.sampler == NULL)
        local.sampler = "sobol";
    if (local.shard_count != 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "parts of an image cannot be rendered to a target error, time or number of rays");
    if (local.resumable)
        result = make_identity(adaptive, aur_renderer_scene(renderer), &local, error);
    local.resumable = false;
    if (result != AUR_OK)
        return result;
    result = copy_options(adaptive, renderer, &local, error);
    char *const integrator = adaptive->candidate.integrator;
    adaptive->candidate.integrator = NULL;
    if (result == AUR_OK && adaptive->open && (adaptive->path = strdup(integrator)) == NULL)
        result = aur_fail_memory(error);
    if (result != AUR_OK) {
        free(integrator);
        return result;
    }
    result = aur_adaptive_begin(adaptive, integrator, error);
    if (result != AUR_OK)
        return result;
    if (aur_render_film(adaptive->candidate.replicas.renders[0])->layout.channel_count > 3 &&
        !aur_replicas_clamp(&adaptive->candidate.replicas))
        aur_warn_at(&local.warnings, (aur_location){0},
                    "an image to a target error, time or number of rays has only R, G and B: further "
                    "channels of the integrator are left out");
    adaptive->open = adaptive->open && (adaptive->target.error > 0.0 || adaptive->target.seconds > 0.0 ||
                                        adaptive->target.rays > 0);
    if (adaptive->open && adaptive->target.bias > 0.0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a bias of %g: it needs a named integrator; otherwise it is measured",
                        adaptive->target.bias);
    const double square = adaptive->target.bias * adaptive->target.bias;
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m)
        adaptive->bias[m].high = square;
    return AUR_OK;
}

aur_result aur_adaptive_create(aur_renderer *renderer, const aur_render_options *render,
                               const aur_adaptive_options *options, aur_adaptive **out, aur_error *error) {
    *out = NULL;
    aur_adaptive *const adaptive = calloc(1, sizeof *adaptive);
    if (adaptive == NULL)
        return aur_fail_memory(error);
    atomic_init(&adaptive->cancelled, false);
    adaptive->target.size = sizeof(aur_adaptive_options);
    aur_adaptive_options_init(&adaptive->target, NULL);
    stretch lap = begin_lap(adaptive);
    aur_result result =
        aur_options_read(options, sizeof adaptive->target, &adaptive->target, "aur_adaptive_options", error);
    if (result == AUR_OK)
        result = check_target(&adaptive->target, error);
    if (result == AUR_OK)
        result = prepare(adaptive, renderer, render, error);
    if (result != AUR_OK) {
        aur_adaptive_destroy(adaptive);
        return result;
    }
    end_lap(adaptive, &lap);
    *out = adaptive;
    return AUR_OK;
}

void aur_adaptive_destroy(aur_adaptive *adaptive) {
    if (adaptive == NULL)
        return;
    aur_candidate_release(&adaptive->candidate);
    aur_corrections_release(&adaptive->corrections);
    aur_race_release(&adaptive->race);
    aur_cache_uses_release(&adaptive->uses);
    free(adaptive->path);
    free(adaptive->identity);
    free(adaptive->sampler);
    free(adaptive->filter);
    free(adaptive);
}

/* --- rounds */

/* The factor for the interval's upper end that moves it half of the way, in squares, to the bound by the
 * variances of all rounds. Rounds continue until the error looks small, so the last round alone
 * underestimates it more often than not. Emitters that may have been missed require more rounds, but do not
 * enter the reported interval. */
static double bound_part(const aur_adaptive *adaptive) {
    return adaptive->target.error > 0.0 ? sqrt(0.5 + 0.5 * fmax(adaptive->candidate.pooled, 1.0)) : 1.0;
}

/* The interval of noise and bias together by a measure. */
static aur_error_interval whole_error(const aur_adaptive *adaptive, size_t measure) {
    const aur_error_interval *const noise = &adaptive->candidate.intervals[measure];
    const aur_bias *const bias = &adaptive->bias[measure];
    if (adaptive->target.replicas == 1)
        return *noise;
    return (aur_error_interval){
        .estimate = sqrt(noise->estimate * noise->estimate + fmax(bias->estimate, 0.0)),
        .low = sqrt(noise->low * noise->low + bias->low),
        .high = aur_bias_with_noise(bias, noise->estimate, noise->high * bound_part(adaptive)),
        .degrees = noise->degrees};
}

static bool is_met(const aur_adaptive *adaptive) {
    const aur_adaptive_options *const target = &adaptive->target;
    const aur_candidate *const candidate = &adaptive->candidate;
    const aur_render_statistics spent = aur_adaptive_spent(adaptive).all;
    const aur_goal goal = aur_adaptive_goal(adaptive);
    return (target->error > 0.0 && candidate->looked_at && candidate->bound <= goal.noise) ||
           (target->seconds > 0.0 && spent.prepare_seconds + spent.render_seconds >= target->seconds) ||
           (target->rays > 0 && aur_replicas_rays(&candidate->replicas) >= (double)goal.rays) ||
           (target->rounds > 0 && candidate->rounds >= target->rounds) || aur_candidate_is_black(candidate);
}

/* Renders rounds until the noise target is met, or another candidate replaces this one. */
static aur_result render_rounds(aur_adaptive *adaptive, stretch *lap, bool *again, aur_error *error) {
    aur_candidate *const candidate = &adaptive->candidate;
    aur_result result = AUR_OK;
    *again = false;
    if (adaptive->unchecked) /* which was interrupted */
        result = aur_adaptive_check_round(adaptive, false, again, error);
    while (result == AUR_OK && !*again && (candidate->rounds == 0 || candidate->begun || !is_met(adaptive))) {
        const aur_goal goal = aur_adaptive_goal(adaptive);
        if (!candidate->begun &&
            !aur_candidate_plan(candidate,
                                candidate->rounds > 0 ? aur_candidate_factor(candidate, &goal) : 1.0))
            break;
        result = aur_candidate_render(candidate, adaptive->target.confidence, &adaptive->cancelled, error);
        if (result == AUR_OK)
            result = aur_adaptive_check_round(adaptive, false, again, error);
        end_lap(adaptive, lap);
    }
    return result;
}

aur_result aur_adaptive_run(aur_adaptive *adaptive, aur_error *error) {
    stretch lap = begin_lap(adaptive);
    aur_result result = adaptive->open ? aur_adaptive_race(adaptive, error) : AUR_OK;
    end_lap(adaptive, &lap);
    for (bool again = true; result == AUR_OK && again;) {
        result = render_rounds(adaptive, &lap, &again, error);
        if (result == AUR_OK && !again)
            result = aur_adaptive_check_round(adaptive, true, &again, error);
    }
    aur_adaptive_measure_others(adaptive);
    end_lap(adaptive, &lap);
    atomic_store(&adaptive->cancelled, false);
    return result == AUR_ERROR_CANCELLED ? aur_fail(error, result, "rendering: %s", aur_result_string(result))
                                         : result;
}

void aur_adaptive_cancel(aur_adaptive *adaptive) {
    atomic_store_explicit(&adaptive->cancelled, true, memory_order_relaxed);
}

/* --- what came out */

/* Also while rounds are rendered: the errors by all measures belong to one round. */
aur_result aur_adaptive_get_report(aur_adaptive *adaptive, aur_adaptive_report *out, aur_error *error) {
    aur_adaptive_measure_others(adaptive);
    const aur_error_interval interval = whole_error(adaptive, adaptive->target.measure);
    aur_adaptive_report local = {.error = interval.estimate,
                                 .error_low = interval.low,
                                 .error_high = interval.high,
                                 .mean = adaptive->candidate.measure.mean,
                                 .degrees = interval.degrees,
                                 .rounds = adaptive->candidate.rounds,
                                 .samples_per_pixel = adaptive->candidate.finished,
                                 .replicas = adaptive->candidate.replicas.count,
                                 .candidate_rays = aur_adaptive_other_rays(adaptive),
                                 .bias_high = sqrt(adaptive->bias[adaptive->target.measure].high)};
    local.candidate_rays += adaptive->target.rays > 0
                                ? aur_adaptive_reserve(adaptive)
                                : (uint64_t)aur_replicas_rays(&adaptive->corrections.replicas);
    local.bias_room = adaptive->target.error > 0.0 ? aur_adaptive_bias_room(adaptive) : local.bias_high;
    local.race_count = adaptive->race.order_count > 0 ? AUR_RACE_ROWS : 0;
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        const aur_error_interval one = whole_error(adaptive, m);
        local.errors[m] = (aur_error_figures){.error = one.estimate, .low = one.low, .high = one.high};
    }
    aur_spent spent = {.budget = 0};
    aur_candidate_add_spent(&adaptive->candidate, &spent);
    local.statistics = spent.all; /* of others only rays and times */
    spent = aur_adaptive_spent(adaptive);
    local.statistics.rays = spent.all.rays;
    local.statistics.prepare_seconds = spent.all.prepare_seconds;
    local.statistics.render_seconds = spent.all.render_seconds;
    local.statistics.cpu_seconds = spent.all.cpu_seconds;
    local.statistics.size = sizeof local.statistics;
    return aur_description_write(&local, sizeof local, out, "aur_adaptive_report", error);
}

aur_result aur_adaptive_get_candidate(const aur_adaptive *adaptive, size_t index, aur_adaptive_candidate *out,
                                      aur_error *error) {
    if (index >= AUR_RACE_ROWS || adaptive->race.order_count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown candidate %zu", index);
    const aur_race_entry *const entry = &adaptive->race.entries[index];
    aur_adaptive_candidate local = {.name = aur_race_rows[index].name,
                                    .taken = index == adaptive->row,
                                    .pixels = entry->blocks * AUR_BLOCK_PIXELS,
                                    .rays = entry->rays,
                                    .need = entry->need,
                                    .reason = entry->reason};
    if (local.taken)
        local.reason = "taken";
    else if (entry->reason[0] == '\0')
        local.reason = entry->need > 0.0 ? "more work than the one taken" : "not measured";
    return aur_description_write(&local, sizeof local, out, "aur_adaptive_candidate", error);
}

const char *aur_adaptive_integrator(const aur_adaptive *adaptive) {
    return adaptive->candidate.integrator != NULL ? adaptive->candidate.integrator : "";
}

aur_result aur_adaptive_develop(const aur_adaptive *adaptive, bool errors, aur_image **image,
                                aur_error *error) {
    const aur_replicas *const replicas = &adaptive->candidate.replicas;
    return aur_replicas_develop(replicas, 0, 1, errors && replicas->count > 1, image, error);
}

aur_result aur_adaptive_develop_half(const aur_adaptive *adaptive, size_t half, aur_image **image,
                                     aur_error *error) {
    return half < 2 ? aur_replicas_develop(&adaptive->candidate.replicas, half, 2, true, image, error)
                    : aur_fail(error, AUR_ERROR_ARGUMENT, "unknown half %zu: expected 0 or 1", half);
}

aur_result aur_adaptive_compare_halves(const aur_adaptive *adaptive, const aur_image *const processed[2],
                                       aur_error_figures *figures, aur_error *error) {
    aur_image *halves[2] = {NULL, NULL};
    aur_result result = aur_adaptive_develop_half(adaptive, 0, &halves[0], error);
    if (result == AUR_OK)
        result = aur_adaptive_develop_half(adaptive, 1, &halves[1], error);
    aur_error_interval interval = {.estimate = 0.0};
    if (result == AUR_OK)
        result = aur_error_of_halves((const aur_image *const *)halves, processed, adaptive->target.measure,
                                     adaptive->target.confidence, &interval, error);
    *figures = (aur_error_figures){interval.estimate, interval.low, interval.high};
    aur_image_destroy(halves[0]);
    aur_image_destroy(halves[1]);
    return result;
}

aur_result aur_adaptive_options_init(aur_adaptive_options *options, aur_error *error) {
    static const aur_adaptive_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_adaptive_options", error);
}
