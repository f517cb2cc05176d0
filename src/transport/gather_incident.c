/* Radiance along gather rays: where the ray's hit is plainly diffuse, one read of the irradiance map; else
 * the surface, its emission, its glossy lobes over the map's photons, and mirrors and glass followed. */
#include "transport/direct_light.h"
#include "transport/final_gather.h"

bool aur_gathers_emitters(const aur_final_gather *data) {
    return data->direct == AUR_DIRECT_GATHER ||
           (data->incident == AUR_INCIDENT_EMITTERS && data->direct == AUR_DIRECT_NONE);
}

/* What a gather ray meets. */
typedef struct met_surface {
    bool scatters; /* by lobes that the photon map answers for */
    bool mirrors;  /* by specular lobes: the ray goes on */
    bool sampled;  /* by a lobe without a formula: it goes on too */
} met_surface;

static met_surface meet(const aur_surface *surface, aur_vector view) {
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const aur_vector local = aur_frame_to_local(&surface->frame, view);
    const size_t count = surface->bsdf->descriptor->lobes(surface->bsdf, surface->texture, local, lobes);
    met_surface met = {0};
    for (size_t i = 0; i < count; ++i) {
        met.mirrors = met.mirrors || lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR;
        met.sampled = met.sampled || lobes[i].shape == AUR_LOBE_SHAPE_SAMPLED;
        met.scatters = met.scatters || lobes[i].shape == AUR_LOBE_SHAPE_COSINE_POWER;
    }
    return met;
}

/* A draw of the lobes that the photon map does not answer for; light in world coordinates. */
static bool draw_onward(const aur_surface *surface, aur_vector view, met_surface met, const float u[3],
                        aur_bsdf_sample *drawn) {
    const aur_bsdf *const bsdf = surface->bsdf;
    const aur_shading shading = aur_shading_at(surface, view);
    if (!met.mirrors) {
        if (!aur_bsdf_sample_sampled(bsdf, surface->texture, shading.view, u, drawn))
            return false;
        const float side = drawn->light.z;
        drawn->light = aur_frame_to_world(&surface->frame, drawn->light);
        return aur_vector_dot(surface->geometric_normal, drawn->light) * side > 0.0f;
    }
    if (!aur_shading_sample(&shading, u, drawn))
        return false;
    if (drawn->specular || !met.sampled)
        return drawn->specular;
    const aur_vector light = aur_frame_to_local(&surface->frame, drawn->light);
    const aur_vector value = aur_bsdf_evaluate_sampled(bsdf, surface->texture, shading.view, light);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

/* One ray that has left a gathering point. */
typedef struct gather_ray {
    aur_ray ray;
    aur_vector reference;
    float density;
    uint64_t hash;
} gather_ray;

/* How a ray came where it is. */
typedef struct gather_chain {
    uint32_t length; /* bounces since the gathering point */
    bool specular;   /* all of them */
} gather_chain;

/* The part of a light's radiance that gathering counts; the rest is found by sampling the light. */
static float emission_weight(const aur_final_gather *data, gather_chain chain, float density,
                             float light_pdf) {
    if (aur_gathers_emitters(data))
        return 1.0f;
    if (data->direct != AUR_DIRECT_NEE)
        return 0.0f;
    if (chain.length == 0)
        return aur_power_heuristic(density, light_pdf);
    /* Light that a mirror throws here is not found by sampling lights, but by caustic photons if there are.
     */
    return data->caustics != NULL && chain.specular ? 0.0f : 1.0f;
}

static aur_vector sky_radiance(const aur_final_gather *data, const gather_ray *from, aur_vector direction,
                               gather_chain chain) {
    const aur_vector sky = aur_scene_environment(data->scene, direction);
    if (aur_vector_is_zero(sky))
        return sky;
    const float pdf = chain.length > 0 ? 0.0f : aur_environment_pdf_direct(data->scene, direction);
    return aur_vector_scale(sky, emission_weight(data, chain, from->density, pdf));
}

static aur_vector emitted_radiance(const aur_final_gather *data, const gather_ray *from,
                                   const aur_surface *surface, aur_vector view, gather_chain chain) {
    const aur_vector emission = aur_surface_emission(data->scene, surface, view);
    if (aur_vector_is_zero(emission))
        return emission;
    const float pdf = chain.length > 0
                          ? 0.0f
                          : aur_light_pdf_direct(data->scene, from->reference, AUR_LEAST_LIGHT_SEEN, surface);
    return aur_vector_scale(emission, emission_weight(data, chain, from->density, pdf));
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

/* The general case. `hit` is the first one, or NULL when the ray left the scene. */
static aur_vector radiance_along(const aur_final_gather *data, const gather_ray *from, const aur_hit *hit,
                                 aur_counters *counters) {
    const aur_scene *const scene = data->scene;
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_ray ray = from->ray;
    uint64_t hash = from->hash;
    aur_hit next;
    for (gather_chain chain = {0, true};; ++chain.length) {
        if (hit == NULL) {
            const aur_vector sky = sky_radiance(data, from, ray.direction, chain);
            return aur_vector_add(sum, aur_vector_multiply(throughput, sky));
        }
        aur_surface surface;
        aur_scene_surface(scene, &ray, hit, &surface);
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        const met_surface met = meet(&surface, view);
        aur_vector radiance = emitted_radiance(data, from, &surface, view, chain);
        /* Two edges led here, one a link of the chain, and a photon came by one at least. */
        if (met.scatters && chain.length + 3 <= data->max_depth)
            radiance = aur_vector_add(radiance, scattered_radiance(data, hit, &surface, view));
        sum = aur_vector_add(sum, aur_vector_multiply(throughput, radiance));
        if (!(met.mirrors || met.sampled) || chain.length == AUR_LONGEST_CHAIN ||
            chain.length + 3 > data->max_depth)
            return sum;
        hash = aur_mix64(hash);
        const float u[3] = {aur_unit_float((uint32_t)hash), aur_unit_float((uint32_t)(hash >> 32)),
                            aur_unit_float((uint32_t)aur_mix64(hash + 1))};
        aur_bsdf_sample sample;
        if (!draw_onward(&surface, view, met, u, &sample))
            return sum;
        chain.specular = chain.specular && sample.specular;
        throughput = aur_vector_multiply(throughput, sample.weight);
        const float survival = fminf(1.0f, BOOST * aur_vector_max(throughput));
        if (!(aur_unit_float((uint32_t)(aur_mix64(hash + 1) >> 32)) < survival))
            return sum;
        throughput = aur_vector_scale(throughput, 1.0f / survival);
        ray = aur_surface_ray(&surface, sample.light);
        ++counters->rays;
        hit = aur_scene_intersect(scene, &ray, &next) ? &next : NULL;
    }
}

static aur_ray packet_ray(const aur_packet *packet, size_t lane) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    return (aur_ray){.origin = {rays->org_x[lane], rays->org_y[lane], rays->org_z[lane]},
                     .nearest = rays->tnear[lane],
                     .direction = {rays->dir_x[lane], rays->dir_y[lane], rays->dir_z[lane]},
                     .farthest = rays->tfar[lane]};
}

static uint32_t valid_lanes(const aur_packet *packet) {
    uint32_t lanes = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        lanes |= (uint32_t)(packet->valid[k] != 0) << k;
    return lanes;
}

uint32_t aur_final_gather_intersect(const aur_final_gather *data, aur_embree_order order, aur_packet *packet,
                                    aur_counters *counters) {
    const uint32_t lanes = valid_lanes(packet);
    counters->rays += (uint64_t)__builtin_popcount(lanes);
    if (data->packets)
        return aur_scene_intersect16(data->scene, order, packet);
    return aur_scene_intersect_each(data->scene, packet);
}

uint32_t aur_final_gather_occluded(const aur_final_gather *data, aur_embree_order order, aur_packet *packet,
                                   aur_counters *counters) {
    uint32_t lanes = valid_lanes(packet), stopped = 0;
    counters->rays += (uint64_t)__builtin_popcount(lanes);
    if (data->packets)
        return aur_scene_occluded16(data->scene, order, packet);
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t lane = (size_t)__builtin_ctz(lanes);
        const aur_ray ray = packet_ray(packet, lane);
        stopped |= (uint32_t)aur_scene_occluded(data->scene, &ray) << lane;
    }
    return stopped;
}

