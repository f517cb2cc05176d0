#include "render/gather/plan.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/random.h"
#include "points/base/simd.h"
#include "render/photons/irradiance.h"

/* --- light */

static void destroy_map(void *map) {
    aur_irradiance_map_destroy(map);
}

/* A hash of the whole state of a sampler, including points that come from a file. */
static uint64_t digest(const aur_sampler *sampler) {
    uint64_t hash = aur_hash2(sampler->kind, sampler->size);
    for (size_t i = 0; i < sampler->size; ++i)
        hash = aur_hash2(hash, (uint64_t)sampler->points[i][0] << 32 | sampler->points[i][1]);
    return hash;
}

static void destroy_text(void *text) {
    free(text);
}

/* The cache key of photon maps: the contents of the scene's files, this program, and how Embree intersects.
 * NULL if that cannot be determined. */
static const char *scene_key(const aur_integrator_context *context) {
    static const char name[] = "what photon maps depend on";
    char *const cached = aur_cache_find(context->cache, name);
    const uint64_t build = aur_build_identity();
    char *contents = NULL, *key = NULL;
    size_t size;
    if (cached != NULL || build == 0 || aur_scene_contents(context->scene, &contents, NULL) != AUR_OK)
        return cached;
    FILE *const stream = open_memstream(&key, &size);
    if (stream != NULL) {
        fprintf(stream, "build %016" PRIx64 "\ninstructions %s, of rays %s\n%s", build,
                aur_isa_name(aur_isa_available()), aur_isa_name(aur_isa_of_rays()), contents);
        fclose(stream);
    }
    free(contents);
    return key != NULL && aur_cache_store(context->cache, name, key, 0, destroy_text) == AUR_OK ? key : NULL;
}

/* Loads the map from the file cache, or traces it and writes it there. */
static aur_result find_or_trace(const aur_integrator_context *context,
                                const aur_irradiance_map_options *options, const char *key,
                                aur_irradiance_map **map, aur_error *error) {
    const char *const scene = context->use_cache && options->photons.count >= AUR_IRRADIANCE_WORTH_KEEPING
                                  ? scene_key(context)
                                  : NULL;
    char *whole = NULL;
    size_t size = 0;
    *map = NULL;
    if (scene != NULL && (whole = malloc(strlen(key) + strlen(scene) + 2)) != NULL) {
        sprintf(whole, "%s\n%s", key, scene);
        char *const stored = aur_cache_file_read("photons", whole, &size);
        if (stored != NULL)
            *map = aur_irradiance_map_unpack(context->scene, size, stored);
        free(stored);
    }
    aur_result result = AUR_OK;
    if (*map != NULL) {
        aur_photon_map_warn((*map)->cut, (*map)->paths, &context->warnings);
    } else {
        result = aur_irradiance_map_create(context->scene, options, map, error);
        void *const bytes = result == AUR_OK && whole != NULL ? aur_irradiance_map_pack(*map, &size) : NULL;
        if (bytes != NULL)
            aur_cache_file_write("photons", whole, size, bytes);
        free(bytes);
    }
    free(whole);
    return result;
}

/* A photon map, shared by all renders with the same options. */
static aur_result find_map(const aur_gather_settings *p, const aur_integrator_context *context,
                           aur_photon_options photons, const aur_irradiance_map **found, aur_error *error) {
    aur_sampler *sampler;
    aur_result result = aur_sampler_create(p->photon_pattern, photons.count, NULL, &sampler, error);
    if (result != AUR_OK)
        return result;
    char key[256]; /* six numbers and their names */
    snprintf(key, sizeof key,
             "irradiance kind=%d photons=%zu texel=%.17g edges=%zu seed=%" PRIu64 " numbers=%" PRIu64,
             (int)photons.kind, photons.count, p->photons_per_texel, photons.max_edges, photons.seed,
             digest(sampler));
    *found = aur_cache_find(context->cache, key);
    if (*found == NULL) {
        photons.sampler = sampler;
        aur_irradiance_map *created;
        result = find_or_trace(context, &(aur_irradiance_map_options){photons, p->photons_per_texel}, key,
                               &created, error);
        if (result == AUR_OK &&
            aur_cache_store(context->cache, key, created, created->rays, destroy_map) != AUR_OK)
            result = aur_fail_memory(error);
        *found = result == AUR_OK ? created : NULL;
    }
    aur_sampler_destroy(sampler);
    return result;
}

static aur_result find_maps(const aur_gather_settings *p, const aur_integrator_context *context,
                            aur_gather_light *light, aur_error *error) {
    const bool apart = p->caustic_photons > 0;
    const bool leaves_out = p->debias == AUR_DEBIAS_FOUND && aur_scene_has_hidden_light(context->scene);
    const uint64_t fixed_seed = aur_hash2(UINT64_C(0x70686f746f6e73), p->photon_seed);
    aur_photon_options photons = {.count = p->photons,
                                  /* A diffuse surface at the end of a gather ray is two edges from the
                                     camera; caustics are seen without a gather ray. */
                                  .max_edges = p->max_depth == UINT32_MAX ? SIZE_MAX : p->max_depth - 2,
                                  .kind = apart        ? AUR_PHOTONS_OTHER
                                          : leaves_out ? AUR_PHOTONS_FOUND
                                                       : AUR_PHOTONS_ALL,
                                  .seed = p->photon_seed > 0 ? fixed_seed : context->seed,
                                  .threads = context->threads,
                                  .progress = context->progress,
                                  .warnings = context->warnings};
    aur_result result = find_map(p, context, photons, &light->map, error);
    if (result != AUR_OK || !apart)
        return result;
    photons.count = p->caustic_photons;
    photons.kind = AUR_PHOTONS_CAUSTIC;
    result = find_map(p, context, photons, &light->caustics, error);
    if (result == AUR_OK && light->caustics->photons < photons.count)
        aur_warn_at(&context->warnings, (aur_location){0},
                    "finalgather: %zu caustic photons of %zu found: little light comes by specular bounces",
                    light->caustics->photons, photons.count);
    return result;
}

