/* Where a ray's hit is plainly diffuse, its radiance is one read of the irradiance map; else it is what
 * chain.c finds. */
#include "transport/gather/incident.h"

#include "transport/gather/chain.h"
#include "transport/lights/direct_light.h"

uint32_t aur_gather_intersect(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet,
                              aur_counters *counters) {
    const uint32_t lanes = aur_lanes_set(packet->valid);
    counters->rays += aur_lane_count(lanes);
    if (plan->policy.packets)
        return aur_scene_intersect16(plan->scene, order, packet);
    return aur_scene_intersect_each(plan->scene, packet);
}

uint32_t aur_gather_occluded(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet,
                             aur_counters *counters) {
    uint32_t lanes = aur_lanes_set(packet->valid), stopped = 0;
    counters->rays += aur_lane_count(lanes);
    if (plan->policy.packets)
        return aur_scene_occluded16(plan->scene, order, packet);
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t lane = aur_first_lane(lanes);
        const aur_ray ray = aur_packet_ray(packet, lane);
        stopped |= (uint32_t)aur_scene_occluded(plan->scene, &ray) << lane;
    }
    return stopped;
}

static void set_radiance(aur_gather_rays *rays, size_t lane, aur_vector radiance) {
    rays->radiance[0][lane] = radiance.x;
    rays->radiance[1][lane] = radiance.y;
    rays->radiance[2][lane] = radiance.z;
}

static float density_of(const aur_gather_rays *rays, size_t lane) {
    if (rays->merged[lane] == NULL)
        return rays->density[lane];
    const aur_vector direction = aur_packet_ray(&rays->packet, lane).direction;
    return aur_merged_rule_density(rays->merged[lane], aur_vector_dot(rays->axes[lane][0], direction),
                                   aur_vector_dot(rays->axes[lane][1], direction));
}

/* The part of a bright texel's light that gathering counts; the rest is found by drawing bright texels. */
static float bright_weight(const aur_gather_plan *plan, const aur_gather_rays *rays, size_t lane,
                           aur_vector known) {
    const float texel = aur_bright_texels_density(&plan->light.bright, known);
    if (texel == 0.0f)
        return 1.0f;
    const struct RTCRayHit16 *const query = &rays->packet.query;
    const aur_vector normal = {query->hit.Ng_x[lane], query->hit.Ng_y[lane], query->hit.Ng_z[lane]};
    const aur_vector direction = {query->ray.dir_x[lane], query->ray.dir_y[lane], query->ray.dir_z[lane]};
    const float along = fabsf(aur_vector_dot(normal, direction)), distance = query->ray.tfar[lane];
    const float rival =
        texel * (float)plan->light.bright_draws * distance * distance * aur_vector_length(normal) / along;
    return along > 0.0f ? aur_power_heuristic(density_of(rays, lane), rival) : 1.0f;
}

/* Diffuse, without emission, no instance: true when that was all. */
static bool plain_radiance(const aur_gather_plan *plan, const aur_gather_rays *rays, size_t lane,
                           aur_vector *radiance) {
    const struct RTCRayHit16 *const query = &rays->packet.query;
    const uint32_t shape = query->hit.geomID[lane];
    if (query->hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID || plan->light.map == NULL ||
        !plan->classes[shape].plain)
        return false;
    const bool behind = query->hit.Ng_x[lane] * query->ray.dir_x[lane] +
                            query->hit.Ng_y[lane] * query->ray.dir_y[lane] +
                            query->hit.Ng_z[lane] * query->ray.dir_z[lane] >
                        0.0f;
    const uint32_t element = plan->light.map->texels.elements.shape_first[shape] + query->hit.primID[lane];
    const aur_texel_light *const light =
        aur_irradiance_on_triangle(plan->light.map, element, query->hit.u[lane], query->hit.v[lane], behind);
    const aur_vector albedo = plan->classes[shape].albedo_on_pi[behind];
    *radiance = aur_vector_multiply(albedo, light->irradiance);
    const float weight = plan->light.bright_draws > 0 ? bright_weight(plan, rays, lane, *radiance) : 1.0f;
    if (plan->light.caustics != NULL) {
        const aur_texel_light *const caustic = aur_irradiance_on_triangle(
            plan->light.caustics, element, query->hit.u[lane], query->hit.v[lane], behind);
        *radiance = aur_vector_add(*radiance, aur_vector_multiply(albedo, caustic->irradiance));
    }
    *radiance = aur_vector_scale(*radiance, weight);
    return true;
}

void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters) {
    const uint32_t lanes = aur_lanes_set(rays->packet.valid);
    const uint32_t found = aur_gather_intersect(plan, order, &rays->packet, counters);
    const bool has_sky = aur_scene_has_environment(plan->scene);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            rays->radiance[c][k] = 0.0f;
    for (uint32_t rest = has_sky ? lanes : found; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const bool hits = (found >> lane & 1u) != 0;
        aur_vector radiance;
        if (!hits || !plain_radiance(plan, rays, lane, &radiance)) {
            /* Only light that is sampled too asks for the density. */
            const bool weighed = !hits || plan->classes[rays->packet.query.hit.geomID[lane]].emits;
            const aur_gather_ray from = {.ray = aur_packet_ray(&rays->packet, lane),
                                         .reference = rays->reference[lane],
                                         .density = weighed ? density_of(rays, lane) : 0.0f,
                                         .hash = aur_hash2(rays->hash, lane)};
            aur_hit hit = {0};
            if (hits)
                hit = aur_packet_hit(plan->scene, &rays->packet, lane);
            radiance = aur_gather_chain_radiance(plan, &from, hits ? &hit : NULL, counters);
        }
        set_radiance(rays, lane, radiance);
    }
}
