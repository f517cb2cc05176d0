/* At every surface on its way the ray finds the light that the surface emits, what the photon maps know of
 * the light that it scatters, and, by lobes that they do not answer for - mirrors, glass, rough facets -,
 * light drawn from the lights; and it goes on by one of those lobes. */
#include "transport/gather/chain.h"

#include "transport/lights/direct_light.h"

/* The kinds of lobes of a surface that a gather ray meets. */
typedef struct surface_lobes {
    bool scatters; /* lobes that the photon map answers for */
    bool mirrors;  /* specular lobes: the ray goes on */
    bool sampled;  /* a lobe without a formula: it goes on too */
} surface_lobes;

static surface_lobes lobes_of(const aur_shading *shading) {
    const unsigned kinds = aur_bsdf_scatters(shading->surface->bsdf, shading->view.z);
    return (surface_lobes){.scatters = (kinds & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0,
                           .mirrors = (kinds & AUR_SCATTERS_SPECULAR) != 0,
                           .sampled = (kinds & AUR_SCATTERS_SAMPLED) != 0};
}

/* A draw of the lobes that the photon map does not answer for; light in world coordinates. */
static bool draw_onward(const aur_shading *shading, surface_lobes kinds, const float u[3],
                        aur_bsdf_sample *drawn) {
    const aur_surface *const surface = shading->surface;
    const aur_bsdf *const bsdf = surface->bsdf;
    if (!kinds.mirrors) {
        if (!aur_bsdf_draw(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, u, drawn))
            return false;
        const float side = drawn->light.z;
        drawn->light = aur_frame_to_world(&surface->frame, drawn->light);
        return aur_vector_dot(surface->geometric_normal, drawn->light) * side > 0.0f;
    }
    if (!aur_shading_sample(shading, u, drawn))
        return false;
    if (drawn->specular || !kinds.sampled)
        return drawn->specular;
    const aur_vector light = aur_frame_to_local(&surface->frame, drawn->light);
    float pdf;
    const aur_vector value =
        aur_bsdf_evaluate(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, light, &pdf);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

/* How the ray came to where it is. */
typedef struct gather_chain {
    uint32_t length;      /* bounces since the gathering point */
    bool specular;        /* all of them */
    bool mirrored;        /* the last one: lights are not sampled for it */
    aur_vector reference; /* where the last ray began */
    float density;        /* with which its direction was drawn, a steradian, times how often */
    float light_draws;    /* points on lights that were drawn there */
} gather_chain;

/* The part of a light's radiance that this ray counts; the rest is found by sampling the light. */
static float emission_weight(const aur_gather_plan *plan, const gather_chain *chain, float light_pdf) {
    if (plan->counts_emitters)
        return 1.0f;
    if (!chain->mirrored)
        return aur_power_heuristic(chain->density, chain->light_draws * light_pdf);
    /* Light that a mirror throws here is found by caustic photons, if there are. */
    return plan->light.caustics != NULL && chain->specular ? 0.0f : 1.0f;
}

/* Whether rays count any of the light that they meet. */
static bool finds_emission(const aur_gather_plan *plan) {
    return plan->policy.direct == AUR_DIRECT_NEE || plan->counts_emitters;
}

/* Whether it takes the density of a light's own sampling to tell how much of it. */
static bool has_rival(const aur_gather_plan *plan, const gather_chain *chain) {
    return !chain->mirrored && !plan->counts_emitters;
}

static aur_vector sky_radiance(const aur_gather_plan *plan, aur_vector direction, const gather_chain *chain) {
    if (!finds_emission(plan))
        return (aur_vector){0};
    const aur_vector sky = aur_scene_environment(plan->scene, direction);
    if (aur_vector_is_zero(sky))
        return sky;
    const float pdf = has_rival(plan, chain) ? aur_environment_pdf_direct(plan->scene, direction) : 0.0f;
    return aur_vector_scale(sky, emission_weight(plan, chain, pdf));
}

static aur_vector emitted_radiance(const aur_gather_plan *plan, const aur_surface *surface, aur_vector view,
                                   const gather_chain *chain) {
    if (!finds_emission(plan))
        return (aur_vector){0};
    const aur_vector emission = aur_surface_emission(plan->scene, surface, view);
    if (aur_vector_is_zero(emission))
        return emission;
    const float pdf = has_rival(plan, chain)
                          ? aur_light_pdf_direct(plan->scene, chain->reference, AUR_LEAST_LIGHT_SEEN, surface)
                          : 0.0f;
    return aur_vector_scale(emission, emission_weight(plan, chain, pdf));
}

/* What the photon maps know of the light that leaves a surface. */
static aur_vector scattered_radiance(const aur_gather_plan *plan, const aur_hit *hit,
                                     const aur_surface *surface, aur_vector view) {
    aur_vector sum = {0};
    if (plan->light.map != NULL)
        sum = aur_irradiance_radiance(plan->light.map, plan->scene, hit, surface, view);
    if (plan->light.caustics != NULL)
        sum = aur_vector_add(sum,
                             aur_irradiance_radiance(plan->light.caustics, plan->scene, hit, surface, view));
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
static aur_vector sampled_light(const aur_gather_plan *plan, const aur_shading *shading, surface_lobes kinds,
                                aur_vector known, uint64_t *hash, aur_counters *counters) {
    const aur_vector black = {0};
    const aur_surface *const surface = shading->surface;
    float u[3];
    aur_light_sample light;
    draw_units(hash, u);
    if (!aur_light_sample_direct(plan->scene, surface->position, AUR_LEAST_LIGHT_SEEN, u, &light) ||
        !(light.pdf > 0.0f))
        return black;
    const aur_vector local = aur_frame_to_local(&surface->frame, light.direction);
    if (aur_vector_dot(surface->geometric_normal, light.direction) * local.z <= 0.0f)
        return black;
    const aur_bsdf *const bsdf = surface->bsdf;
    float rival;
    const aur_vector value =
        aur_bsdf_evaluate(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, shading->view, local, &rival);
    if (aur_vector_is_zero(value))
        return black;
    if (kinds.mirrors)
        aur_bsdf_evaluate(bsdf, AUR_BSDF_WHOLE, surface->texture, shading->view, local, &rival);
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
    return aur_scene_occluded(plan->scene, &shadow) ? black : aur_vector_scale(radiance, 1.0f / survival);
}

aur_vector aur_gather_chain_radiance(const aur_gather_plan *plan, const aur_gather_ray *from,
                                     const aur_hit *hit, aur_counters *counters) {
    const aur_scene *const scene = plan->scene;
    const bool samples_lights =
        plan->policy.direct == AUR_DIRECT_NEE && !plan->counts_emitters && aur_scene_emitter_count(scene) > 0;
    gather_chain chain = {.specular = true,
                          .reference = from->reference,
                          .density = from->density,
                          .light_draws = (float)plan->light.draws};
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_ray ray = from->ray;
    uint64_t hash = from->hash;
    aur_hit next;
    for (;; ++chain.length) {
        if (hit == NULL) {
            const aur_vector sky = sky_radiance(plan, ray.direction, &chain);
            return aur_vector_add(sum, aur_vector_multiply(throughput, sky));
        }
        aur_surface surface;
        aur_scene_surface(scene, &ray, hit, &surface);
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        const aur_shading shading = aur_shading_at(&surface, view);
        const surface_lobes kinds = lobes_of(&shading);
        aur_vector radiance = emitted_radiance(plan, &surface, view, &chain);
        /* Two edges led here, and one for each link of the chain; a photon came by one more at least. */
        const bool deeper = chain.length + 3 <= plan->policy.max_depth;
        if (kinds.scatters && deeper)
            radiance = aur_vector_add(radiance, scattered_radiance(plan, hit, &surface, view));
        if (kinds.sampled && deeper && samples_lights)
            radiance =
                aur_vector_add(radiance, sampled_light(plan, &shading, kinds, radiance, &hash, counters));
        sum = aur_vector_add(sum, aur_vector_multiply(throughput, radiance));
        if (!(kinds.mirrors || kinds.sampled) || !deeper)
            return sum;
        float u[3];
        aur_bsdf_sample drawn;
        draw_units(&hash, u);
        if (!draw_onward(&shading, kinds, u, &drawn))
            return sum;
        throughput = aur_vector_multiply(throughput, drawn.weight);
        const float survival = fminf(1.0f, BOOST * aur_vector_max(throughput));
        if (!(draw_unit(&hash) < survival))
            return sum;
        if (chain.length == AUR_LONGEST_CHAIN) {
            ++counters->cut;
            return sum;
        }
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