static void destroy_bright(void *bright) {
    aur_bright_texels_release(bright);
    free(bright);
}

/* A map's bright texels, shared like the map: the cache key is the map's address. */
static aur_result find_bright(const aur_integrator_context *context, const aur_irradiance_map *map,
                              const aur_shape_class *classes, const aur_bright_texels **found,
                              aur_error *error) {
    char key[64]; /* an address and a name */
    snprintf(key, sizeof key, "bright texels of %p", (const void *)map);
    *found = aur_cache_find(context->cache, key);
    if (*found != NULL)
        return AUR_OK;
    aur_bright_texels *const created = malloc(sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    aur_result result = aur_bright_texels_create(context->scene, map, classes, created, error);
    if (result != AUR_OK)
        free(created);
    else if (aur_cache_store(context->cache, key, created, 0, destroy_bright) != AUR_OK)
        result = aur_fail_memory(error);
    *found = result == AUR_OK ? created : NULL;
    return result;
}

static aur_result find_light(const aur_gather_settings *p, const aur_integrator_context *context,
                             aur_gather_plan *plan, aur_error *error) {
    aur_gather_light *const light = &plan->light;
    light->draws = p->light_samples;
    /* If gather rays continue from every surface, no photons are needed. */
    const bool needs_photons = p->incident != AUR_INCIDENT_EMITTERS && p->max_depth >= 3 &&
                               (plan->rules.scatters & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0;
    aur_result result = needs_photons ? find_maps(p, context, light, error) : AUR_OK;
    if (result != AUR_OK || p->bright_samples == 0 || light->map == NULL || p->component != AUR_COMPONENT_ALL)
        return result;
    const size_t samples = context->samples_per_pixel;
    result = find_bright(context, light->map, plan->classes, &light->bright, error);
    if (result == AUR_OK && light->bright->distribution.total > 0.0)
        light->bright_draws = (uint32_t)(aur_gather_split_count(p->bright_samples, samples) / samples);
    return result;
}

/* --- the plan */

static aur_result compile(aur_gather_plan *plan, const aur_gather_settings *p,
                          const aur_gather_method *method, const aur_integrator_context *context,
                          aur_error *error) {
    const aur_gather_settings *const policy = &plan->policy;
    aur_result result = aur_gather_rules_create(p, method, context, &plan->rules, error);
    if (result == AUR_OK)
        result = aur_shape_classes_create(context->scene, &plan->classes, error);
    if (result == AUR_OK)
        result = find_light(p, context, plan, error);
    plan->counts_emitters = policy->direct == AUR_DIRECT_GATHER ||
                            (p->incident == AUR_INCIDENT_EMITTERS && policy->direct == AUR_DIRECT_NONE);
    plan->continuation =
        (aur_continuation){.scene = context->scene,
                           .map = plan->light.map,
                           .caustics = plan->light.caustics,
                           .max_depth = policy->max_depth,
                           .share = p->debias != AUR_DEBIAS_NONE ? (float)p->continued : 0.0f,
                           .reach = (float)p->short_rays,
                           .single = p->debias == AUR_DEBIAS_ONLY || p->debias == AUR_DEBIAS_FOUND,
                           .packets = policy->packets};
    plan->gathers = plan->light.map != NULL ||
                    (policy->max_depth >= 2 && (plan->counts_emitters || policy->direct == AUR_DIRECT_NEE));
    return result;
}

aur_result aur_gather_plan_create(const aur_gather_settings *p, const aur_gather_method *method,
                                  const aur_integrator_context *context, aur_gather_plan **plan,
                                  aur_error *error) {
    *plan = calloc(1, sizeof **plan);
    if (*plan == NULL)
        return aur_fail_memory(error);
    aur_integrator_context local = *context;
    if (p->split > 0)
        local.samples_per_pixel = p->split;
    (*plan)->scene = context->scene;
    (*plan)->policy = *p;
    (*plan)->samples_per_pattern = local.samples_per_pixel;
    (*plan)->part_stride = aur_gather_part_stride(local.samples_per_pixel);
    (*plan)->renews = p->split > 0;
    (*plan)->seed = aur_hash2(context->seed, p->pattern_seed);
    const aur_result result = compile(*plan, p, method, &local, error);
    if (result != AUR_OK) {
        aur_gather_plan_destroy(*plan);
        *plan = NULL;
    }
    return result;
}

void aur_gather_plan_destroy(aur_gather_plan *plan) {
    if (plan == NULL)
        return;
    aur_gather_rules_release(&plan->rules);
    free(plan->classes);
    free(plan);
}
