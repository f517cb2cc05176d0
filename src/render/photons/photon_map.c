#include "render/photons/photon_map.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/bytes.h"
#include "points/base/parallel.h"
#include "render/sampling/stream.h"
#include "render/vertex/vertex.h"

enum {
    CHUNKS_A_BATCH = 16,
    PATHS_A_BATCH = 16 * 1024,
    LONGEST_PATH = 512, /* edges; longer paths, which need scenes without absorption, are cut and counted */
    PATHS_A_PHOTON_LIMIT = 64 /* give up if this many paths yield less than one photon */
};

typedef struct photon_chunk {
    size_t count, capacity;
    aur_photon *photons;
    uint64_t cut;
} photon_chunk;

typedef struct batch {
    const aur_scene *scene;
    const aur_elements *elements;
    const aur_photon_options *options;
    const aur_sampler *sampler;
    uint64_t paths_a_set; /* beyond them the set starts again with another randomisation */
    uint64_t first_path;
    uint64_t paths_a_chunk;
    photon_chunk chunks[CHUNKS_A_BATCH];
} batch;

static bool store(photon_chunk *chunk, aur_photon photon) {
    if (chunk->count == chunk->capacity &&
        !aur_array_reserve(&chunk->photons, &chunk->capacity, chunk->count + 1, sizeof *chunk->photons))
        return false;
    chunk->photons[chunk->count++] = photon;
    return true;
}

/* Cosines of incidence below this are taken as this, which bounds the power of photons. */
static const float LEAST_COSINE = 0.01f;

enum { PAIR_LIGHT = 0, PAIR_POSITION = 1, PAIR_DIRECTION = 2, PAIR_BOUNCE = 3, PAIRS_A_BOUNCE = 2 };

static bool emit(const batch *work, const aur_stream *stream, aur_ray *ray, aur_vector *power, bool *hidden) {
    float light[2], position[2], direction[2];
    aur_stream_pair(stream, PAIR_LIGHT, light);
    aur_stream_pair(stream, PAIR_POSITION, position);
    aur_stream_pair(stream, PAIR_DIRECTION, direction);
    return aur_light_emit(work->scene,
                          (const float[5]){light[0], position[0], position[1], direction[0], direction[1]},
                          ray, power, hidden);
}

/* A photon that arrives from `in`, seen by `parts` of the material; false: no memory. */
static bool arrive(const batch *work, const aur_hit *hit, const aur_surface *surface, aur_vector in,
                   aur_vector power, unsigned parts, photon_chunk *chunk) {
    const float side = aur_vector_dot(surface->geometric_normal, in);
    aur_photon photon = {.position = surface->position,
                         .normal = aur_vector_scale(surface->geometric_normal, side < 0 ? -1.0f : 1.0f),
                         .direction = in,
                         .power = power,
                         .element = aur_element_of(work->elements, hit),
                         .behind = side < 0.0f,
                         .glossy = (parts & AUR_SCATTERS_GLOSSY) != 0};
    aur_element_coordinates(work->scene, hit, surface, photon.coordinates);
    return !aur_vector_is_finite(power) || store(chunk, photon);
}

