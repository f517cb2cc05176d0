#include "lighting/irradiance/sensor_trace.h"

#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/names.h"
#include "points/base/random.h"
#include "render/vertex/shading.h"

/* The fraction of paths that continue after the cached light was added (see render/gather/continuation.h).
 * Paths with a last segment shorter than so many widths of the texel or triangle that it meets all continue:
 * the cache does not resolve the light's variation there. */
static const float SHARE = 0.25f, REACH = 2.0f;

enum { PHOTONS_A_TEXEL = 16, BOUNCES = 12 };

/* --- cached light */

static aur_result find_map(const aur_scene *scene, const aur_irradiance_options *o, aur_cached_light *cache,
                           aur_error *error) {
    const aur_irradiance_map_options options = {
        .photons = {.count = o->particles,
                    /* One edge more, for the segment to the sensor. */
                    .max_edges = o->max_depth > 0 ? o->max_depth - 1 : SIZE_MAX,
                    .seed = o->seed,
                    .threads = o->threads,
                    .progress = o->progress,
                    .warnings = o->warnings},
        .photons_a_texel = PHOTONS_A_TEXEL};
    return aur_irradiance_map_create(scene, &options, &cache->map, error);
}

static aur_result solve(const aur_scene *scene, const aur_irradiance_options *o, aur_cached_light *cache,
                        aur_error *error) {
    aur_radiosity_options options = {.size = sizeof options};
    aur_radiosity_options_init(&options, NULL);
    options.seed = o->seed;
    options.bounces = BOUNCES;
    options.threads = o->threads;
    options.progress = o->progress;
    options.warnings = o->warnings;
    aur_result result = aur_radiosity_create(scene, &options, &cache->solution, error);
    if (result == AUR_OK)
        result = aur_radiosity_trace(cache->solution, o->particles, error);
    if (result != AUR_OK)
        return result;
    const size_t count = cache->solution->scene.patch_count;
    cache->exitances = malloc(count * sizeof *cache->exitances);
    if (cache->exitances == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i)
        cache->exitances[i] = aur_radiosity_exitance(cache->solution, i);
    return AUR_OK;
}

aur_result aur_cached_light_create(const aur_scene *scene, const aur_irradiance_options *options,
                                   aur_cached_light *cache, aur_error *error) {
    *cache = (aur_cached_light){0};
    if (options->reflected == AUR_REFLECTED_BY_PATHS || options->max_depth == 1) /* nothing is reflected */
        return AUR_OK;
    return options->reflected == AUR_REFLECTED_BY_MAP ? find_map(scene, options, cache, error)
                                                      : solve(scene, options, cache, error);
}

void aur_cached_light_release(aur_cached_light *cache) {
    aur_irradiance_map_destroy(cache->map);
    aur_radiosity_destroy(cache->solution);
    free(cache->exitances);
    *cache = (aur_cached_light){0};
}

/* --- where a path may use the cache */

/* Plain triangles, by index within the group. */
static aur_texel_view plain_light(const aur_cached_light *cache, const aur_path_group *g, size_t lane) {
    const struct RTCHit16 *const hits = &g->packet.query.hit;
    const bool behind = g->lanes.side[lane] < 0.0f;
    const aur_vector albedo = aur_lane_vector(&g->lanes.albedo[behind ? 1 : 0], lane);
    if (aur_vector_is_zero(albedo))
        return (aur_texel_view){0};
    if (cache->map != NULL) {
        const uint32_t element =
            cache->map->texels.elements.shape_first[hits->geomID[lane]] + hits->primID[lane];
        const aur_texel_light *const light =
            aur_irradiance_on_triangle(cache->map, element, hits->u[lane], hits->v[lane], behind);
        return (aur_texel_view){
            aur_vector_scale(aur_vector_multiply(albedo, light->irradiance), 1.0f / AUR_PI_F), light->area};
    }
    const aur_radiosity_scene *const scene = &cache->solution->scene;
    const uint32_t triangle = scene->first[hits->geomID[lane]] + hits->primID[lane];
    const uint32_t patch = behind ? scene->triangles[triangle].back : triangle;
    if (patch == AUR_NO_PATCH)
        return (aur_texel_view){0};
    return (aur_texel_view){aur_vector_multiply(albedo, cache->exitances[patch]),
                            (float)scene->areas[triangle]};
}

