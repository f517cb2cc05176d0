#include "transport/gather/light.h"

#include <inttypes.h>
#include <stdio.h>

#include "core/error.h"
#include "core/random.h"
#include "transport/gather/rules.h"

static void destroy_map(void *map) {
    aur_irradiance_map_destroy(map);
}

/* Stands for all that a sampler has, also for points that come from a file. */
static uint64_t digest(const aur_sampler *sampler) {
    uint64_t hash = aur_hash2(sampler->kind, sampler->size);
    for (size_t i = 0; i < sampler->size; ++i)
        hash = aur_hash2(hash, (uint64_t)sampler->points[i][0] << 32 | sampler->points[i][1]);
    return hash;
}

/* Makes a map and gives it to the cache under `key`. */
static aur_result make_map(const aur_gather_parameters *p, const aur_integrator_context *context,
                           const aur_photon_options *photons, const char *key,
                           const aur_irradiance_map **made, aur_error *error) {
    const aur_irradiance_options options = {.photons = *photons, .photons_a_texel = p->photons_a_texel};
    aur_irradiance_map *map;
    const aur_result result = aur_irradiance_map_create(context->scene, &options, &map, error);
    if (result != AUR_OK)
        return result;
    if (aur_cache_store(context->cache, key, map, destroy_map) != AUR_OK)
        return aur_fail_memory(error);
    *made = map;
    return AUR_OK;
}

/* A photon map, shared by all renders that ask for the same one. */
static aur_result find_map(const aur_gather_parameters *p, const aur_integrator_context *context,
                           aur_photon_options photons, const aur_irradiance_map **found, aur_error *error) {
    aur_sampler *sampler;
    aur_result result = aur_sampler_create(p->photon_set, photons.count, NULL, &sampler, error);
    if (result != AUR_OK)
        return result;
    photons.sampler = sampler;
    char key[256]; /* six numbers and their names */
    snprintf(key, sizeof key,
             "irradiance kind=%d photons=%zu texel=%.17g edges=%zu seed=%" PRIu64 " numbers=%" PRIu64,
             (int)photons.kind, photons.count, p->photons_a_texel, photons.max_edges, photons.seed,
             digest(sampler));
    *found = aur_cache_find(context->cache, key);
    if (*found == NULL)
        result = make_map(p, context, &photons, key, found, error);
    aur_sampler_destroy(sampler);
    return result;
}

static aur_result find_maps(const aur_gather_parameters *p, const aur_integrator_context *context,
                            aur_gather_light *light, aur_error *error) {
    const bool apart = p->caustic_photons > 0;
    aur_photon_options photons = {.count = (size_t)p->photons,
                                  /* What the eye sees at one gather ray's end is two edges on; caustics are
                                   * seen without a gather ray. */
                                  .max_edges = p->max_depth < 0 ? SIZE_MAX : (size_t)p->max_depth - 2,
                                  .kind = apart ? AUR_PHOTONS_OTHER : AUR_PHOTONS_ALL,
                                  .seed = context->seed,
                                  .threads = context->threads,
                                  .progress = context->progress,
                                  .warnings = context->warnings};
    aur_result result = find_map(p, context, photons, &light->map, error);
    if (result != AUR_OK || !apart)
        return result;
    photons.count = (size_t)p->caustic_photons;
    photons.kind = AUR_PHOTONS_CAUSTIC;
    result = find_map(p, context, photons, &light->caustics, error);
    if (result == AUR_OK && light->caustics->photons < photons.count)
        aur_warn_at(&context->warnings, (aur_location){0},
                    "finalgather: %zu caustic photons of %zu found: little light comes by specular bounces",
                    light->caustics->photons, photons.count);
    return result;
}

aur_result aur_gather_light_create(const aur_gather_parameters *p, const aur_integrator_context *context,
                                   const aur_shape_class *classes, bool wants_photons,
                                   aur_gather_light *light, aur_error *error) {
    *light = (aur_gather_light){.draws = (uint32_t)p->light_samples};
    aur_result result = wants_photons ? find_maps(p, context, light, error) : AUR_OK;
    if (result != AUR_OK || p->bright_samples == 0 || light->map == NULL || p->component != AUR_COMPONENT_ALL)
        return result;
    const size_t samples = context->samples_per_pixel;
    result = aur_bright_texels_create(context->scene, light->map, classes, &light->bright, error);
    if (result == AUR_OK && light->bright.distribution.total > 0.0)
        light->bright_draws = (uint32_t)(aur_gather_split_count(p->bright_samples, samples) / samples);
    return result;
}

void aur_gather_light_release(aur_gather_light *light) {
    aur_bright_texels_release(&light->bright);
}