static bool trace_path(const batch *work, uint64_t path, photon_chunk *chunk) {
    const aur_stream stream = {work->sampler,
                               aur_hash3(work->options->seed, 0x70686f746f6e, path / work->paths_a_set),
                               (uint32_t)(path % work->paths_a_set)};
    aur_ray ray;
    aur_vector power;
    bool hidden;
    if (!emit(work, &stream, &ray, &power, &hidden))
        return true;
    const bool unlimited = work->options->max_edges > LONGEST_PATH;
    const size_t limit = unlimited ? LONGEST_PATH : work->options->max_edges;
    const aur_photon_kind kind = work->options->kind;
    const bool is_whole = kind == AUR_PHOTONS_ALL || kind == AUR_PHOTONS_FOUND;
    bool specular_so_far = true;
    for (size_t edge = 1; edge <= limit && (specular_so_far || kind != AUR_PHOTONS_CAUSTIC); ++edge) {
        aur_hit hit;
        if (!aur_scene_intersect(work->scene, &ray, &hit))
            return true;
        aur_surface surface;
        aur_scene_surface(work->scene, &ray, &hit, &surface);
        const aur_vector in = aur_vector_scale(ray.direction, -1.0f);
        const aur_shading shading = aur_shading_at(&surface, in);
        /* Gather rays continue by the other lobes, and need no photons. */
        const unsigned parts = aur_bsdf_scatters(surface.bsdf, shading.view.z) &
                               (unsigned)(AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY);
        const bool is_caustic = specular_so_far && edge > 1;
        if (parts != 0 && (is_whole || is_caustic == (kind == AUR_PHOTONS_CAUSTIC)) &&
            !arrive(work, &hit, &surface, in, power, parts, chunk))
            return false;
        const uint32_t pair = PAIR_BOUNCE + PAIRS_A_BOUNCE * (uint32_t)(edge - 1);
        float lobe[2], towards[2];
        aur_stream_pair(&stream, pair, lobe);
        aur_stream_pair(&stream, pair + 1, towards);
        aur_bsdf_sample sample;
        if (!aur_shading_sample(&shading, (const float[3]){lobe[0], towards[0], towards[1]}, &sample))
            return true;
        specular_so_far = specular_so_far && sample.specular;
        /* Panes do not change the direction: shadow rays pass them. */
        const bool bent = !aur_is_unbent(ray.direction, sample.light);
        if (kind == AUR_PHOTONS_FOUND && hidden && specular_so_far && bent)
            return true;
        const aur_vector weight = aur_vertex_adjoint(&shading, &sample, in, surface.frame.z, LEAST_COSINE);
        const aur_vector before = power;
        power = aur_vector_multiply(before, weight);
        if (!aur_vertex_survives(aur_particle_survival(before, power), lobe[1], &power))
            return true;
        ray = aur_surface_ray(&surface, sample.light);
        if (unlimited && edge == limit)
            ++chunk->cut;
    }
    return true;
}

static aur_result trace_chunk(void *context, size_t index) {
    batch *const work = context;
    photon_chunk *const chunk = &work->chunks[index];
    chunk->count = 0;
    chunk->cut = 0;
    for (uint64_t i = 0; i < work->paths_a_chunk; ++i)
        if (!trace_path(work, work->first_path + index * work->paths_a_chunk + i, chunk))
            return AUR_ERROR_MEMORY;
    return AUR_OK;
}

static bool pack_chunk(void *context, size_t index, aur_bytes *bytes) {
    const batch *const work = context;
    const photon_chunk *const chunk = &work->chunks[index];
    const uint64_t counted[] = {chunk->count, chunk->cut};
    aur_bytes_put(bytes, sizeof counted, counted);
    aur_bytes_put(bytes, chunk->count * sizeof *chunk->photons, chunk->photons);
    return true;
}

