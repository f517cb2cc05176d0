/* The driver: a film in tiles, each rendered by one thread from its pixels' random numbers, so that the
 * result does not depend on threads or the order of tiles. */
#include <aureole-render/render.h>
#include <aureole/text.h>

#include <inttypes.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/bytes.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/words.h"
#include "points/ranks/ranks.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/film/integrator.h"
#include "render/image/format.h"
#include "render/scene/sensor.h"

struct aur_renderer {
    const aur_scene *scene;
    aur_cache *cache;
};

struct aur_render {
    aur_renderer *renderer;
    /* Complete; their strings belong to the caller and are invalid once the render is created. */
    aur_render_options settings;
    aur_sampler *sampler;
    aur_integrator *integrator;
    aur_view view;
    aur_film *film;
    aur_render_statistics statistics; /* its times, and rays that prepared it; the film counts the others */
    char *identity;                   /* of a resumable render; else NULL */
    atomic_bool cancelled;
    /* AUR_OK, or why a step failed for good and left pixels with a part of their samples. */
    aur_result broken;
};

aur_result aur_renderer_create(const aur_scene *scene, aur_renderer **out, aur_error *error) {
    *out = NULL;
    const aur_result result = aur_scene_check_camera(scene, error);
    if (result != AUR_OK)
        return result;
    aur_renderer *const renderer = calloc(1, sizeof *renderer);
    if (renderer != NULL)
        renderer->cache = aur_cache_create();
    if (renderer == NULL || renderer->cache == NULL) {
        free(renderer);
        return aur_fail_memory(error);
    }
    renderer->scene = scene;
    *out = renderer;
    return AUR_OK;
}

void aur_renderer_destroy(aur_renderer *renderer) {
    if (renderer == NULL)
        return;
    aur_cache_destroy(renderer->cache);
    free(renderer);
}

aur_result aur_render_check_scene(const aur_scene *scene, const aur_gather_integrator *gather,
                                  aur_error *error) {
    aur_parameters parameters;
    aur_result result = aur_parameters_copy(aur_scene_integrator(scene), &parameters, error);
    if (result == AUR_OK)
        result = aur_integrator_check(&parameters, gather, error);
    aur_parameters_release(&parameters);
    return result;
}

const aur_scene *aur_renderer_scene(const aur_renderer *renderer) {
    return renderer->scene;
}

aur_cache *aur_renderer_cache(const aur_renderer *renderer) {
    return renderer->cache;
}

/* --- preparation */

static aur_integrator_context context_of(const aur_render *render) {
    const aur_render_options *const s = &render->settings;
    return (aur_integrator_context){.scene = render->renderer->scene,
                                    .samples_per_pixel = s->samples_per_pixel,
                                    .seed = s->seed,
                                    .threads = s->threads,
                                    .cache = render->renderer->cache,
                                    .use_cache = s->use_cache,
                                    .progress = s->progress,
                                    .warnings = s->warnings,
                                    .gather = s->gather};
}

/* Adds a model's limit of path lengths to an integrator that sets none. */
static aur_result limit_depth(const aur_scene *scene, aur_parameters *parameters, aur_error *error) {
    const char *const depth = aur_scene_is_model(scene) ? aur_scene_integrator_key(scene, "max_depth") : NULL;
    if (depth == NULL || aur_parameters_find(parameters, "max_depth") != NULL)
        return AUR_OK;
    return aur_parameters_add_text(parameters, AUR_PARAMETER_INTEGER, "max_depth", depth,
                                   parameters->location, error);
}

/* The integrator that the options or the scene name. */
static aur_result make_integrator(aur_render *render, aur_error *error) {
    aur_renderer *const renderer = render->renderer;
    const aur_render_options *const s = &render->settings;
    aur_parameters parameters;
    aur_result result = s->integrator != NULL
                            ? aur_parameters_parse(&parameters, "integrator", s->integrator, error)
                            : aur_parameters_copy(aur_scene_integrator(renderer->scene), &parameters, error);
    if (result != AUR_OK)
        return result;
    const aur_integrator_context context = context_of(render);
    if (s->integrator != NULL)
        result = limit_depth(renderer->scene, &parameters, error);
    if (result == AUR_OK && s->clamp != 0.0) {
        char text[40];
        aur_format(text, sizeof text, "%.9g", s->clamp);
        result = aur_parameters_add_text(&parameters, AUR_PARAMETER_FLOAT, "clamp", text, parameters.location,
                                         error);
    }
    if (result == AUR_OK)
        result = aur_integrator_create(&parameters, &context, &render->integrator, error);
    aur_parameters_release(&parameters);
    return result;
}

