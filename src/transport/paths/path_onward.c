#include "transport/paths/path_onward.h"

#include "core/random.h"
#include "transport/lights/direct_light.h"
#include "transport/paths/path.h"

typedef struct onward_walk {
    aur_vector sum, throughput;
    aur_ray ray;
    uint64_t hash;
    aur_vector from; /* the surface that the ray left, and the density of its direction there */
    float pdf;
    bool specular; /* no light sample could have found what the ray meets */
    bool known;    /* the map has answered for the rest of the path, which had this sum then */
    aur_vector known_sum;
} onward_walk;

/* BSDF * |cos| and the density of the whole BSDF's draws. `known_only`: of the lobes that a photon map
 * answers for, which are all but the specular and the sampled ones. */
static aur_vector evaluate(const aur_shading *shading, bool known_only, aur_vector light, float *pdf) {
    const aur_vector value = aur_shading_evaluate(shading, light, pdf);
    const aur_surface *const surface = shading->surface;
    if (!known_only || *pdf == 0.0f ||
        (aur_bsdf_scatters(surface->bsdf, shading->view.z) & AUR_SCATTERS_SAMPLED) == 0)
        return value;
    float unused;
    const aur_vector sampled =
        aur_bsdf_evaluate(surface->bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view,
                          aur_frame_to_local(&surface->frame, light), &unused);
    return aur_vector_subtract(value, sampled);
}

/* A point on a light. */
static void add_direct_light(const aur_onward *onward, const aur_shading *shading, bool known_only,
                             onward_walk *walk, aur_counters *counters) {
    float u[3], pdf, distance;
    aur_light_sample light;
    aur_draw_units(&walk->hash, u);
    if (aur_scene_emitter_count(onward->scene) == 0 ||
        !aur_shading_draw_light(onward->scene, shading, AUR_LEAST_LIGHT_OF_PATHS, u, &light) ||
        !(light.pdf > 0.0f))
        return;
    const aur_vector value = evaluate(shading, known_only, light.direction, &pdf);
    if (aur_vector_is_zero(value))
        return;
    const aur_ray shadow = aur_surface_ray_to(shading->surface, light.position, &distance);
    ++counters->rays;
    if (aur_scene_occluded(onward->scene, &shadow))
        return;
    const float weight = (light.delta ? 1.0f : aur_power_heuristic(light.pdf, pdf)) / light.pdf;
    const aur_vector radiance = aur_vector_multiply(value, light.radiance);
    walk->sum = aur_vector_add_scaled(walk->sum, weight, aur_vector_multiply(walk->throughput, radiance));
}

/* A direction by the BSDF; false where the path ends. */
static bool scatter(const aur_shading *shading, bool known_only, onward_walk *walk) {
    float u[3];
    aur_bsdf_sample drawn;
    aur_draw_units(&walk->hash, u);
    if (!aur_shading_sample(shading, u, &drawn) || (known_only && drawn.specular))
        return false;
    if (known_only) {
        float pdf;
        drawn.weight = aur_vector_scale(evaluate(shading, true, drawn.light, &pdf), 1.0f / drawn.pdf);
    }
    walk->throughput = aur_vector_multiply(walk->throughput, drawn.weight);
    walk->from = shading->surface->position;
    walk->pdf = drawn.pdf;
    walk->specular = drawn.specular;
    walk->ray = aur_surface_ray(shading->surface, drawn.light);
    return !aur_vector_is_zero(walk->throughput);
}

/* The light that the ray meets: an emitter's, or the sky where there is no surface. */
static void add_emission(const aur_onward *onward, const aur_surface *surface, onward_walk *walk) {
    const aur_scene *const scene = onward->scene;
    const aur_vector direction = walk->ray.direction;
    if (walk->specular && onward->caustics != NULL)
        return;
    float rival = 0.0f;
    const aur_vector emission = surface != NULL
                                    ? aur_surface_emission(scene, surface, aur_vector_scale(direction, -1.0f))
                                    : aur_environment_light(scene, direction, &rival);
    if (aur_vector_is_zero(emission))
        return;
    float weight = 1.0f;
    if (!walk->specular) {
        if (surface != NULL)
            rival = aur_light_pdf_direct(scene, walk->from, AUR_LEAST_LIGHT_OF_PATHS, surface);
        weight = aur_power_heuristic(walk->pdf, rival);
    }
    walk->sum = aur_vector_add_scaled(walk->sum, weight, aur_vector_multiply(walk->throughput, emission));
}

