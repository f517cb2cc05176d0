/* Light tracing: paths from the lights, each vertex of which is connected to the camera (Dutre, Lafortune,
 * Willems 1993; Veach 1997). A round traces as many paths as the image has pixels and is one sample of every
 * pixel. Paths write lists of splats, which are added in the order of the paths, so that results do not
 * depend on threads and ranks. Light paths cannot find directly visible emitters, or what is seen in mirrors
 * and through glass: one camera ray per pixel adds that. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/bytes.h"
#include "render/path/path.h"

enum { CHUNKS = 32, PATHS_A_CHUNK = 4096, LONGEST_PATH = 512, MOST_PANES = 64 };

typedef struct ptracer {
    uint32_t max_depth, rr_depth;
    bool hide_emitters, specular_paths;
    aur_path path; /* of what the camera sees in mirrors */
    aur_sampler *sampler;
    bool has_panes;
    size_t width, height;
    double *image;    /* [height][width][3] of the last round */
    double *norms[2]; /* of each column and row: what of the filter's integral lies in the image */
} ptracer;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(
        ptracer, "max_depth", max_depth, -1, 1 << 20, "-1",
        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is unlimited")},
    {AUR_KEY_OF_INTEGER(ptracer, "rr_depth", rr_depth, 1, 1 << 20, "5",
                        "Russian roulette from this depth on")},
    {AUR_KEY_OF_BOOLEAN(ptracer, "hide_emitters", hide_emitters, "false", "lights are black to the camera")},
    {AUR_KEY_OF_BOOLEAN(ptracer, "specular_paths", specular_paths, "true",
                        "follow mirrors and glass; false: they are black, as in Mitsuba")},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    ptracer *const self = integrator->data;
    aur_scene_warn_of_media(context->scene, "integrator 'ptracer'", &context->warnings);
    if (!aur_integrator_knows_samples(context))
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "integrator 'ptracer': expected a number of samples (--spp): light paths cannot "
                           "be spent pixel by pixel");
    if (!aur_camera_connects(context->scene))
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "integrator 'ptracer': expected a sensor 'perspective' or 'thinlens'");
    self->has_panes = aur_panes_exist(context->scene);
    self->path = (aur_path){.candidates = 1};
    const aur_result result = aur_path_prepare(&self->path, context->scene, error);
    return result == AUR_OK ? aur_sampler_create("sobol", 1, NULL, &self->sampler, error) : result;
}

static void release(aur_integrator *integrator) {
    ptracer *const self = integrator->data;
    aur_sampler_destroy(self->sampler);
    free(self->path.classes);
    free(self->image);
    free(self->norms[0]);
    free(self->norms[1]);
}

/* --- splats */

typedef struct splat {
    float x, y; /* in pixels */
    float value[3];
} splat;

typedef struct splats {
    size_t count, capacity;
    splat *items;
    aur_counters counters;
} splats;

typedef struct round_work {
    const aur_integrator *integrator;
    const aur_view *view;
    const ptracer *self;
    uint32_t index;     /* of the round */
    size_t first, ends; /* of the batch: numbers of paths and pixels */
    splats *chunks;
} round_work;

/* There are no samples of the camera beyond its edges either. */
static bool is_in_image(const ptracer *self, float x, float y) {
    return x >= 0.0f && x < (float)self->width && y >= 0.0f && y < (float)self->height;
}

static bool add_splat(splats *list, float x, float y, aur_vector value) {
    if (aur_vector_is_zero(value))
        return true;
    if (!aur_is_radiance(value)) {
        ++list->counters.invalid;
        return true;
    }
    if (list->count == list->capacity &&
        !aur_array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items))
        return false;
    list->items[list->count++] = (splat){x, y, {value.x, value.y, value.z}};
    return true;
}

/* --- from the lights */

/* A particle on a surface. */
typedef struct particle {
    const aur_surface *surface;
    aur_vector in; /* unit, to where it comes from */
    aur_vector power;
    uint32_t depth; /* edges so far */
} particle;

/* A particle's contribution to the camera is radiance by its power per area of the geometric surface, where
 * BSDFs count the cosine to the shading normal (Veach 1997, section 5.3.2). */
