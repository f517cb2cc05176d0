/* Radiance along gather rays. At a purely diffuse surface it is one look-up in the irradiance map. Elsewhere
 * it is the surface's emission, the photon maps' estimate of scattered light, and light samples for the lobes
 * that the maps do not cover (mirrors, glass, rough microfacets); the ray continues by one of those lobes. */
#include "render/gather/incident.h"

#include "render/vertex/vertex.h"

/* --- packets */

uint32_t aur_gather_intersect(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet) {
    if (plan->policy.packets)
        return aur_scene_intersect16(plan->scene, order, packet);
    return aur_scene_intersect_each(plan->scene, packet);
}

uint32_t aur_gather_occluded(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet) {
    if (plan->policy.packets)
        return aur_scene_occluded16(plan->scene, order, packet);
    return aur_scene_occluded_each(plan->scene, packet);
}

/* What a packet's rays hit. */
typedef struct gather_hits {
    uint32_t found, plain; /* lanes: with a hit, and those of plain_lanes */
    uint32_t element[AUR_PACKET_SIZE];
    uint32_t texel[AUR_PACKET_SIZE]; /* of the map; on curved shapes another one of the element */
    aur_hit hits[AUR_PACKET_SIZE];   /* those of lanes that are not plain; and their surfaces */
    aur_surface surfaces[AUR_PACKET_SIZE];
    /* Samples of lights for lobes that the map does not cover; and the seeds after that. */
    aur_light_lanes lights;
    uint64_t hash[AUR_PACKET_SIZE];
} gather_hits;

/* --- a continued ray */

/* A path of mirrors and rough facets, and how it came to where it is. */
typedef struct gather_chain {
    aur_walk path;
    size_t lane;           /* of the gather ray */
    uint64_t hash;         /* seed of the random decisions along the chain */
    uint32_t length;       /* bounces since the gathering point */
    bool specular;         /* all of them */
    float specular_length; /* length of the rays since the last non-specular scattering */
} gather_chain;

/* Adds the MIS-weighted emission of a surface, or of the sky if `surface` is NULL. Light sampling finds the
 * rest; after specular bounces only, caustic photons do. */
static void add_emission(const aur_gather_plan *plan, const aur_surface *surface, gather_chain *chain) {
    aur_walk *const path = &chain->path;
    if (plan->counts_emitters)
        path->bounce.specular_bounce = true;
    else if (plan->policy.direct != AUR_DIRECT_NEE ||
             (path->bounce.specular_bounce && plan->light.caustics != NULL && chain->specular))
        return;
    aur_walk_add_emission(plan->scene, surface, path);
}

void aur_gather_rays_finish(const aur_gather_plan *plan, aur_gather_rays *rays) {
    aur_gather_paths *const paths = &rays->paths;
    aur_vector radiance[AUR_PACKET_SIZE];
    if (paths->count > 0)
        aur_continuation_correct(&plan->continuation, paths->count, paths->starts, radiance);
    for (size_t i = 0; i < paths->count; ++i) {
        const aur_vector added = aur_vector_multiply(paths->weights[i], radiance[i]);
        paths->to[i][0] += added.x;
        paths->to[i][AUR_PACKET_SIZE] += added.y;
        paths->to[i][2 * AUR_PACKET_SIZE] += added.z;
    }
    paths->count = 0;
}

/* Adds the path whose start is the next free one to those that wait. */
static void wait_for_path(const aur_gather_plan *plan, size_t lane, aur_vector weight,
                          aur_gather_rays *rays) {
    aur_gather_paths *const paths = &rays->paths;
    paths->weights[paths->count] = weight;
    paths->to[paths->count++] = &rays->radiance[0][lane];
    if (paths->count == AUR_PACKET_SIZE)
        aur_gather_rays_finish(plan, rays);
}

/* Adds the radiance that the photon maps estimate for a surface; where a path replaces it, the path
 * waits. */