static void set_radiance(aur_gather_rays *rays, size_t lane, aur_vector radiance) {
    rays->radiance[0][lane] = radiance.x;
    rays->radiance[1][lane] = radiance.y;
    rays->radiance[2][lane] = radiance.z;
}

/* Diffuse, without emission, no instance: true when that was all. */
static bool plain_radiance(const aur_final_gather *data, const struct RTCRayHit16 *query, size_t lane,
                           aur_vector *radiance) {
    const uint32_t shape = query->hit.geomID[lane];
    if (query->hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID || !data->classes[shape].plain)
        return false;
    const bool behind = query->hit.Ng_x[lane] * query->ray.dir_x[lane] +
                            query->hit.Ng_y[lane] * query->ray.dir_y[lane] +
                            query->hit.Ng_z[lane] * query->ray.dir_z[lane] >
                        0.0f;
    const uint32_t element = data->map->texels.elements.shape_first[shape] + query->hit.primID[lane];
    const aur_texel_light *const light =
        aur_irradiance_on_triangle(data->map, element, query->hit.u[lane], query->hit.v[lane], behind);
    aur_vector irradiance = light->irradiance;
    if (data->caustics != NULL)
        irradiance =
            aur_vector_add(irradiance, aur_irradiance_on_triangle(data->caustics, element, query->hit.u[lane],
                                                                  query->hit.v[lane], behind)
                                           ->irradiance);
    *radiance = aur_vector_multiply(data->classes[shape].albedo_on_pi[behind], irradiance);
    return true;
}

static float density_of(const aur_gather_rays *rays, size_t lane) {
    if (rays->pair == NULL)
        return rays->density[lane];
    const aur_vector direction = packet_ray(&rays->packet, lane).direction;
    return aur_gather_pair_density(rays->pair, aur_vector_dot(rays->axes[lane][0], direction),
                                   aur_vector_dot(rays->axes[lane][1], direction));
}

void aur_gather_trace(const aur_final_gather *data, aur_embree_order order, aur_gather_rays *rays,
                      aur_counters *counters) {
    const uint32_t lanes = valid_lanes(&rays->packet);
    const uint32_t found = aur_final_gather_intersect(data, order, &rays->packet, counters);
    const bool has_sky = aur_scene_has_environment(data->scene);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            rays->radiance[c][k] = 0.0f;
    for (uint32_t rest = has_sky ? lanes : found; rest != 0; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        const bool hits = (found >> lane & 1u) != 0;
        aur_vector radiance;
        if (!hits || !plain_radiance(data, &rays->packet.query, lane, &radiance)) {
            const gather_ray from = {.ray = packet_ray(&rays->packet, lane),
                                     .reference = rays->reference[lane],
                                     .density = density_of(rays, lane),
                                     .hash = aur_hash2(rays->hash, lane)};
            aur_hit hit = {0};
            if (hits)
                hit = aur_packet_hit(data->scene, &rays->packet, lane);
            radiance = radiance_along(data, &from, hits ? &hit : NULL, counters);
        }
        set_radiance(rays, lane, radiance);
    }
}