static bool connect(const round_work *work, const particle *at, const float lens[2], splats *list) {
    const aur_scene *const scene = work->view->scene;
    const aur_surface *const surface = at->surface;
    aur_camera_link link;
    if (at->depth >= work->self->max_depth ||
        !aur_camera_connect(scene, work->view->width, work->view->height, lens, surface->position, &link) ||
        !is_in_image(work->self, link.film.x, link.film.y))
        return true;
    const float cos_in = fabsf(aur_vector_dot(surface->geometric_normal, at->in));
    const float cos_out = fabsf(aur_vector_dot(surface->geometric_normal, link.direction));
    const aur_shading shading = aur_shading_at(surface, aur_vector_scale(link.direction, -1.0f));
    float pdf;
    const aur_vector value = aur_shading_evaluate(&shading, AUR_BSDF_WHOLE, at->in, &pdf);
    if (aur_vector_is_zero(value) || !(cos_in > 0.0f))
        return true;
    aur_ray ray = aur_surface_ray_to(surface, link.origin);
    ray.farthest = aur_larger(ray.farthest - link.nearest, 0.0f);
    aur_vector passed = {1.0f, 1.0f, 1.0f};
    const uint32_t panes = work->self->max_depth - at->depth - 1;
    if (work->self->has_panes)
        passed = aur_panes_passed(scene, &ray, panes < MOST_PANES ? panes : MOST_PANES);
    else if (aur_scene_occluded(scene, &ray))
        return true;
    const float density = cos_out / (cos_in * link.distance * link.distance * link.film.solid_angle);
    return add_splat(
        list, link.film.x, link.film.y,
        aur_vector_scale(aur_vector_multiply(aur_vector_multiply(at->power, value), passed), density));
}

/* Pairs of numbers of a light path. */
enum { PAIR_LIGHT, PAIR_POSITION, PAIR_DIRECTION, PAIR_VERTEX, LENS = 0, LOBE, TOWARDS, PAIRS_A_VERTEX };

static bool trace_light(const round_work *work, size_t number, splats *list) {
    const aur_scene *const scene = work->view->scene;
    const ptracer *const self = work->self;
    const uint64_t path = (uint64_t)work->index * self->width * self->height + number;
    const aur_stream stream = {self->sampler, aur_hash3(work->view->seed, 0x6c69676874, path >> 32),
                               (uint32_t)path};
    float start[PAIR_VERTEX][2], pairs[PAIRS_A_VERTEX][2];
    aur_stream_pairs(&stream, PAIR_LIGHT, PAIR_VERTEX, start);
    aur_ray ray;
    aur_vector power;
    bool hidden;
    if (!aur_light_emit(scene,
                        (const float[5]){start[0][0], start[1][0], start[1][1], start[2][0], start[2][1]},
                        &ray, &power, &hidden))
        return true;
    for (uint32_t depth = 1; depth < self->max_depth; ++depth) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, &ray, &hit))
            return true;
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        aur_stream_pairs(&stream, PAIR_VERTEX + PAIRS_A_VERTEX * (depth - 1), PAIRS_A_VERTEX, pairs);
        const particle at = {&surface, aur_vector_scale(ray.direction, -1.0f), power, depth};
        if (!connect(work, &at, pairs[LENS], list))
            return false;
        const aur_shading shading = aur_shading_at(&surface, at.in);
        aur_bsdf_sample sample;
        if (!aur_shading_sample(
                &shading, (const float[3]){pairs[LOBE][0], pairs[TOWARDS][0], pairs[TOWARDS][1]}, &sample))
            return true;
        const aur_vector weight =
            aur_vertex_adjoint(&shading, &sample, at.in, surface.geometric_normal, 0.0f);
        power = aur_vector_multiply(at.power, weight);
        const float survival = aur_particle_survival(at.power, power);
        if (!(survival > 0.0f) ||
            (depth >= self->rr_depth && !aur_vertex_survives(survival, pairs[LOBE][1], &power)))
            return true;
        ray = aur_surface_ray(&surface, sample.light);
        if (depth == LONGEST_PATH) {
            ++list->counters.cut;
            return true;
        }
    }
    return true;
}

/* --- from the camera */

/* Behind a mirror or a glass boundary: path tracing with separate random numbers. */
static aur_vector mirrored_light(const round_work *work, const aur_camera_sample *sample, aur_ray ray,
                                 uint32_t depth, aur_counters *counters) {
    const ptracer *const self = work->self;
    aur_path path = self->path;
    path.max_depth = self->max_depth == UINT32_MAX ? UINT32_MAX : self->max_depth - depth;
    path.rr_depth = self->rr_depth > depth ? self->rr_depth - depth : 1;
    aur_camera_sample next = {.ray = ray, .stream = sample->stream};
    next.stream.pixel = aur_hash3(sample->stream.pixel, 0x6d6972726f72, depth);
    aur_stream_pairs(&next.stream, 0, AUR_STREAM_BLOCK, next.first_pairs);
    aur_vector unscattered;
    return aur_path_radiance(&path, work->view->scene, &next, NULL, &unscattered, counters);
}

