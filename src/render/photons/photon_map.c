#include "render/photons/photon_map.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/bytes.h"
#include "points/base/parallel.h"
#include "render/photons/particles.h"
#include "render/sampling/stream.h"

enum {
    CHUNKS_A_BATCH = 16,
    PATHS_A_BATCH = 16 * 1024,
    PATHS_A_PHOTON_LIMIT = 64 /* give up if this many paths yield less than one photon */
};

typedef struct batch {
    aur_particle_source source;
    uint64_t first_path;
    uint64_t paths_a_chunk;
    aur_photon_list chunks[CHUNKS_A_BATCH];
} batch;

static aur_result trace_chunk(void *context, size_t index) {
    batch *const work = context;
    aur_photon_list *const chunk = &work->chunks[index];
    chunk->count = 0;
    chunk->cut = 0;
    return aur_particles_trace(&work->source, work->first_path + index * work->paths_a_chunk,
                               work->paths_a_chunk, chunk);
}

static bool pack_chunk(void *context, size_t index, aur_bytes *bytes) {
    const batch *const work = context;
    const aur_photon_list *const chunk = &work->chunks[index];
    const uint64_t counted[] = {chunk->count, chunk->cut};
    aur_bytes_put(bytes, sizeof counted, counted);
    aur_bytes_put(bytes, chunk->count * sizeof *chunk->photons, chunk->photons);
    return true;
}

static aur_result unpack_chunk(void *context, size_t index, aur_bytes_reader *bytes) {
    batch *const work = context;
    aur_photon_list *const chunk = &work->chunks[index];
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
        const aur_photon_list *const chunk = &work->chunks[i];
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
            (unsigned long long)cut, (unsigned long long)paths, AUR_LONGEST_PARTICLE);
}

/* Whether there are too few photons for the paths so far. Without any photon, as many paths as photons are
 * enough: light that none of n paths carries is below 3 / n of the power with a confidence of 95 %. */
static bool gives_up(const aur_photon_map *map, size_t photons) {
    const uint64_t paths_a_photon = map->count > 0 ? PATHS_A_PHOTON_LIMIT : 1;
    return map->paths >= photons * paths_a_photon + PATHS_A_BATCH;
}

static aur_result trace_until_enough(aur_photon_map *map, batch *work, aur_error *error) {
    const aur_photon_options *const options = work->source.options;
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
                "photon map: %zu photons stored after %llu particles: the lights have no power or "
                "do not reach the surfaces",
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
    batch work = {.source = {.scene = scene,
                             .elements = elements,
                             .options = options,
                             .sampler = sampler,
                             .paths_a_set = sampler->size > 0 ? sampler->size : (uint64_t)1 << 32},
                  .paths_a_chunk = paths_a_chunk(options->count)};
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
