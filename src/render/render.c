/* The driver: a picture in tiles, each done by one thread from its pixels' own random numbers, so that
 * neither threads nor the order of tiles can change it. */
#include <aureole/render.h>

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/parallel.h"
#include "transport/integrator.h"

enum { TILE_SIZE = 16 };

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
        s->x1 = s->width;
        s->y1 = s->height;
    }
    if (s->x0 >= s->x1 || s->y0 >= s->y1 || s->x1 > s->width || s->y1 > s->height)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "crop %zu,%zu,%zu,%zu is not a part of the picture: 0 <= x0 < x1 <= %zu and 0 <= y0 < y1 <= %zu",
            s->x0, s->x1, s->y0, s->y1, s->width, s->height);
    return AUR_OK;
}

typedef struct tile_count {
    uint64_t rays, invalid;
} tile_count;

typedef struct render_work {
    const aur_scene *scene;
    const aur_integrator *integrator;
    const aur_sampler *sampler;
    const settings *settings;
    aur_image *image;
    size_t tiles_a_row;
    tile_count *counts; /* one a tile */
} render_work;

/* Returns the sample's weight. */
static float camera_sample(const render_work *work, size_t x, size_t y, uint32_t index,
                           aur_camera_sample *sample) {
    const settings *const s = work->settings;
    sample->stream = (aur_stream){work->sampler, aur_hash3(s->seed, y, x), index};
    float offset[2] = {0.0f, 0.0f}, lens[2];
    if (!work->integrator->pixel_centre) {
        float u[2];
        aur_stream_pair(&sample->stream, AUR_PAIR_FILTER, u);
        offset[0] = aur_filter_sample(s->filter, u[0]);
        offset[1] = aur_filter_sample(s->filter, u[1]);
    }
    aur_stream_pair(&sample->stream, AUR_PAIR_LENS, lens);
    aur_camera_ray(work->scene, s->width, s->height, (float)x + 0.5f + offset[0], (float)y + 0.5f + offset[1],
                   lens, &sample->ray);
    return aur_filter_weight(s->filter, offset[0]) * aur_filter_weight(s->filter, offset[1]);
}

static bool is_valid(aur_vector radiance) {
    return aur_vector_is_finite(radiance) && radiance.x >= 0.0f && radiance.y >= 0.0f && radiance.z >= 0.0f;
}

/* The mean of a pixel's samples; samples that are no radiance are counted and left out. */
static void render_pixel(const render_work *work, size_t x, size_t y, float *pixel, aur_counters *counters,
                         uint64_t *invalid) {
    double sum[3] = {0};
    size_t valid = 0;
    for (size_t i = 0; i < work->settings->samples_per_pixel; ++i) {
        aur_camera_sample sample;
        const double weight = (double)camera_sample(work, x, y, (uint32_t)i, &sample);
        const aur_vector radiance =
            work->integrator->descriptor->radiance(work->integrator, &sample, counters);
        if (!is_valid(radiance)) {
            ++*invalid;
            continue;
        }
        sum[0] += weight * (double)radiance.x;
        sum[1] += weight * (double)radiance.y;
        sum[2] += weight * (double)radiance.z;
        ++valid;
    }
    for (size_t c = 0; c < 3; ++c)
        pixel[c] = valid > 0 ? (float)(sum[c] / (double)valid) : 0.0f;
}

static aur_result render_tile(void *context, size_t index) {
    const render_work *const work = context;
    const settings *const s = work->settings;
    const size_t x0 = s->x0 + index % work->tiles_a_row * TILE_SIZE;
    const size_t y0 = s->y0 + index / work->tiles_a_row * TILE_SIZE;
    const size_t x1 = x0 + TILE_SIZE < s->x1 ? x0 + TILE_SIZE : s->x1;
    const size_t y1 = y0 + TILE_SIZE < s->y1 ? y0 + TILE_SIZE : s->y1;
    aur_counters counters = {0};
    uint64_t invalid = 0;
    for (size_t y = y0; y < y1; ++y)
        for (size_t x = x0; x < x1; ++x)
            render_pixel(work, x, y, &work->image->data[3 * ((y - s->y0) * work->image->width + (x - s->x0))],
                         &counters, &invalid);
    work->counts[index] = (tile_count){counters.rays, invalid};
    return AUR_OK;
}

static double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static aur_result render_image(const render_work *work, const aur_render_options *options,
                               aur_render_statistics *statistics, aur_error *error) {
    const settings *const s = work->settings;
    const size_t tile_count_y = (s->y1 - s->y0 + TILE_SIZE - 1) / TILE_SIZE;
    const size_t tiles = work->tiles_a_row * tile_count_y;
    render_work here = *work;
    here.counts = calloc(tiles, sizeof *here.counts);
    if (here.counts == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const aur_parallel_options parallel = {
        .threads = s->threads, .what = "rendering", .progress = options->progress};
    const aur_result result = aur_parallel_for(&parallel, tiles, render_tile, &here);
    if (result != AUR_OK)
        aur_fail(error, result, "rendering: %s", aur_result_string(result));
    for (size_t i = 0; i < tiles; ++i) {
        statistics->rays += here.counts[i].rays;
        statistics->invalid_samples += here.counts[i].invalid;
    }
    statistics->samples = (uint64_t)(s->x1 - s->x0) * (s->y1 - s->y0) * s->samples_per_pixel;
    free(here.counts);
    return result;
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

aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options, aur_image **image,
                               aur_render_statistics *statistics, aur_error *error) {
    static const aur_render_options defaults = {0};
    *image = NULL;
    if (options == NULL)
        options = &defaults;
    settings s;
    aur_result result = resolve(renderer->scene, options, &s, error);
    if (result != AUR_OK)
        return result;
    aur_render_statistics counted = {0};
    aur_sampler *sampler = NULL;
    aur_integrator *integrator = NULL;
    const double start = seconds_now();
    result = aur_sampler_create(s.sampler, s.samples_per_pixel, &options->warnings, &sampler, error);
    if (result == AUR_OK)
        result = make_integrator(renderer, options, &s, &integrator, error);
    if (result == AUR_OK)
        result = aur_image_create(s.x1 - s.x0, s.y1 - s.y0, 3, image, error);
    const double prepared = seconds_now();
    if (result == AUR_OK) {
        const render_work work = {.scene = renderer->scene,
                                  .integrator = integrator,
                                  .sampler = sampler,
                                  .settings = &s,
                                  .image = *image,
                                  .tiles_a_row = (s.x1 - s.x0 + TILE_SIZE - 1) / TILE_SIZE};
        result = render_image(&work, options, &counted, error);
    }
    counted.prepare_seconds = prepared - start;
    counted.render_seconds = seconds_now() - prepared;
    aur_integrator_destroy(integrator);
    aur_sampler_destroy(sampler);
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