static aur_vector camera_light(const round_work *work, const aur_camera_sample *sample,
                               aur_counters *counters) {
    const aur_scene *const scene = work->view->scene;
    const ptracer *const self = work->self;
    aur_walk walk = {.beta = {1.0f, 1.0f, 1.0f}, .ray = sample->ray, .bounce = {.specular_bounce = true}};
    for (uint32_t depth = 1; depth <= self->max_depth && depth <= MOST_PANES; ++depth) {
        aur_surface surface;
        const bool hide = self->hide_emitters && depth == 1;
        const bool found = aur_visible_surface(scene, hide, &walk.ray, &surface, counters);
        if (found || !hide)
            aur_walk_add_emission(scene, found ? &surface : NULL, &walk);
        if (!found || depth == self->max_depth)
            break;
        const aur_vector direction = walk.ray.direction;
        const aur_shading shading = aur_shading_at(&surface, aur_vector_scale(direction, -1.0f));
        float pairs[2][2];
        if ((aur_bsdf_scatters(surface.bsdf, shading.view.z) & AUR_SCATTERS_SPECULAR) == 0)
            break;
        aur_stream_pairs(&sample->stream, AUR_PAIR_FIRST + 2 * (depth - 1), 2, pairs);
        if (!aur_walk_scatter(&shading, AUR_VERTEX_ALL,
                              (const float[3]){pairs[0][0], pairs[1][0], pairs[1][1]}, &walk) ||
            !walk.bounce.specular_bounce)
            break;
        /* Light paths are connected through surfaces that transmit light unscattered. */
        if (aur_walk_passed(&surface, direction, &walk))
            continue;
        if (self->specular_paths)
            walk.radiance = aur_vector_add(
                walk.radiance,
                aur_vector_multiply(walk.beta, mirrored_light(work, sample, walk.ray, depth, counters)));
        break;
    }
    return walk.radiance;
}

static bool trace_camera(const round_work *work, size_t pixel, splats *list) {
    const size_t x = pixel % work->self->width, y = pixel / work->self->width;
    aur_camera_sample sample;
    aur_view_sample(work->view, x, y, work->index, &sample);
    const aur_vector light = camera_light(work, &sample, &list->counters);
    /* A camera ray is a sample of one pixel, a particle one of all pixels. */
    const float count = (float)(work->self->width * work->self->height);
    return add_splat(list, (float)x + 0.5f + sample.offset[0], (float)y + 0.5f + sample.offset[1],
                     aur_vector_scale(light, count));
}

/* --- a round */

static aur_result trace_chunk(void *context, size_t index) {
    const round_work *const work = context;
    splats *const list = &work->chunks[index];
    const size_t first = work->first + index * PATHS_A_CHUNK;
    const size_t end = first + PATHS_A_CHUNK < work->ends ? first + PATHS_A_CHUNK : work->ends;
    list->count = 0;
    list->counters = (aur_counters){0};
    for (size_t i = first; i < end; ++i)
        if (!trace_camera(work, i, list) || !trace_light(work, i, list))
            return AUR_ERROR_MEMORY;
    return list->counters.stopped ? AUR_ERROR_CANCELLED : AUR_OK;
}

static bool pack_chunk(void *context, size_t index, aur_bytes *bytes) {
    const splats *const list = &((const round_work *)context)->chunks[index];
    aur_bytes_put(bytes, sizeof list->count, &list->count);
    aur_bytes_put(bytes, sizeof list->counters, &list->counters);
    aur_bytes_put(bytes, list->count * sizeof *list->items, list->items);
    return true;
}