static void add_scattered(const aur_gather_plan *plan, const aur_hit *hit, const aur_surface *surface,
                          aur_gather_rays *rays, gather_chain *chain) {
    aur_vector radiance = {0};
    const aur_vector wo = aur_vector_scale(chain->path.ray.direction, -1.0f);
    if (plan->light.map != NULL) {
        const aur_texel_view texel = aur_irradiance_view(plan->light.map, plan->scene, hit, surface, wo);
        const uint64_t hash = aur_hash2(chain->hash, chain->length);
        const bool near =
            aur_continuation_is_near(&plan->continuation, chain->specular_length + hit->distance, texel.area);
        if (near || aur_continuation_is_due(&plan->continuation, hash)) {
            rays->paths.starts[rays->paths.count] =
                (aur_continuation_start){*surface, wo, chain->length + 2, hash, near, texel.radiance};
            wait_for_path(plan, chain->lane, chain->path.beta, rays);
        } else {
            radiance = aur_continuation_uncorrected(&plan->continuation, texel.radiance);
        }
    }
    if (plan->light.caustics != NULL)
        radiance = aur_vector_add(
            radiance, aur_irradiance_view(plan->light.caustics, plan->scene, hit, surface, wo).radiance);
    chain->path.radiance =
        aur_vector_add(chain->path.radiance, aur_vector_multiply(chain->path.beta, radiance));
}

/* Two edges lead to a surface on a chain, and one per link; a photon adds at least one more. */
static bool is_deeper(const aur_gather_plan *plan, uint32_t length) {
    return length + 3 <= plan->policy.max_depth;
}

/* Whether lights are sampled at a surface on a chain, for its sampled lobes. */
static bool samples_lights(const aur_gather_plan *plan, unsigned kinds, uint32_t length) {
    return (kinds & AUR_SCATTERS_SAMPLED) != 0 && is_deeper(plan, length) &&
           plan->policy.direct == AUR_DIRECT_NEE && !plan->counts_emitters &&
           aur_scene_emitter_count(plan->scene) > 0;
}

/* Adds a light sample reflected by the sampled lobe, MIS-weighted against the continued ray. At the first
 * surface it is drawn already. */
static void add_sampled_light(const aur_gather_plan *plan, const aur_shading *shading, const gather_hits *all,
                              gather_chain *chain) {
    aur_light_sample light;
    if (chain->length == 0) {
        light = aur_light_lane(&all->lights, chain->lane);
        chain->hash = all->hash[chain->lane];
    } else {
        float u[3];
        const aur_light_reference reference = aur_shading_reference(shading);
        aur_draw_units(&chain->hash, u);
        if (!aur_light_sample_direct(plan->scene, &reference, u, &light))
            return;
    }
    aur_shadow shadow;
    if (aur_vertex_light(shading, AUR_VERTEX_UNMAPPED, AUR_VERTEX_ONE_EACH, &light, &shadow) &&
        !aur_scene_occluded(plan->scene, &shadow.ray))
        chain->path.radiance =
            aur_vector_add(chain->path.radiance, aur_vector_multiply(chain->path.beta, shadow.radiance));
}

/* Continues by lobes that the photon map does not cover; false if the path ends. */
static bool scatter(const aur_shading *shading, float distance, gather_chain *chain, aur_counters *counters) {
    aur_walk *const path = &chain->path;
    float u[3];
    aur_draw_units(&chain->hash, u);
    if (!aur_walk_scatter(shading, AUR_VERTEX_UNMAPPED, u, path))
        return false;
    if (!aur_vertex_survives(aur_survival(path->beta), aur_draw_unit(&chain->hash), &path->beta))
        return false;
    if (chain->length == AUR_LONGEST_CHAIN) {
        ++counters->cut;
        return false;
    }
    ++chain->length;
    chain->specular = chain->specular && path->bounce.specular_bounce;
    chain->specular_length = path->bounce.specular_bounce ? chain->specular_length + distance : 0.0f;
    return true;
}