/* The side of the cells by which pixels share samples; 0 if they do not. */
static size_t cell_of(const aur_render *render, const aur_filter *filter) {
    if (render->integrator->pixel_centre || render->integrator->descriptor->round != NULL ||
        aur_camera_factor(render->renderer->scene) != 1.0f || !aur_filter_shares_samples(filter))
        return 0;
    return render->integrator->whole_tiles || render->settings.samples_per_pixel < AUR_SAMPLES_PER_PIXEL_MAX
               ? AUR_TILE_SIZE
               : AUR_FILM_CELL;
}

static aur_result make_film(aur_render *render, const aur_filter *filter, aur_error *error) {
    const aur_render_options *const s = &render->settings;
    const aur_integrator *const integrator = render->integrator;
    const aur_film_layout layout = {.width = s->width,
                                    .height = s->height,
                                    .x0 = s->crop_x0,
                                    .x1 = s->crop_x1,
                                    .y0 = s->crop_y0,
                                    .y1 = s->crop_y1,
                                    .channel_count = 3 + integrator->extra_count,
                                    .cell = cell_of(render, filter),
                                    .filter = *filter};
    const aur_result result = aur_film_create(&layout, &render->film, error);
    for (size_t c = 0; result == AUR_OK && c < integrator->extra_count; ++c) {
        aur_film_channel *const channel = &render->film->channels[3 + c];
        snprintf(channel->name, sizeof channel->name, "%s", integrator->extra_names[c]);
        channel->kind = integrator->extra_kinds != NULL ? integrator->extra_kinds[c] : AUR_CHANNEL_MEAN;
    }
    return result;
}

static aur_result prepare(aur_render *render, aur_error *error) {
    const aur_scene *const scene = render->renderer->scene;
    aur_render_options *const s = &render->settings;
    const aur_filter *filter;
    aur_result result = aur_render_options_complete(scene, s, &filter, error);
    if (result == AUR_OK)
        result = aur_sampler_create(s->sampler, s->samples_per_pixel, &s->warnings, &render->sampler, error);
    if (result == AUR_OK && s->shard_count != 0 && (s->shard == 0 || s->shard > s->shard_count))
        result = aur_fail(error, AUR_ERROR_ARGUMENT,
                          "part must be from 1 to the number of parts (found %zu of %zu)", s->shard,
                          s->shard_count);
    if (result == AUR_OK && s->resumable)
        result = aur_render_identify(scene, s, &render->identity, error);
    if (result == AUR_OK)
        result = make_integrator(render, error);
    if (result == AUR_OK)
        result = make_film(render, filter, error);
    if (result != AUR_OK)
        return result;
    const float factor = aur_camera_factor(scene);
    const bool is_box =
        render->film->spread != NULL || factor != 1.0f || render->integrator->descriptor->round != NULL;
    render->view = (aur_view){.scene = scene,
                              .factor = factor,
                              .sampler = render->sampler,
                              .filter = is_box ? aur_filter_find("box") : filter,
                              .reach = render->film->spread != NULL ? render->film->spread->reach : 0,
                              .width = s->width,
                              .height = s->height,
                              .seed = s->seed,
                              .pixel_centre = render->integrator->pixel_centre,
                              .has_lens = aur_camera_has_lens(scene)};
    const aur_integrator_context context = context_of(render);
    return render->integrator->descriptor->prepare_view != NULL
               ? render->integrator->descriptor->prepare_view(&render->view, &context, render->integrator,
                                                              error)
               : AUR_OK;
}

void aur_stopwatch_add(const aur_stopwatch *start, double *wall, double *cpu) {
    double seconds = aur_clock_seconds(CLOCK_MONOTONIC) - start->wall;
    double of_processors = aur_clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - start->cpu;
    aur_ranks_share_seconds(&seconds, &of_processors);
    *wall += seconds;
    *cpu += of_processors;
}

aur_result aur_render_create(aur_renderer *renderer, const aur_render_options *options, aur_render **out,
                             aur_error *error) {
    *out = NULL;
    aur_render *const render = calloc(1, sizeof *render);
    if (render == NULL)
        return aur_fail_memory(error);
    render->renderer = renderer;
    atomic_init(&render->cancelled, false);
    const aur_stopwatch start = aur_stopwatch_start();
    const uint64_t before = aur_rays_traced;
    aur_render_options *const local = &render->settings;
    local->size = sizeof(aur_render_options);
    aur_render_options_init(local, NULL);
    aur_result result = aur_options_read(options, sizeof *local, local, "aur_render_options", error);
    if (result == AUR_OK)
        result = prepare(render, error);
    render->statistics.rays = aur_rays_traced - before;
    aur_stopwatch_add(&start, &render->statistics.prepare_seconds, &render->statistics.cpu_seconds);
    if (result != AUR_OK) {
        aur_render_destroy(render);
        return result;
    }
    *out = render;
    return AUR_OK;
}