/* Other surfaces whose lobes are all in the cache. */
static aur_texel_view other_light(const aur_cached_light *cache, const aur_path_group *g, size_t lane) {
    const aur_surface *const surface = &g->surfaces[lane];
    const aur_ray ray = aur_packet_ray(&g->packet, lane);
    const aur_hit hit = aur_packet_hit(g->scene, &g->packet, lane);
    const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
    const aur_shading shading = aur_shading_at(surface, view);
    const unsigned kinds = aur_bsdf_scatters(surface->bsdf, shading.view.z);
    if (kinds == 0 || (kinds & (AUR_SCATTERS_SPECULAR | AUR_SCATTERS_SAMPLED)) != 0)
        return (aur_texel_view){0};
    if (cache->map != NULL)
        return aur_irradiance_view(cache->map, g->scene, &hit, surface, view);
    const aur_radiosity_scene *const scene = &cache->solution->scene;
    const uint32_t triangle = aur_radiosity_triangle_at(scene, &hit);
    const bool front = aur_vector_dot(ray.direction, scene->triangles[triangle].frame.z) < 0.0f;
    const uint32_t patch = front ? triangle : scene->triangles[triangle].back;
    if (patch == AUR_NO_PATCH)
        return (aur_texel_view){0};
    const aur_vector albedo = aur_radiosity_albedo(scene, triangle, front, &ray, &hit);
    return (aur_texel_view){aur_vector_multiply(albedo, cache->exitances[patch]),
                            (float)scene->areas[triangle]};
}

void aur_cached_light_add(const aur_cached_light *cache, aur_path_group *g, uint32_t depth,
                          uint32_t *pending) {
    for (uint32_t rest = g->alive & *pending; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const bool plain = aur_has_lane(g->plain, k);
        const aur_texel_view found = plain ? plain_light(cache, g, k) : other_light(cache, g, k);
        const float distance = g->packet.query.ray.tfar[k];
        if (!(distance * distance >= REACH * REACH * found.area) || found.area == 0.0f)
            continue;
        *pending &= ~(1u << k);
        aur_vector throughput = aur_lane_vector(&g->lanes.throughput, k);
        const aur_vector light = aur_vector_multiply(throughput, found.radiance);
        const uint64_t hash = aur_hash4(g->pixels[k], UINT64_C(0x6b6e6f776e), g->index, depth);
        const bool goes_on = aur_vertex_survives(SHARE, aur_unit_float((uint32_t)(hash >> 32)), &throughput);
        aur_lane_set(&g->lanes.sum, k,
                     aur_vector_add_scaled(aur_lane_vector(&g->lanes.sum, k),
                                           goes_on ? 1.0f - 1.0f / SHARE : 1.0f, light));
        if (goes_on)
            aur_lane_set(&g->lanes.throughput, k, throughput);
        else
            g->alive &= ~(1u << k);
    }
    g->plain &= g->alive;
}

static const char *const reflected_names[] = {"paths", "map", "radiosity"};
enum { REFLECTED_NAMES = sizeof reflected_names / sizeof reflected_names[0] };

aur_result aur_reflected_from_name(const char *name, aur_reflected *reflected, aur_error *error) {
    size_t index;
    const aur_result result =
        aur_names_choose(aur_names_of(REFLECTED_NAMES, reflected_names), "way to find reflected light", name,
                         (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *reflected = (aur_reflected)index;
    return result;
}

const char *aur_reflected_name(aur_reflected reflected) {
    return (size_t)reflected < REFLECTED_NAMES ? reflected_names[reflected] : NULL;
}