static aur_result unpack_chunk(void *context, size_t index, aur_bytes_reader *bytes) {
    splats *const list = &((const round_work *)context)->chunks[index];
    aur_bytes_get(bytes, sizeof list->count, &list->count);
    aur_bytes_get(bytes, sizeof list->counters, &list->counters);
    if (bytes->failed || !aur_array_reserve(&list->items, &list->capacity, list->count, sizeof *list->items))
        return bytes->failed ? AUR_ERROR_INTERNAL : AUR_ERROR_MEMORY;
    aur_bytes_get(bytes, list->count * sizeof *list->items, list->items);
    return bytes->failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

/* What of a filter about the pixels along a side lies in the image, by midpoints. */
static double *make_norms(const aur_filter *filter, size_t side) {
    enum { STEPS = 256 };
    double *const norms = calloc(side, sizeof *norms);
    const size_t reach = aur_spread_reach(filter);
    for (size_t i = 0; norms != NULL && i < side; ++i)
        for (size_t j = i > reach ? i - reach : 0; j <= i + reach && j < side; ++j)
            for (size_t k = 0; k < STEPS; ++k)
                norms[i] +=
                    aur_filter_value(filter, (double)j - (double)i - 0.5 + ((double)k + 0.5) / STEPS) / STEPS;
    return norms;
}

static aur_result begin(ptracer *self, const aur_view *view, const aur_filter *filter, aur_error *error) {
    const size_t bytes = 3 * view->width * view->height * sizeof *self->image;
    self->width = view->width;
    self->height = view->height;
    if (self->image == NULL) {
        self->image = malloc(bytes);
        self->norms[0] = make_norms(filter, self->width);
        self->norms[1] = make_norms(filter, self->height);
    }
    if (self->image == NULL || self->norms[0] == NULL || self->norms[1] == NULL)
        return aur_fail_memory(error);
    memset(self->image, 0, bytes);
    return AUR_OK;
}

/* Adds a splat to all pixels that its filter reaches. */
static void put(ptracer *self, const aur_filter *filter, const splat *at) {
    enum { WIDEST = 2 * AUR_FILTER_REACH_MAX + 2 };
    const float raster[2] = {at->x, at->y};
    const size_t sides[2] = {self->width, self->height};
    const float reach = (float)aur_spread_reach(filter);
    size_t first[2], count[2];
    double weights[2][WIDEST];
    for (size_t d = 0; d < 2; ++d) {
        const float low = floorf(raster[d]) - reach, high = floorf(raster[d]) + reach + 1.0f;
        first[d] = low > 0.0f ? (size_t)low : 0;
        const size_t end = high < (float)sides[d] ? (size_t)high : sides[d];
        count[d] = end - first[d];
        for (size_t i = 0; i < count[d]; ++i)
            weights[d][i] = aur_filter_value(filter, (double)raster[d] - 0.5 - (double)(first[d] + i)) /
                            self->norms[d][first[d] + i];
    }
    const double paths = (double)(self->width * self->height);
    for (size_t j = 0; j < count[1]; ++j)
        for (size_t i = 0; i < count[0]; ++i) {
            double *const pixel = &self->image[3 * ((first[1] + j) * self->width + first[0] + i)];
            for (size_t c = 0; c < 3; ++c)
                pixel[c] += (double)at->value[c] * weights[0][i] * weights[1][j] / paths;
        }
}

static aur_result trace_round(aur_integrator *integrator, const aur_view *view, const aur_filter *filter,
                              uint32_t index, const aur_parallel_options *options, aur_counters *counters,
                              aur_error *error) {
    ptracer *const self = integrator->data;
    const aur_parallel_share share = {.pack = pack_chunk, .unpack = unpack_chunk};
    aur_parallel_options parallel = *options;
    parallel.share = &share;
    splats chunks[CHUNKS] = {{0}};
    round_work work = {
        .integrator = integrator, .view = view, .self = self, .index = index, .chunks = chunks};
    aur_result result = begin(self, view, filter, error);
    const size_t paths = self->width * self->height;
    for (; work.first < paths && result == AUR_OK; work.first += CHUNKS * PATHS_A_CHUNK) {
        const size_t rest = paths - work.first, most = CHUNKS * PATHS_A_CHUNK;
        work.ends = work.first + (rest < most ? rest : most);
        const size_t count = (work.ends - work.first + PATHS_A_CHUNK - 1) / PATHS_A_CHUNK;
        result = aur_parallel_for(&parallel, count, trace_chunk, &work, error);
        for (size_t i = 0; i < count && result == AUR_OK; ++i) {
            aur_counters_add(counters, &chunks[i].counters);
            for (size_t k = 0; k < chunks[i].count; ++k)
                put(self, filter, &chunks[i].items[k]);
        }
    }
    for (size_t i = 0; i < CHUNKS; ++i)
        free(chunks[i].items);
    return result;
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const ptracer *const self = integrator->data;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            if (aur_tile_needs(tile, x, y, tile->first))
                aur_tile_add_mean(tile, x, y, 1, &self->image[3 * (y * self->width + x)]);
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_ptracer = {
    .row = {.name = "ptracer",
            .summary = "light tracing: paths from the lights, for caustics",
            .source = "Dutre, Lafortune, Willems 1993",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(ptracer),
    .create = create,
    .release = release,
    .round = trace_round,
    .tile = tile,
    .cuts = true,
};
