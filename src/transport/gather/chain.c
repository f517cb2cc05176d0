/* Radiance along one gather ray in the general case: the light that its hit emits, what the photon maps know
 * of the light that it scatters, and, by lobes that they do not answer for - mirrors, glass, rough facets -,
 * light sampled straight from the lights and a ray that goes on. */
#include "transport/gather/plan.h"
#include "transport/lights/direct_light.h"

/* What a gather ray meets. */
typedef struct met_surface {
    bool scatters; /* by lobes that the photon map answers for */
    bool mirrors;  /* by specular lobes: the ray goes on */
    bool sampled;  /* by a lobe without a formula: it goes on too */
} met_surface;

static met_surface meet(const aur_shading *shading) {
    const unsigned kinds = aur_bsdf_scatters(shading->surface->bsdf, shading->view.z);
    return (met_surface){.scatters = (kinds & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0,
                         .mirrors = (kinds & AUR_SCATTERS_SPECULAR) != 0,
                         .sampled = (kinds & AUR_SCATTERS_SAMPLED) != 0};
}

/* A draw of the lobes that the photon map does not answer for; light in world coordinates. */
static bool draw_onward(const aur_shading *shading, met_surface met, const float u[3],
                        aur_bsdf_sample *drawn) {
    const aur_surface *const surface = shading->surface;
    const aur_bsdf *const bsdf = surface->bsdf;
    if (!met.mirrors) {
        if (!aur_bsdf_draw(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, u, drawn))
            return false;
        const float side = drawn->light.z;
        drawn->light = aur_frame_to_world(&surface->frame, drawn->light);
        return aur_vector_dot(surface->geometric_normal, drawn->light) * side > 0.0f;
    }
    if (!aur_shading_sample(shading, u, drawn))
        return false;
    if (drawn->specular || !met.sampled)
        return drawn->specular;
    const aur_vector light = aur_frame_to_local(&surface->frame, drawn->light);
    const aur_vector value =
        aur_bsdf_evaluate(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, light);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

/* How the ray came where it is. */
typedef struct gather_chain {
    uint32_t length;      /* bounces since the gathering point */
    bool specular;        /* all of them */
    bool mirrored;        /* the last one: lights are not sampled for it */
    aur_vector reference; /* where the last ray began */
    float density;        /* with which its direction was drawn, a steradian, times how often */
    float light_draws;    /* points on lights that were drawn there */
} gather_chain;

/* The part of a light's radiance that this ray counts; the rest is found by sampling the light. */
static float emission_weight(const aur_final_gather *data, const gather_chain *chain, float light_pdf) {
    if (aur_gathers_emitters(data))
        return 1.0f;
    if (!chain->mirrored)
        return aur_power_heuristic(chain->density, chain->light_draws * light_pdf);
    /* Light that a mirror throws here is found by caustic photons, if there are. */
    return data->caustics != NULL && chain->specular ? 0.0f : 1.0f;
}

/* Whether rays count any of the light that they meet, and whether it takes a light's density to tell how
 * much.
 */
static bool counts_emission(const aur_final_gather *data) {
    return data->direct == AUR_DIRECT_NEE || aur_gathers_emitters(data);
}

static bool has_rival(const aur_final_gather *data, const gather_chain *chain) {
    return !chain->mirrored && !aur_gathers_emitters(data);
}

static aur_vector sky_radiance(const aur_final_gather *data, aur_vector direction,
                               const gather_chain *chain) {
    if (!counts_emission(data))
        return (aur_vector){0};
    const aur_vector sky = aur_scene_environment(data->scene, direction);
    if (aur_vector_is_zero(sky))
        return sky;
    const float pdf = has_rival(data, chain) ? aur_environment_pdf_direct(data->scene, direction) : 0.0f;
    return aur_vector_scale(sky, emission_weight(data, chain, pdf));
}

static aur_vector emitted_radiance(const aur_final_gather *data, const aur_surface *surface, aur_vector view,
                                   const gather_chain *chain) {
    if (!counts_emission(data))
        return (aur_vector){0};
    const aur_vector emission = aur_surface_emission(data->scene, surface, view);
    if (aur_vector_is_zero(emission))
        return emission;
    const float pdf = has_rival(data, chain)
                          ? aur_light_pdf_direct(data->scene, chain->reference, AUR_LEAST_LIGHT_SEEN, surface)
                          : 0.0f;
    return aur_vector_scale(emission, emission_weight(data, chain, pdf));
}

/* What the photon maps know of the light that leaves a surface. */
static aur_vector scattered_radiance(const aur_final_gather *data, const aur_hit *hit,
                                     const aur_surface *surface, aur_vector view) {
    aur_vector sum = {0};
    if (data->map != NULL)
        sum = aur_irradiance_radiance(data->map, data->scene, hit, surface, view);
    if (data->caustics != NULL)
        sum = aur_vector_add(sum, aur_irradiance_radiance(data->caustics, data->scene, hit, surface, view));
    return sum;
}

/* Weak reflections are followed now and then, so many times as often as they are strong. */
static const float BOOST = 8.0f;

static float draw_unit(uint64_t *hash) {
    *hash = aur_mix64(*hash + 1);
    return aur_unit_float((uint32_t)(*hash >> 32));
}

static void draw_units(uint64_t *hash, float u[3]) {
    for (size_t i = 0; i < 3; ++i)
        u[i] = draw_unit(hash);
}

/* A point on a light, reflected by the sampled lobe, weighed beside the ray that goes on. What is weak beside
 * the radiance `known` of the surface is asked for now and then. */
static aur_vector sampled_light(const aur_final_gather *data, const aur_shading *shading, met_surface met,
                                aur_vector known, uint64_t *hash, aur_counters *counters) {
    const aur_vector black = {0};
    const aur_surface *const surface = shading->surface;
    float u[3];
    aur_light_sample light;
    draw_units(hash, u);
    if (!aur_light_sample_direct(data->scene, surface->position, AUR_LEAST_LIGHT_SEEN, u, &light) ||
        !(light.pdf > 0.0f))
        return black;
    const aur_vector local = aur_frame_to_local(&surface->frame, light.direction);
    if (aur_vector_dot(surface->geometric_normal, light.direction) * local.z <= 0.0f)
        return black;
    const aur_bsdf *const bsdf = surface->bsdf;
    const aur_vector value =
        aur_bsdf_evaluate(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, local);
    if (aur_vector_is_zero(value))
        return black;
    const aur_bsdf_part part = met.mirrors ? AUR_BSDF_WHOLE : AUR_BSDF_SAMPLED_LOBES;
    const float rival = aur_bsdf_pdf(bsdf, part, surface->texture, shading->view, local);
    const float weight = light.delta ? 1.0f : aur_power_heuristic(light.pdf, rival);
    const aur_vector radiance =
        aur_vector_scale(aur_vector_multiply(value, light.radiance), weight / light.pdf);
    const float strength = aur_vector_max(radiance);
    const float survival = fminf(1.0f, BOOST * strength / (strength + aur_vector_max(known)));
    if (!(draw_unit(hash) < survival))
        return black;
    float distance;
    const aur_ray shadow = aur_surface_ray_to(surface, light.position, &distance);
    ++counters->rays;
    return aur_scene_occluded(data->scene, &shadow) ? black : aur_vector_scale(radiance, 1.0f / survival);
}

aur_vector aur_gather_chain_radiance(const aur_final_gather *data, const aur_gather_ray *from,
                                     const aur_hit *hit, aur_counters *counters) {
    const aur_scene *const scene = data->scene;
    const bool samples_lights =
        data->direct == AUR_DIRECT_NEE && !aur_gathers_emitters(data) && aur_scene_emitter_count(scene) > 0;
    gather_chain chain = {.specular = true,
                          .reference = from->reference,
                          .density = from->density,
                          .light_draws = (float)data->light_share};
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_ray ray = from->ray;
    uint64_t hash = from->hash;
    aur_hit next;
    for (;; ++chain.length) {
        if (hit == NULL) {
            const aur_vector sky = sky_radiance(data, ray.direction, &chain);
            return aur_vector_add(sum, aur_vector_multiply(throughput, sky));
        }
        aur_surface surface;
        aur_scene_surface(scene, &ray, hit, &surface);
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        const aur_shading shading = aur_shading_at(&surface, view);
        const met_surface met = meet(&shading);
        aur_vector radiance = emitted_radiance(data, &surface, view, &chain);
        /* Two edges led here, and one for each link of the chain; a photon came by one more at least. */
        const bool deeper = chain.length + 3 <= data->max_depth;
        if (met.scatters && deeper)
            radiance = aur_vector_add(radiance, scattered_radiance(data, hit, &surface, view));
        if (met.sampled && deeper && samples_lights)
            radiance =
                aur_vector_add(radiance, sampled_light(data, &shading, met, radiance, &hash, counters));
        sum = aur_vector_add(sum, aur_vector_multiply(throughput, radiance));
        if (!(met.mirrors || met.sampled) || chain.length == AUR_LONGEST_CHAIN || !deeper)
            return sum;
        float u[3];
        aur_bsdf_sample drawn;
        draw_units(&hash, u);
        if (!draw_onward(&shading, met, u, &drawn))
            return sum;
        throughput = aur_vector_multiply(throughput, drawn.weight);
        const float survival = fminf(1.0f, BOOST * aur_vector_max(throughput));
        if (!(draw_unit(&hash) < survival))
            return sum;
        throughput = aur_vector_scale(throughput, 1.0f / survival);
        chain.specular = chain.specular && drawn.specular;
        chain.mirrored = drawn.specular;
        chain.reference = surface.position;
        chain.density = drawn.pdf;
        chain.light_draws = 1.0f;
        ray = aur_surface_ray(&surface, drawn.light);
        ++counters->rays;
        hit = aur_scene_intersect(scene, &ray, &next) ? &next : NULL;
    }
}
