/* The driver: a picture in tiles, each done by one thread from its pixels' own random numbers, so that
 * neither threads nor the order of tiles can change it. */
#include <aureole/render.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/parallel.h"
#include "transport/integrator.h"

struct aur_renderer {
    const aur_scene *scene;
    aur_cache *cache;
};

size_t aur_integrator_count(void) {
    size_t count = 0;
    while (aur_integrator_descriptor_at(count) != NULL)
        ++count;
    return count;
}

const aur_integrator_description *aur_integrator_at(size_t index) {
    const aur_integrator_descriptor *const descriptor = aur_integrator_descriptor_at(index);
    return descriptor != NULL ? &descriptor->description : NULL;
}

aur_result aur_renderer_create(const aur_scene *scene, aur_renderer **out, aur_error *error) {
    *out = NULL;
    aur_renderer *const renderer = calloc(1, sizeof *renderer);
    if (renderer != NULL)
        renderer->cache = aur_cache_create();
    if (renderer == NULL || renderer->cache == NULL) {
        free(renderer);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
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

/* The options with the scene's own values in the places that were left open. */
typedef struct settings {
    size_t width, height, samples_per_pixel;
    size_t x0, x1, y0, y1;
    const aur_filter *filter;
    const char *sampler;
    uint64_t seed;
    size_t threads;
} settings;

static aur_result resolve(const aur_scene *scene, const aur_render_options *options, settings *s,
                          aur_error *error) {
    const aur_film *const film = aur_scene_film(scene);
    *s = (settings){.width = options->width > 0 ? options->width : film->width,
                    .height = options->height > 0 ? options->height : film->height,
                    .samples_per_pixel = options->samples_per_pixel > 0 ? options->samples_per_pixel
                                                                        : aur_scene_samples_per_pixel(scene),
                    .filter = film->filter,
                    .sampler = options->sampler != NULL ? options->sampler : aur_scene_sampler(scene),
                    .seed = options->seed,
                    .threads = options->threads,
                    .x0 = options->crop_x0,
                    .x1 = options->crop_x1,
                    .y0 = options->crop_y0,
                    .y1 = options->crop_y1};
    if (options->filter != NULL) {
        s->filter = aur_filter_find(options->filter);
        if (s->filter == NULL)
            return aur_fail(error, AUR_ERROR_NAME,
                            "unknown filter '%s'; the filters are: box, tent, gaussian, mitchell",
                            options->filter);
    }
    if (s->x0 == 0 && s->x1 == 0 && s->y0 == 0 && s->y1 == 0) {
        /* The film's own part holds for its own size. */
        const bool part = film->crop_x1 > 0 && s->width == film->width && s->height == film->height;
        s->x0 = part ? film->crop_x0 : 0;
        s->x1 = part ? film->crop_x1 : s->width;
        s->y0 = part ? film->crop_y0 : 0;
        s->y1 = part ? film->crop_y1 : s->height;
    }
    if (s->x0 >= s->x1 || s->y0 >= s->y1 || s->x1 > s->width || s->y1 > s->height)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "crop %zu,%zu,%zu,%zu is not a part of the picture: 0 <= x0 < x1 <= %zu and 0 <= y0 < y1 <= %zu",
            s->x0, s->x1, s->y0, s->y1, s->width, s->height);
    return AUR_OK;
}

/* The sums of a picture's pixels. */
typedef struct film {
    size_t width, height, channel_count;
    double *sums;
    uint32_t *counts;
} film;

typedef struct render_work {
    const aur_integrator *integrator;
    const aur_view *view;
    const settings *settings;
    const film *film;
    size_t column0, row0, columns, tiles; /* on the grid over the whole picture */
    uint32_t first, count;                /* samples of the wave */
    aur_counters *counters;               /* one a tile */
} render_work;

static aur_result add_samples(const aur_integrator *integrator, aur_tile *tile) {
    if (integrator->descriptor->tile != NULL)
        return integrator->descriptor->tile(integrator, tile);
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            for (uint32_t i = 0; i < tile->count; ++i) {
                aur_camera_sample sample;
                const float weight = aur_view_sample(tile->view, x, y, tile->first + i, &sample);
                const aur_vector radiance =
                    integrator->descriptor->radiance(integrator, &sample, &tile->counters);
                aur_tile_add(tile, x, y, weight, radiance);
            }
    return AUR_OK;
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

static aur_result render_tile(void *context, size_t index) {
    const render_work *const work = context;
    const settings *const s = work->settings;
    const film *const f = work->film;
    const size_t x = (work->column0 + index % work->columns) * AUR_TILE_SIZE;
    const size_t y = (work->row0 + index / work->columns) * AUR_TILE_SIZE;
    aur_tile tile = {.view = work->view,
                     .x0 = larger(x, s->x0),
                     .x1 = smaller(x + AUR_TILE_SIZE, s->x1),
                     .y0 = larger(y, s->y0),
                     .y1 = smaller(y + AUR_TILE_SIZE, s->y1),
                     .first = work->first,
                     .count = work->count,
                     .stride = f->width,
                     .channel_count = f->channel_count};
    const size_t pixel = (tile.y0 - s->y0) * f->width + (tile.x0 - s->x0);
    tile.sums = &f->sums[pixel * f->channel_count];
    tile.counts = &f->counts[pixel];
    const aur_result result = add_samples(work->integrator, &tile);
    work->counters[index] = tile.counters;
    return result;
}

static double seconds_of(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A stretch of work by two clocks. */
typedef struct stopwatch {
    double wall, cpu;
} stopwatch;

static stopwatch stopwatch_start(void) {
    return (stopwatch){seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

static void stopwatch_add(const stopwatch *start, double *wall, double *cpu) {
    *wall += seconds_of(CLOCK_MONOTONIC) - start->wall;
    *cpu += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start->cpu;
}

static void lay_tiles(render_work *work) {
    const settings *const s = work->settings;
    work->column0 = s->x0 / AUR_TILE_SIZE;
    work->row0 = s->y0 / AUR_TILE_SIZE;
    work->columns = (s->x1 + AUR_TILE_SIZE - 1) / AUR_TILE_SIZE - work->column0;
    work->tiles = work->columns * ((s->y1 + AUR_TILE_SIZE - 1) / AUR_TILE_SIZE - work->row0);
}

/* The samples first .. first + count - 1 of every pixel. */
static aur_result render_wave(render_work *work, const aur_render_options *options,
                              aur_render_statistics *statistics, aur_error *error) {
    const settings *const s = work->settings;
    work->counters = calloc(work->tiles, sizeof *work->counters);
    if (work->counters == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const stopwatch start = stopwatch_start();
    const aur_parallel_options parallel = {
        .threads = s->threads, .what = "rendering", .progress = options->progress};
    const aur_result result = aur_parallel_for(&parallel, work->tiles, render_tile, work);
    if (result != AUR_OK)
        aur_fail(error, result, "rendering: %s", aur_result_string(result));
    stopwatch_add(&start, &statistics->render_seconds, &statistics->cpu_seconds);
    for (size_t i = 0; i < work->tiles; ++i) {
        statistics->rays += work->counters[i].rays;
        statistics->invalid_samples += work->counters[i].invalid;
        for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
            statistics->levels[l] += work->counters[i].levels[l];
    }
    statistics->samples += (uint64_t)(s->x1 - s->x0) * (s->y1 - s->y0) * work->count;
    free(work->counters);
    work->counters = NULL;
    return result;
}

static aur_result film_create(film *f, size_t width, size_t height, size_t channel_count, aur_error *error) {
    *f = (film){.width = width, .height = height, .channel_count = channel_count};
    f->sums = calloc(width * height, channel_count * sizeof *f->sums);
    f->counts = calloc(width * height, sizeof *f->counts);
    if (f->sums != NULL && f->counts != NULL)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a picture of %zu x %zu", width, height);
}

static void film_release(film *f) {
    free(f->sums);
    free(f->counts);
}

static void develop_pixel(const film *f, const aur_integrator *integrator, size_t index, float *pixel) {
    const uint32_t count = f->counts[index];
    double mean[3 + AUR_EXTRA_CHANNELS_MAX];
    for (size_t c = 0; c < f->channel_count; ++c)
        mean[c] = count > 0 ? f->sums[index * f->channel_count + c] / (double)count : 0.0;
    if (integrator->descriptor->develop != NULL)
        integrator->descriptor->develop(integrator, count, mean);
    for (size_t c = 0; c < f->channel_count; ++c)
        pixel[c] = (float)mean[c];
}

/* The mean of every pixel's samples. */
static aur_result develop(const film *f, const aur_integrator *integrator, aur_image **image,
                          aur_error *error) {
    const aur_result result = aur_image_create(f->width, f->height, f->channel_count, image, error);
    if (result != AUR_OK)
        return result;
    static const char *const colors[] = {"R", "G", "B"};
    for (size_t c = 0; c < f->channel_count; ++c)
        snprintf((*image)->channel_names[c], AUR_CHANNEL_NAME_CAPACITY, "%s",
                 c < 3 ? colors[c] : integrator->extra_names[c - 3]);
    for (size_t i = 0; i < f->width * f->height; ++i)
        develop_pixel(f, integrator, i, &(*image)->data[i * f->channel_count]);
    return AUR_OK;
}

/* The integrator that the options or the scene name. */
static aur_result make_integrator(aur_renderer *renderer, const aur_render_options *options,
                                  const settings *s, aur_integrator **integrator, aur_error *error) {
    aur_parameters parameters;
    aur_result result = options->integrator != NULL
                            ? aur_parameters_parse(&parameters, "integrator", options->integrator, error)
                            : aur_parameters_copy(aur_scene_integrator(renderer->scene), &parameters, error);
    if (result != AUR_OK)
        return result;
    const aur_integrator_context context = {.scene = renderer->scene,
                                            .samples_per_pixel = s->samples_per_pixel,
                                            .seed = s->seed,
                                            .threads = s->threads,
                                            .cache = renderer->cache,
                                            .progress = options->progress,
                                            .warnings = options->warnings};
    result = aur_integrator_create(&parameters, &context, integrator, error);
    aur_parameters_release(&parameters);
    return result;
}

/* All samples, wave by wave where somebody waits for them. *image is the last wave's picture. */
static aur_result render_samples(render_work *work, const aur_render_options *options, aur_image **image,
                                 aur_render_statistics *statistics, aur_error *error) {
    const size_t samples = work->settings->samples_per_pixel;
    const bool waves = options->waves.finished != NULL;
    lay_tiles(work);
    for (size_t done = 0; done < samples; done += work->count) {
        const size_t end = waves && 2 * done < samples ? larger(2 * done, 1) : samples;
        work->first = (uint32_t)done;
        work->count = (uint32_t)(end - done);
        aur_image_destroy(*image);
        *image = NULL;
        aur_result result = render_wave(work, options, statistics, error);
        if (result == AUR_OK)
            result = develop(work->film, work->integrator, image, error);
        if (result == AUR_OK && waves)
            result = options->waves.finished(options->waves.context, *image, statistics, error);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

static aur_result render(aur_renderer *renderer, const aur_render_options *options, const settings *s,
                         aur_image **image, aur_render_statistics *counted, aur_error *error) {
    aur_sampler *sampler = NULL;
    aur_integrator *integrator = NULL;
    film pixels = {0};
    const stopwatch start = stopwatch_start();
    aur_result result =
        aur_sampler_create(s->sampler, s->samples_per_pixel, &options->warnings, &sampler, error);
    if (result == AUR_OK)
        result = make_integrator(renderer, options, s, &integrator, error);
    if (result == AUR_OK)
        result = film_create(&pixels, s->x1 - s->x0, s->y1 - s->y0, 3 + integrator->extra_count, error);
    stopwatch_add(&start, &counted->prepare_seconds, &counted->cpu_seconds);
    if (result == AUR_OK) {
        const aur_view view = {.scene = renderer->scene,
                               .sampler = sampler,
                               .filter = s->filter,
                               .width = s->width,
                               .height = s->height,
                               .seed = s->seed,
                               .pixel_centre = integrator->pixel_centre,
                               .has_lens = aur_camera_has_lens(renderer->scene)};
        render_work work = {.integrator = integrator, .view = &view, .settings = s, .film = &pixels};
        result = render_samples(&work, options, image, counted, error);
    }
    film_release(&pixels);
    aur_integrator_destroy(integrator);
    aur_sampler_destroy(sampler);
    return result;
}

aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options, aur_image **image,
                               aur_render_statistics *statistics, aur_error *error) {
    static const aur_render_options defaults = {0};
    *image = NULL;
    if (options == NULL)
        options = &defaults;
    settings s;
    aur_render_statistics counted = {0};
    aur_result result = resolve(renderer->scene, options, &s, error);
    if (result == AUR_OK)
        result = render(renderer, options, &s, image, &counted, error);
    if (result != AUR_OK) {
        aur_image_destroy(*image);
        *image = NULL;
        return result;
    }
    if (counted.invalid_samples > 0)
        aur_warn_at(&options->warnings, (aur_location){0},
                    "%llu of %llu samples were NaN, infinite or negative and are left out",
                    (unsigned long long)counted.invalid_samples, (unsigned long long)counted.samples);
    if (statistics != NULL)
        *statistics = counted;
    return AUR_OK;
}