static aur_result unpack_chunk(void *context, size_t index, aur_bytes_reader *bytes) {
    batch *const work = context;
    photon_chunk *const chunk = &work->chunks[index];
    uint64_t counted[2];
    aur_bytes_get(bytes, sizeof counted, counted);
    chunk->count = (size_t)counted[0];
    chunk->cut = counted[1];
    if (!aur_array_reserve(&chunk->photons, &chunk->capacity, chunk->count, sizeof *chunk->photons))
        return AUR_ERROR_MEMORY;
    aur_bytes_get(bytes, chunk->count * sizeof *chunk->photons, chunk->photons);
    return bytes->failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

static aur_result append_batch(aur_photon_map *map, const batch *work, size_t *capacity) {
    size_t added = 0;
    for (size_t i = 0; i < CHUNKS_A_BATCH; ++i)
        added += work->chunks[i].count;
    if (!aur_array_reserve(&map->photons, capacity, map->count + added, sizeof *map->photons))
        return AUR_ERROR_MEMORY;
    for (size_t i = 0; i < CHUNKS_A_BATCH; ++i) {
        const photon_chunk *const chunk = &work->chunks[i];
        if (chunk->count > 0)
            memcpy(map->photons + map->count, chunk->photons, chunk->count * sizeof *chunk->photons);
        map->count += chunk->count;
        map->cut += chunk->cut;
    }
    return AUR_OK;
}

/* Paths between two checks of the number of photons: few for a small map, and a power of two, as suits nets.
 */
static uint64_t paths_a_chunk(size_t photons) {
    uint64_t paths = PATHS_A_BATCH / CHUNKS_A_BATCH;
    while (paths > 16 && paths * CHUNKS_A_BATCH > photons / 2)
        paths /= 2;
    return paths;
}

void aur_photon_map_warn(uint64_t cut, uint64_t paths, const aur_warnings *warnings) {
    if (cut > 0)
        aur_warn_at(
            warnings, (aur_location){0},
            "photon map: %llu of %llu particles were cut after %d edges: surfaces absorb (nearly) nothing, "
            "and the further light of those particles is missing",
            (unsigned long long)cut, (unsigned long long)paths, LONGEST_PATH);
}

/* Whether there are too few photons for the paths so far. Without any photon, as many paths as photons are
 * enough: light that none of n paths carries is below 3 / n of the power with a confidence of 95 %. */
static bool gives_up(const aur_photon_map *map, size_t photons) {
    const uint64_t paths_a_photon = map->count > 0 ? PATHS_A_PHOTON_LIMIT : 1;
    return map->paths >= photons * paths_a_photon + PATHS_A_BATCH;
}

static aur_result trace_until_enough(aur_photon_map *map, batch *work, aur_error *error) {
    const aur_photon_options *const options = work->options;
    const aur_parallel_share share = {.pack = pack_chunk, .unpack = unpack_chunk};
    const aur_parallel_options parallel = {
        .threads = options->threads, .what = "photon map", .flush_denormals = true, .share = &share};
    const uint64_t before = aur_rays_traced;
    size_t capacity = 0;
    while (map->count < options->count) {
        const bool may_be_none = options->kind == AUR_PHOTONS_CAUSTIC || options->kind == AUR_PHOTONS_FOUND;
        const bool ends = gives_up(map, options->count);
        if (ends && may_be_none)
            break;
        if (ends)
            return aur_fail(
                error, AUR_ERROR_UNSUPPORTED,
                "photon map: %zu photons stored after %llu particles: the lights do not reach the surfaces",
                map->count, (unsigned long long)map->paths);
        work->first_path = map->paths;
        aur_result result = aur_parallel_for(&parallel, CHUNKS_A_BATCH, trace_chunk, work, error);
        if (result != AUR_OK)
            return result;
        if (append_batch(map, work, &capacity) != AUR_OK)
            return aur_fail_memory(error);
        map->paths += work->paths_a_chunk * CHUNKS_A_BATCH;
        const uint64_t done = map->count < options->count ? map->count : options->count;
        if (aur_progress_stops(&options->progress, "photons", done, options->count))
            return aur_fail(error, AUR_ERROR_CANCELLED, "cancelled");
    }
    map->rays = aur_rays_traced - before;
    aur_photon_map_warn(map->cut, map->paths, &options->warnings);
    for (size_t i = 0; i < map->count; ++i)
        map->photons[i].power = aur_vector_scale(map->photons[i].power, 1.0f / (float)map->paths);
    return AUR_OK;
}

/* Room for growth by halves, and for the texels' lists. */
static aur_result check_memory(const aur_photon_options *options, aur_error *error) {
    const double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const double needed = 2.0 * (double)options->count * sizeof(aur_photon), memory = aur_machine_memory();
    if (needed <= memory)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY,
                    "photon map: %zu photons take up to %.1f GiB; this machine has %.1f, enough for %.0f",
                    options->count, needed / gibibyte, memory / gibibyte,
                    floor(memory / (2.0 * sizeof(aur_photon))));
}

aur_result aur_photon_map_create(const aur_scene *scene, const aur_elements *elements,
                                 const aur_photon_options *options, aur_photon_map *map, aur_error *error) {
    *map = (aur_photon_map){0};
    if (aur_scene_emitter_count(scene) == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "photon map: the scene has no light");
    aur_sampler *default_sampler = NULL;
    aur_result result = check_memory(options, error);
    if (result == AUR_OK && options->sampler == NULL)
        result = aur_sampler_create("sobol", 1, NULL, &default_sampler, error);
    if (result != AUR_OK)
        return result;
    const aur_sampler *const sampler = default_sampler != NULL ? default_sampler : options->sampler;
    batch work = {.scene = scene,
                  .elements = elements,
                  .options = options,
                  .sampler = sampler,
                  .paths_a_chunk = paths_a_chunk(options->count),
                  .paths_a_set = sampler->size > 0 ? sampler->size : (uint64_t)1 << 32};
    result = trace_until_enough(map, &work, error);
    for (size_t i = 0; i < CHUNKS_A_BATCH; ++i)
        free(work.chunks[i].photons);
    aur_sampler_destroy(default_sampler);
    if (result != AUR_OK)
        aur_photon_map_release(map);
    return result;
}

void aur_photon_map_release(aur_photon_map *map) {
    free(map->photons);
    *map = (aur_photon_map){0};
}