void aur_render_destroy(aur_render *render) {
    if (render == NULL)
        return;
    aur_film_destroy(render->film);
    aur_integrator_destroy(render->integrator);
    aur_sampler_destroy(render->sampler);
    free(render->identity);
    free(render);
}

const aur_integrator *aur_render_integrator(const aur_render *render) {
    return render->integrator;
}

/* --- steps */

/* Whether the tile belongs to the shard of this render. */
static bool is_in_shard(const aur_render *render, size_t tile) {
    const aur_render_options *const s = &render->settings;
    return s->shard_count == 0 || tile % s->shard_count == s->shard - 1;
}

typedef struct render_work {
    aur_render *render;
    aur_film_targets targets;
    aur_counters *counted; /* of each tile, for other processes; NULL: there are none */
} render_work;

static aur_result add_samples(const aur_integrator *integrator, aur_tile *tile) {
    if (integrator->descriptor->tile != NULL)
        return integrator->descriptor->tile(integrator, tile);
    aur_integrator_add_samples(integrator, tile);
    return AUR_OK;
}

/* Renders all missing samples of the tile, in pieces if this does not change the result: finished pieces
 * survive cancellation, even in a tile that takes hours. Pieces grow up to this many rays, some hundredths of
 * a second. */
static aur_result add_pieces(aur_render *render, aur_tile *tile, aur_counters *counted) {
    enum { RAYS_A_PIECE = 1 << 16 };
    const uint32_t end = tile->first + tile->count;
    const bool cuts = aur_integrator_cuts(render->integrator), holds = cuts && tile->spread != NULL;
    const uint32_t most = holds ? AUR_SPREAD_PIECE : end;
    uint32_t piece = cuts ? 1 : end;
    while (tile->first < end) {
        tile->count = piece < end - tile->first ? piece : end - tile->first;
        if (holds && !aur_tile_hold(tile))
            return AUR_ERROR_MEMORY;
        for (size_t y = tile->y0; y < tile->y1; ++y)
            for (size_t x = tile->x0; x < tile->x1; ++x)
                tile->counters.samples += aur_tile_needed(tile, x, y);
        const uint64_t before = aur_rays_traced;
        const aur_result result = add_samples(render->integrator, tile);
        if (result != AUR_OK)
            return result;
        if (tile->counters.stopped)
            return AUR_ERROR_CANCELLED;
        if (holds)
            aur_tile_release(tile);
        if (tile->slots.failed)
            return AUR_ERROR_MEMORY;
        const uint64_t rays = tile->counters.rays = aur_rays_traced - before;
        if (counted != NULL)
            aur_counters_add(counted, &tile->counters);
        aur_film_take_tile(render->film, tile);
        if (rays < RAYS_A_PIECE && piece < most)
            piece *= 2;
        if (tile->first < end && aur_tile_stops(tile))
            return AUR_ERROR_CANCELLED;
    }
    return AUR_OK;
}

static aur_result render_tile(void *context, size_t index) {
    const render_work *const work = context;
    aur_render *const render = work->render;
    if (atomic_load_explicit(&render->cancelled, memory_order_relaxed))
        return AUR_ERROR_CANCELLED;
    aur_tile tile = {.view = &render->view, .stop = &render->cancelled, .rays_checked = aur_rays_traced};
    aur_film_before before;
    if (!is_in_shard(render, index))
        return AUR_OK;
    aur_result result = aur_film_open_tile(render->film, index, &work->targets, &tile, &before);
    if (result == AUR_OK)
        result = add_pieces(render, &tile, work->counted != NULL ? &work->counted[index] : NULL);
    aur_film_close_tile(render->film, &tile, &before);
    return result;
}

static bool pack_tile(void *context, size_t index, aur_bytes *bytes) {
    const render_work *const work = context;
    if (!is_in_shard(work->render, index))
        return true;
    aur_bytes_put(bytes, sizeof work->counted[index], &work->counted[index]);
    aur_film_put_tile(work->render->film, index, bytes);
    return true;
}