static aur_vector chain_radiance(const aur_gather_plan *plan, gather_chain chain, const gather_hits *all,
                                 aur_gather_rays *rays, aur_counters *counters) {
    const aur_scene *const scene = plan->scene;
    const aur_hit *hit = aur_has_lane(all->found, chain.lane) ? &all->hits[chain.lane] : NULL;
    const aur_surface *surface = &all->surfaces[chain.lane];
    aur_hit next;
    aur_surface next_surface;
    while (hit != NULL) {
        const aur_shading shading =
            aur_shading_at(surface, aur_vector_scale(chain.path.ray.direction, -1.0f));
        const unsigned kinds = aur_bsdf_scatters(surface->bsdf, shading.view.z);
        const bool deeper = is_deeper(plan, chain.length);
        add_emission(plan, surface, &chain);
        if (deeper && (kinds & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0)
            add_scattered(plan, hit, surface, rays, &chain);
        if (samples_lights(plan, kinds, chain.length))
            add_sampled_light(plan, &shading, all, &chain);
        if (!deeper || (kinds & (AUR_SCATTERS_SPECULAR | AUR_SCATTERS_SAMPLED)) == 0 ||
            !scatter(&shading, hit->distance, &chain, counters))
            return chain.path.radiance;
        hit = aur_scene_intersect(scene, &chain.path.ray, &next) ? &next : NULL;
        if (hit != NULL)
            aur_scene_surface(scene, &chain.path.ray, hit, &next_surface);
        surface = &next_surface;
    }
    add_emission(plan, NULL, &chain);
    return chain.path.radiance;
}

/* --- sixteen rays */

/* The part of a bright texel's light that gathering counts; sampling of bright texels adds the rest. */
static float bright_weight(const aur_gather_plan *plan, const aur_gather_rays *rays, size_t lane,
                           aur_vector map_light) {
    const float texel = aur_bright_texels_density(plan->light.bright, map_light);
    if (texel == 0.0f)
        return 1.0f;
    const struct RTCRayHit16 *const query = &rays->packet.query;
    const aur_vector normal = {query->hit.Ng_x[lane], query->hit.Ng_y[lane], query->hit.Ng_z[lane]};
    const aur_vector direction = {query->ray.dir_x[lane], query->ray.dir_y[lane], query->ray.dir_z[lane]};
    const float along = fabsf(aur_vector_dot(normal, direction)), distance = query->ray.tfar[lane];
    const float other_pdf =
        texel * (float)plan->light.bright_draws * distance * distance * aur_vector_length(normal) / along;
    return along > 0.0f ? aur_power_heuristic(rays->density[lane], other_pdf) : 1.0f;
}

/* Radiance of a diffuse surface without emission and outside instances: from the map's `texel`, or from a
 * path where the texel is near or the map is corrected. */
static aur_vector plain_radiance(const aur_gather_plan *plan, size_t lane, uint32_t element, uint32_t texel,
                                 aur_gather_rays *rays) {
    const struct RTCRayHit16 *const query = &rays->packet.query;
    const bool behind = query->hit.Ng_x[lane] * query->ray.dir_x[lane] +
                            query->hit.Ng_y[lane] * query->ray.dir_y[lane] +
                            query->hit.Ng_z[lane] * query->ray.dir_z[lane] >
                        0.0f;
    const aur_photon_radiance map_light = aur_gather_plan_photons(
        plan, query->hit.geomID[lane], element, texel, query->hit.u[lane], query->hit.v[lane], behind);
    const float weight =
        plan->light.bright_draws > 0 ? bright_weight(plan, rays, lane, map_light.radiance) : 1.0f;
    const bool near = aur_continuation_is_near(&plan->continuation, query->ray.tfar[lane], map_light.area);
    if (!near && !(plan->continuation.share > 0.0f &&
                   aur_continuation_is_due(&plan->continuation, aur_gather_rays_hash(rays, lane))))
        return aur_vector_scale(
            aur_vector_add(aur_continuation_uncorrected(&plan->continuation, map_light.radiance),
                           map_light.caustics),
            weight);
    const aur_ray ray = aur_packet_ray(&rays->packet, lane);
    const aur_hit hit = aur_packet_hit(plan->scene, &rays->packet, lane);
    aur_continuation_start *const start = &rays->paths.starts[rays->paths.count];
    aur_scene_surface(plan->scene, &ray, &hit, &start->surface);
    start->view = aur_vector_scale(ray.direction, -1.0f);
    start->edges = 2;
    start->hash = aur_gather_rays_hash(rays, lane);
    start->near = near;
    start->map_radiance = map_light.radiance;
    wait_for_path(plan, lane, (aur_vector){weight, weight, weight}, rays);
    return aur_vector_scale(map_light.caustics, weight);
}

/* The lanes whose radiance is read from the map without evaluating their surface. */
static uint32_t plain_lanes(const aur_gather_plan *plan, const aur_packet *packet, uint32_t found) {
    uint32_t plain = 0;
    for (uint32_t rest = plan->light.map != NULL ? found : 0; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const struct RTCHit16 *const hits = &packet->query.hit;
        if (hits->instID[0][lane] == RTC_INVALID_GEOMETRY_ID && plan->classes[hits->geomID[lane]].plain)
            plain |= 1u << lane;
    }
    return plain;
}

/* --- what is read of the sixteen hits comes from memory together */

/* Sets texels, and fetches their light. */
static void find_texels(const aur_irradiance_map *map, const aur_scene *scene, const aur_packet *packet,
                        gather_hits *all) {
    const struct RTCHit16 *const hits = &packet->query.hit;
    for (uint32_t rest = all->plain; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        all->element[lane] = map->texels.elements.shape_first[hits->geomID[lane]] + hits->primID[lane];
        __builtin_prefetch(&map->texels.ranges[all->element[lane]]);
    }
    for (uint32_t rest = all->found & ~all->plain; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_hit hit = aur_packet_hit(scene, packet, lane);
        all->element[lane] = aur_element_of(&map->texels.elements, &hit);
        __builtin_prefetch(&map->texels.ranges[all->element[lane]]);
    }
    for (uint32_t rest = all->found; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        all->texel[lane] =
            aur_texel_of_triangle(map->texels.ranges[all->element[lane]], hits->u[lane], hits->v[lane]);
        const size_t light = 2 * (size_t)all->texel[lane];
        __builtin_prefetch(&map->lights[light]);
        if (map->member_first != NULL)
            __builtin_prefetch(&map->member_first[light]);
    }
}

/* Draws a point on a light for each surface that needs one. */
static void draw_lights(const aur_gather_plan *plan, const aur_gather_rays *rays, gather_hits *all) {
    if ((all->found & ~all->plain) == 0)
        return;
    aur_lane_vectors positions = {0}, normals = {0};
    aur_lane_numbers choice = {0}, u = {0}, v = {0};
    uint32_t drawn = 0;
    for (uint32_t rest = all->found & ~all->plain; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_vector direction = aur_packet_ray(&rays->packet, k).direction;
        const aur_shading shading = aur_shading_at(&all->surfaces[k], aur_vector_scale(direction, -1.0f));
        if (!samples_lights(plan, aur_bsdf_scatters(all->surfaces[k].bsdf, shading.view.z), 0))
            continue;
        const aur_light_reference reference = aur_shading_reference(&shading);
        float units[3];
        all->hash[k] = aur_gather_rays_hash(rays, k);
        aur_draw_units(&all->hash[k], units);
        aur_lane_set(&positions, k, reference.position);
        aur_lane_set(&normals, k, reference.normal);
        choice[k] = units[0];
        u[k] = units[1];
        v[k] = units[2];
        drawn |= 1u << k;
    }
    const aur_light_references references = {&positions, &normals};
    if (drawn != 0)
        aur_light_lanes_each(plan->scene, drawn, &references, choice, u, v, &all->lights);
}

static void find_hits(const aur_gather_plan *plan, const aur_packet *packet, gather_hits *all) {
    const uint32_t others = all->found & ~all->plain;
    aur_packet_prefetch_indices(plan->scene, packet, others);
    aur_packet_prefetch_vertices(plan->scene, packet, others);
    if (plan->light.map != NULL)
        find_texels(plan->light.map, plan->scene, packet, all);
    for (uint32_t rest = others; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_ray ray = aur_packet_ray(packet, lane);
        all->hits[lane] = aur_packet_hit(plan->scene, packet, lane);
        aur_scene_surface(plan->scene, &ray, &all->hits[lane], &all->surfaces[lane]);
        aur_surface_prefetch(plan->scene, &all->surfaces[lane]);
    }
}

void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters) {
    const uint32_t lanes = aur_lanes_set(rays->packet.valid);
    gather_hits all;
    all.found = aur_gather_intersect(plan, order, &rays->packet);
    all.plain = plain_lanes(plan, &rays->packet, all.found);
    const bool has_sky = aur_scene_has_environment(plan->scene);
    find_hits(plan, &rays->packet, &all);
    draw_lights(plan, rays, &all);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            rays->radiance[c][k] = 0.0f;
    for (uint32_t rest = has_sky ? lanes : all.found; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const bool hits = aur_has_lane(all.found, lane);
        aur_vector radiance;
        if (aur_has_lane(all.plain, lane)) {
            radiance = plain_radiance(plan, lane, all.element[lane], all.texel[lane], rays);
        } else {
            /* The density is needed only for light that is sampled too. */
            const bool weighed = !hits || plan->classes[rays->packet.query.hit.geomID[lane]].emits;
            const aur_bounce bounce = {.from = rays->reference[lane],
                                       .pdf = weighed ? rays->density[lane] : 0.0f,
                                       .light_samples = (float)plan->light.draws};
            const gather_chain chain = {.path = {.beta = {1.0f, 1.0f, 1.0f},
                                                 .ray = aur_packet_ray(&rays->packet, lane),
                                                 .bounce = bounce},
                                        .lane = lane,
                                        .hash = aur_gather_rays_hash(rays, lane),
                                        .specular = true};
            radiance = chain_radiance(plan, chain, &all, rays, counters);
        }
        rays->radiance[0][lane] += radiance.x;
        rays->radiance[1][lane] += radiance.y;
        rays->radiance[2][lane] += radiance.z;
    }
}