/* Roulette. Where the map answers for all that the surface scatters, what a path that ends would still have
 * brought is taken from it, and from one that goes on it is taken away again. */
static bool survives(const aur_onward *onward, const aur_hit *hit, const aur_shading *shading,
                     aur_vector view, onward_walk *walk) {
    const float go_on = onward->share > 0.0f ? 0.5f : 0.0f;
    const unsigned kinds = aur_bsdf_scatters(shading->surface->bsdf, shading->view.z);
    aur_texel_view texel = {0};
    bool known = (kinds & (AUR_SCATTERS_SPECULAR | AUR_SCATTERS_SAMPLED)) == 0;
    if (known) {
        texel = aur_irradiance_view(onward->map, onward->scene, hit, shading->surface, view);
        known = !aur_onward_is_near(onward, hit->distance, texel.area);
    }
    const float survival = known ? go_on : aur_path_survival(walk->throughput);
    aur_vector estimate = {0};
    if (known)
        estimate = aur_vector_multiply(walk->throughput, texel.radiance);
    walk->sum = aur_vector_add(walk->sum, estimate);
    if (onward->caustics != NULL) {
        const aur_texel_view caustic =
            aur_irradiance_view(onward->caustics, onward->scene, hit, shading->surface, view);
        walk->sum = aur_vector_add(walk->sum, aur_vector_multiply(walk->throughput, caustic.radiance));
    }
    if (known && !walk->known) {
        walk->known = true;
        walk->known_sum = walk->sum;
    }
    if (!(aur_draw_unit(&walk->hash) < survival))
        return false;
    walk->throughput = aur_vector_scale(walk->throughput, 1.0f / survival);
    walk->sum = aur_vector_add_scaled(walk->sum, -1.0f / survival, estimate);
    return true;
}

/* What a surface scatters towards `view` (world, unit) by the lobes that the map answers for, the diffuse
 * ones and those with a power of a cosine, along one random path. */
static onward_walk walk_from(const aur_onward *onward, const aur_surface *surface, aur_vector view,
                             uint32_t edges, uint64_t hash, aur_counters *counters) {
    const aur_scene *const scene = onward->scene;
    onward_walk walk = {.throughput = {1.0f, 1.0f, 1.0f}, .hash = hash};
    aur_surface met = *surface;
    bool first = true;
    for (; edges < onward->max_depth; ++edges, first = false) {
        const aur_shading shading = aur_shading_at(&met, view);
        add_direct_light(onward, &shading, first, &walk, counters);
        if (!scatter(&shading, first, &walk))
            break;
        aur_hit hit;
        ++counters->rays;
        if (!aur_scene_intersect(scene, &walk.ray, &hit)) {
            add_emission(onward, NULL, &walk);
            break;
        }
        __builtin_prefetch(&onward->map->texels.ranges[aur_element_of(&onward->map->texels.elements, &hit)]);
        aur_scene_surface(scene, &walk.ray, &hit, &met);
        add_emission(onward, &met, &walk);
        view = aur_vector_scale(walk.ray.direction, -1.0f);
        const aur_shading next = aur_shading_at(&met, view);
        if (edges + 1 < onward->max_depth && !survives(onward, &hit, &next, view, &walk))
            break;
    }
    return walk;
}

aur_vector aur_onward_correct(const aur_onward *onward, const aur_surface *surface, aur_vector view,
                              uint32_t edges, uint64_t hash, bool near, aur_vector known,
                              aur_counters *counters) {
    const aur_vector kept = aur_onward_kept(onward, known);
    if (!near && !aur_onward_is_due(onward, hash))
        return kept;
    const onward_walk walk = walk_from(onward, surface, view, edges, aur_onward_walk_hash(hash), counters);
    if (near && onward->lone)
        return walk.known ? aur_vector_subtract(walk.sum, walk.known_sum) : (aur_vector){0};
    if (near)
        return walk.sum;
    return aur_vector_add_scaled(kept, 1.0f / onward->share, aur_vector_subtract(walk.sum, known));
}