static aur_result unpack_tile(void *context, size_t index, aur_bytes_reader *bytes) {
    const render_work *const work = context;
    if (!is_in_shard(work->render, index))
        return AUR_OK;
    aur_bytes_get(bytes, sizeof work->counted[index], &work->counted[index]);
    aur_film_get_tile(work->render->film, index, &work->counted[index], bytes);
    return bytes->failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

/* Cut paths cause a warning above this number per thousand samples. */
enum { MOST_CUT_PATHS = 10 };

/* Said once, when all samples are there. */
static void warn_of_losses(const aur_render *render) {
    const aur_counters *const counted = &render->film->counters;
    const aur_warnings *const warnings = &render->settings.warnings;
    const unsigned long long samples = counted->samples;
    if (aur_render_samples(render) < render->settings.samples_per_pixel)
        return;
    if (counted->invalid > 0)
        aur_warn_at(warnings, (aur_location){0},
                    "%llu of %llu samples were NaN, infinite or negative and are left out",
                    (unsigned long long)counted->invalid, samples);
    if (counted->unsolved > 0)
        aur_warn_at(warnings, (aur_location){0},
                    "%llu systems for optimal weights could not be solved, and samples there are NaN: take "
                    "a larger 'regularization'",
                    (unsigned long long)counted->unsolved);
    if (1000 * counted->cut > MOST_CUT_PATHS * counted->samples)
        aur_warn_at(warnings, (aur_location){0},
                    "%llu paths of %llu samples were cut after many mirrors, hidden lights or null "
                    "collisions in a row: their further light is missing",
                    (unsigned long long)counted->cut, samples);
}

/* The progress callback returns the request of aur_render_cancel, so that every check for cancellation sees
 * it. */
static int should_stop(void *user, const char *what, uint64_t done, uint64_t total) {
    const aur_render *const render = user;
    const aur_progress *const progress = &render->settings.progress;
    if (atomic_load_explicit(&render->cancelled, memory_order_relaxed))
        return 1;
    return progress->function != NULL ? progress->function(progress->user, what, done, total) : 0;
}

/* Sample by sample of the whole image, for light tracing. All pixels get the largest target of any of them.
 */
static aur_result do_rounds(render_work *work, const aur_parallel_options *parallel, aur_error *error) {
    aur_render *const render = work->render;
    const size_t done = aur_render_samples(render);
    size_t end = work->targets.all;
    for (size_t i = 0; work->targets.pixels != NULL && i < aur_film_pixel_count(render->film); ++i)
        end = work->targets.pixels[i] > end ? work->targets.pixels[i] : end;
    aur_progress_span span = {.whole = parallel->progress};
    aur_parallel_options inner = *parallel, tiles = *parallel;
    inner.progress = aur_progress_within(&span);
    tiles.progress = (aur_progress){NULL, NULL};
    aur_result result = AUR_OK;
    for (size_t i = done; i < end && result == AUR_OK; ++i) {
        aur_counters counters = {0};
        const uint64_t before = aur_rays_traced;
        span.from = (double)(i - done) / (double)(end - done);
        span.to = (double)(i + 1 - done) / (double)(end - done);
        work->targets = (aur_film_targets){.all = (uint32_t)i + 1};
        result = render->integrator->descriptor->round(render->integrator, &render->view,
                                                       &render->film->layout.filter, (uint32_t)i, &inner,
                                                       &counters, error);
        if (result == AUR_OK)
            result = aur_parallel_for(&tiles, render->film->tile_count, render_tile, work, error);
        counters.rays = aur_rays_traced - before;
        pthread_mutex_lock(render->film->lock);
        aur_counters_add(&render->film->counters, &counters);
        pthread_mutex_unlock(render->film->lock);
    }
    return result;
}

static aur_result do_work(aur_render *render, render_work *work, aur_error *error) {
    if (render->broken != AUR_OK)
        return aur_fail(error, render->broken, "rendering: an earlier step failed: %s",
                        aur_result_string(render->broken));
    work->render = render;
    if (aur_ranks_count() > 1) {
        work->counted = calloc(render->film->tile_count, sizeof *work->counted);
        if (work->counted == NULL)
            return aur_fail_memory(error);
    }
    const aur_parallel_share share = {.pack = pack_tile, .unpack = unpack_tile};
    const aur_stopwatch start = aur_stopwatch_start();
    const aur_parallel_options parallel = {.threads = render->settings.threads,
                                           .what = "rendering",
                                           .progress = {.function = should_stop, .user = render},
                                           .flush_denormals = true,
                                           .share = &share};
    const aur_result result =
        render->integrator->descriptor->round != NULL
            ? do_rounds(work, &parallel, error)
            : aur_parallel_for(&parallel, render->film->tile_count, render_tile, work, error);
    free(work->counted);
    aur_stopwatch_add(&start, &render->statistics.render_seconds, &render->statistics.cpu_seconds);
    warn_of_losses(render);
    atomic_store(&render->cancelled, false);
    if (result != AUR_OK && result != AUR_ERROR_CANCELLED)
        render->broken = result;
    return result;
}

aur_result aur_render_step(aur_render *render, size_t count, aur_error *error) {
    const size_t target = render->settings.samples_per_pixel, done = aur_render_samples(render);
    if (done >= target && render->broken == AUR_OK)
        return AUR_OK;
    if (count == 0 || count > target - done)
        count = target - done;
    render_work work = {.targets = {.all = (uint32_t)(done + count)}};
    return do_work(render, &work, error);
}

aur_result aur_render_step_pixels(aur_render *render, size_t pixel_count, const uint32_t *targets,
                                  aur_error *error) {
    if (pixel_count != aur_film_pixel_count(render->film))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "targets of %zu pixels for a film of %zu", pixel_count,
                        aur_film_pixel_count(render->film));
    for (size_t i = 0; i < pixel_count; ++i)
        if (targets[i] > render->settings.samples_per_pixel)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "pixel %zu is to have %" PRIu32 " samples, more than the options' %zu", i,
                            targets[i], render->settings.samples_per_pixel);
    render_work work = {.targets = {.pixels = targets, .whole_tiles = render->integrator->whole_tiles}};
    return do_work(render, &work, error);
}

void aur_render_cancel(aur_render *render) {
    atomic_store_explicit(&render->cancelled, true, memory_order_relaxed);
}

size_t aur_render_samples(const aur_render *render) {
    uint32_t least = (uint32_t)render->settings.samples_per_pixel;
    for (size_t i = 0; i < aur_film_unit_count(render->film); ++i) {
        const uint32_t given = aur_film_unit_given(render->film, i);
        if (given < least && is_in_shard(render, aur_film_unit_tile(render->film, i)))
            least = given;
    }
    return least;
}

bool aur_render_steps_agree(const aur_render *render) {
    return aur_integrator_cuts(render->integrator);
}

size_t aur_render_samples_target(const aur_render *render) {
    return render->settings.samples_per_pixel;
}

const aur_film *aur_render_film(const aur_render *render) {
    return render->film;
}

aur_result aur_render_merge(aur_render *render, const aur_film *film, aur_error *error) {
    return aur_film_merge(render->film, film, error);
}

aur_result aur_render_get_statistics(const aur_render *render, aur_render_statistics *statistics,
                                     aur_error *error) {
    aur_render_statistics local = render->statistics;
    const aur_counters counted = aur_film_counted(render->film);
    local.rays += counted.rays;
    local.samples = counted.samples;
    local.invalid_samples = counted.invalid;
    local.cut_paths = counted.cut;
    local.unsolved_weights = counted.unsolved;
    memcpy(local.levels, counted.levels, sizeof local.levels);
    return aur_description_write(&local, sizeof local, statistics, "aur_render_statistics", error);
}

const char *aur_render_identity(const aur_render *render) {
    return render->identity;
}

void aur_render_put_spent(const aur_render *render, uint64_t words[AUR_SPENT_WORDS]) {
    words[0] = aur_word_of_double(render->statistics.prepare_seconds);
    words[1] = aur_word_of_double(render->statistics.render_seconds);
    words[2] = aur_word_of_double(render->statistics.cpu_seconds);
    words[3] = render->statistics.rays;
}

void aur_render_take_spent(aur_render *render, const uint64_t words[AUR_SPENT_WORDS]) {
    render->statistics.prepare_seconds += aur_double_of_word(words[0]);
    render->statistics.render_seconds += aur_double_of_word(words[1]);
    render->statistics.cpu_seconds += aur_double_of_word(words[2]);
    render->statistics.rays += words[3];
}

aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options, aur_image **image,
                               aur_render_statistics *statistics, aur_error *error) {
    *image = NULL;
    aur_render *render;
    aur_result result = aur_render_create(renderer, options, &render, error);
    if (result != AUR_OK)
        return result;
    result = aur_render_step(render, 0, error);
    if (result == AUR_OK || result == AUR_ERROR_CANCELLED) {
        const aur_result developed = aur_film_develop(render->film, image, error);
        result = developed != AUR_OK ? developed : result;
    }
    if (statistics != NULL && (result == AUR_OK || result == AUR_ERROR_CANCELLED)) {
        const aur_result status = aur_render_get_statistics(render, statistics, error);
        result = status != AUR_OK ? status : result;
    }
    aur_render_destroy(render);
    return result;
}

aur_result aur_render_options_init(aur_render_options *options, aur_error *error) {
    static const aur_render_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_render_options", error);
}
