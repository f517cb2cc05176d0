/* Where a gather ray meets a plainly diffuse surface, its radiance is one read of the irradiance map. At
 * every other one it finds the light that the surface emits, what the photon maps know of the light that it
 * scatters, and, by lobes that they do not answer for - mirrors, glass, rough facets -, light drawn from the
 * lights; and it goes on by one of those lobes. */
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

/* --- a ray that goes on */

/* The ray, and how it came to where it is. */
typedef struct gather_chain {
    aur_ray ray;
    size_t lane;                   /* of the gather ray */
    uint64_t hash;                 /* of what chance decides on its way */
    uint32_t length;               /* bounces since the gathering point */
    bool specular;                 /* all of them */
    bool mirrored;                 /* the last one: lights are not sampled for it */
    aur_light_reference reference; /* where the ray began */
    float length_seen;             /* of the rays from the last place that scattered other than as a mirror */
    float density;                 /* with which its direction was drawn, a steradian, times how often */
    float light_draws;             /* points on lights that were drawn there */
} gather_chain;

/* A draw of the lobes that the photon map does not answer for; light in world coordinates. */
static bool draw_onward(const aur_shading *shading, unsigned kinds, const float u[3],
                        aur_bsdf_sample *drawn) {
    if ((kinds & AUR_SCATTERS_SPECULAR) == 0)
        return aur_shading_draw(shading, AUR_BSDF_SAMPLED_LOBES, u, drawn);
    if (!aur_shading_sample(shading, u, drawn))
        return false;
    if (drawn->specular || (kinds & AUR_SCATTERS_SAMPLED) == 0)
        return drawn->specular;
    const aur_surface *const surface = shading->surface;
    const aur_vector light = aur_frame_to_local(&surface->frame, drawn->light);
    float pdf;
    const aur_vector value = aur_bsdf_evaluate(surface->bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture,
                                               shading->view, light, &pdf);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

/* The light that a surface emits along the ray, or the sky where there is none: the part of it that the ray
 * counts. The rest is found by sampling the light. */
static aur_vector emitted_radiance(const aur_gather_plan *plan, const gather_chain *chain,
                                   const aur_surface *surface) {
    const aur_vector direction = chain->ray.direction, black = {0};
    if (plan->policy.direct != AUR_DIRECT_NEE && !plan->counts_emitters)
        return black;
    float pdf = 0.0f;
    const aur_vector emission =
        surface != NULL ? aur_surface_emission(plan->scene, surface, aur_vector_scale(direction, -1.0f))
                        : aur_environment_light(plan->scene, direction, &pdf);
    if (aur_vector_is_zero(emission) || plan->counts_emitters)
        return emission;
    /* Light that a mirror throws here is found by caustic photons, if there are. */
    if (chain->mirrored)
        return plan->light.caustics != NULL && chain->specular ? black : emission;
    if (surface != NULL)
        pdf = aur_light_pdf_direct(plan->scene, &chain->reference, surface);
    return aur_vector_scale(emission, aur_power_heuristic(chain->density, chain->light_draws * pdf));
}

/* Paths in place of what the map knows: they wait until there are sixteen, or all rays have been looked at.
 */
typedef struct waiting_paths {
    size_t count;
    aur_onward_start starts[AUR_PACKET_SIZE];
    aur_vector weights[AUR_PACKET_SIZE]; /* of their light in that of the ray */
    size_t lanes[AUR_PACKET_SIZE];
} waiting_paths;

/* Adds their light to that of the rays. */
static void walk_paths(const aur_gather_plan *plan, waiting_paths *waiting, aur_gather_rays *rays) {
    aur_vector radiance[AUR_PACKET_SIZE];
    if (waiting->count > 0)
        aur_onward_correct(&plan->onward, waiting->count, waiting->starts, radiance);
    for (size_t i = 0; i < waiting->count; ++i) {
        const aur_vector added = aur_vector_multiply(waiting->weights[i], radiance[i]);
        const size_t lane = waiting->lanes[i];
        rays->radiance[0][lane] += added.x;
        rays->radiance[1][lane] += added.y;
        rays->radiance[2][lane] += added.z;
    }
    waiting->count = 0;
}

/* The path whose start is the next one waits, too. */
static void wait_for_path(const aur_gather_plan *plan, size_t lane, aur_vector weight, waiting_paths *waiting,
                          aur_gather_rays *rays) {
    waiting->weights[waiting->count] = weight;
    waiting->lanes[waiting->count++] = lane;
    if (waiting->count == AUR_PACKET_SIZE)
        walk_paths(plan, waiting, rays);
}

/* The light that leaves a surface by what the photon maps know. Where a path is to say it, what is left is
 * what the path begins with: true. */
static bool scattered_radiance(const aur_gather_plan *plan, const gather_chain *chain, const aur_hit *hit,
                               const aur_surface *surface, aur_vector view, aur_vector *radiance,
                               aur_onward_start *start) {
    bool waits = false;
    *radiance = (aur_vector){0};
    if (plan->light.map != NULL) {
        const aur_texel_view known = aur_irradiance_view(plan->light.map, plan->scene, hit, surface, view);
        const uint64_t hash = aur_hash2(chain->hash, chain->length);
        const bool near = aur_onward_is_near(&plan->onward, chain->length_seen + hit->distance, known.area);
        waits = near || aur_onward_is_due(&plan->onward, hash);
        if (waits)
            *start = (aur_onward_start){*surface, view, chain->length + 2, hash, near, known.radiance};
        else
            *radiance = aur_onward_kept(&plan->onward, known.radiance);
    }
    if (plan->light.caustics != NULL)
        *radiance = aur_vector_add(
            *radiance, aur_irradiance_view(plan->light.caustics, plan->scene, hit, surface, view).radiance);
    return waits;
}

/* Weak reflections are followed now and then, so many times as often as they are strong. */
static const float BOOST = 8.0f;

/* A point on a light, reflected by the sampled lobe, weighed beside the ray that goes on. What is weak beside
 * the radiance `known` of the surface is asked for now and then. */
static aur_vector sampled_light(const aur_gather_plan *plan, const aur_shading *shading, unsigned kinds,
                                aur_vector known, uint64_t *hash) {
    const aur_vector black = {0};
    const aur_surface *const surface = shading->surface;
    float u[3];
    aur_light_sample light;
    aur_draw_units(hash, u);
    if (!aur_shading_draw_light(plan->scene, shading, u, &light) || !(light.pdf > 0.0f))
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
    if ((kinds & AUR_SCATTERS_SPECULAR) != 0)
        aur_bsdf_evaluate(bsdf, AUR_BSDF_WHOLE, surface->texture, shading->view, local, &rival);
    const float weight = light.delta ? 1.0f : aur_power_heuristic(light.pdf, rival);
    const aur_vector radiance =
        aur_vector_scale(aur_vector_multiply(value, light.radiance), weight / light.pdf);
    const float strength = aur_vector_max(radiance);
    const float survival = fminf(1.0f, BOOST * strength / (strength + aur_vector_max(known)));
    if (!(aur_draw_unit(hash) < survival))
        return black;
    float distance;
    const aur_ray shadow = aur_surface_ray_to(surface, light.position, &distance);
    return aur_scene_occluded(plan->scene, &shadow) ? black : aur_vector_scale(radiance, 1.0f / survival);
}

/* `hit` is the ray's first one, or NULL when it left the scene. */
static aur_vector chain_radiance(const aur_gather_plan *plan, gather_chain chain, const aur_hit *hit,
                                 waiting_paths *waiting, aur_gather_rays *rays, aur_counters *counters) {
    const aur_scene *const scene = plan->scene;
    const bool samples_lights =
        plan->policy.direct == AUR_DIRECT_NEE && !plan->counts_emitters && aur_scene_emitter_count(scene) > 0;
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_hit next;
    for (;; ++chain.length) {
        if (hit == NULL) {
            const aur_vector sky = emitted_radiance(plan, &chain, NULL);
            return aur_vector_add(sum, aur_vector_multiply(throughput, sky));
        }
        aur_surface surface;
        aur_scene_surface(scene, &chain.ray, hit, &surface);
        const aur_vector view = aur_vector_scale(chain.ray.direction, -1.0f);
        const aur_shading shading = aur_shading_at(&surface, view);
        const unsigned kinds = aur_bsdf_scatters(surface.bsdf, shading.view.z);
        aur_vector radiance = emitted_radiance(plan, &chain, &surface), known = {0};
        aur_onward_start *const start = &waiting->starts[waiting->count];
        /* Two edges led here, and one for each link of the chain; a photon came by one more at least. */
        const bool deeper = chain.length + 3 <= plan->policy.max_depth;
        if ((kinds & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0 && deeper) {
            aur_vector scattered;
            if (scattered_radiance(plan, &chain, hit, &surface, view, &scattered, start)) {
                known = aur_vector_add(known, start->known);
                wait_for_path(plan, chain.lane, throughput, waiting, rays);
            }
            radiance = aur_vector_add(radiance, scattered);
        }
        if ((kinds & AUR_SCATTERS_SAMPLED) != 0 && deeper && samples_lights)
            radiance = aur_vector_add(
                radiance, sampled_light(plan, &shading, kinds, aur_vector_add(radiance, known), &chain.hash));
        sum = aur_vector_add(sum, aur_vector_multiply(throughput, radiance));
        if ((kinds & (AUR_SCATTERS_SPECULAR | AUR_SCATTERS_SAMPLED)) == 0 || !deeper)
            return sum;
        float u[3];
        aur_bsdf_sample drawn;
        aur_draw_units(&chain.hash, u);
        if (!draw_onward(&shading, kinds, u, &drawn))
            return sum;
        throughput = aur_vector_multiply(throughput, drawn.weight);
        const float survival = fminf(1.0f, BOOST * aur_vector_max(throughput));
        if (!(aur_draw_unit(&chain.hash) < survival))
            return sum;
        if (chain.length == AUR_LONGEST_CHAIN) {
            ++counters->cut;
            return sum;
        }
        throughput = aur_vector_scale(throughput, 1.0f / survival);
        chain.specular = chain.specular && drawn.specular;
        chain.mirrored = drawn.specular;
        chain.length_seen = drawn.specular ? chain.length_seen + hit->distance : 0.0f;
        chain.reference = aur_shading_reference(&shading);
        chain.density = drawn.pdf;
        chain.light_draws = 1.0f;
        chain.ray = aur_surface_ray(&surface, drawn.light);
        hit = aur_scene_intersect(scene, &chain.ray, &next) ? &next : NULL;
    }
}

/* --- sixteen rays */

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
    const float texel = aur_bright_texels_density(plan->light.bright, known);
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

/* Of a surface that is diffuse, without emission, in no instance: what the map knows, or a path where the
 * texel is near or the map is corrected. */
static aur_vector plain_radiance(const aur_gather_plan *plan, size_t lane, waiting_paths *waiting,
                                 aur_gather_rays *rays) {
    const struct RTCRayHit16 *const query = &rays->packet.query;
    const uint32_t shape = query->hit.geomID[lane];
    const bool behind = query->hit.Ng_x[lane] * query->ray.dir_x[lane] +
                            query->hit.Ng_y[lane] * query->ray.dir_y[lane] +
                            query->hit.Ng_z[lane] * query->ray.dir_z[lane] >
                        0.0f;
    const uint32_t element = plan->light.map->texels.elements.shape_first[shape] + query->hit.primID[lane];
    const aur_gather_known known =
        aur_gather_plan_known(plan, shape, element, query->hit.u[lane], query->hit.v[lane], behind);
    const float weight =
        plan->light.bright_draws > 0 ? bright_weight(plan, rays, lane, known.radiance) : 1.0f;
    const uint64_t hash = aur_gather_rays_hash(rays, lane);
    const bool near = aur_onward_is_near(&plan->onward, query->ray.tfar[lane], known.area);
    if (!near && !aur_onward_is_due(&plan->onward, hash))
        return aur_vector_scale(
            aur_vector_add(aur_onward_kept(&plan->onward, known.radiance), known.caustics), weight);
    const aur_ray ray = aur_packet_ray(&rays->packet, lane);
    const aur_hit hit = aur_packet_hit(plan->scene, &rays->packet, lane);
    aur_onward_start *const start = &waiting->starts[waiting->count];
    aur_scene_surface(plan->scene, &ray, &hit, &start->surface);
    start->view = aur_vector_scale(ray.direction, -1.0f);
    start->edges = 2;
    start->hash = hash;
    start->near = near;
    start->known = known.radiance;
    wait_for_path(plan, lane, (aur_vector){weight, weight, weight}, waiting, rays);
    return aur_vector_scale(known.caustics, weight);
}

/* The lanes whose light is read from the map without a look at their surface. */
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

static const aur_texel_range *range_of(const aur_irradiance_map *map, const aur_hit *hit) {
    return &map->texels.ranges[aur_element_of(&map->texels.elements, hit)];
}

/* Of curved shapes another texel of the element. */
static size_t light_of(const aur_irradiance_map *map, const aur_hit *hit) {
    return 2 * (size_t)aur_texel_of_triangle(*range_of(map, hit), hit->u, hit->v);
}

static void prefetch_lights(const aur_irradiance_map *map, const aur_scene *scene, const aur_packet *packet,
                            uint32_t found) {
    for (uint32_t rest = found; rest != 0; rest &= rest - 1) {
        const aur_hit hit = aur_packet_hit(scene, packet, aur_first_lane(rest));
        const size_t light = light_of(map, &hit);
        __builtin_prefetch(&map->lights[light]);
        if (map->member_first != NULL)
            __builtin_prefetch(&map->member_first[light]);
    }
}

static void prefetch(const aur_gather_plan *plan, const aur_packet *packet, uint32_t found, uint32_t plain) {
    const aur_irradiance_map *const map = plan->light.map;
    aur_packet_prefetch_indices(plan->scene, packet, found & ~plain);
    for (uint32_t rest = map != NULL ? found : 0; rest != 0; rest &= rest - 1) {
        const aur_hit hit = aur_packet_hit(plan->scene, packet, aur_first_lane(rest));
        __builtin_prefetch(range_of(map, &hit));
    }
    aur_packet_prefetch_vertices(plan->scene, packet, found & ~plain);
    if (map != NULL)
        prefetch_lights(map, plan->scene, packet, found);
}

void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters) {
    const uint32_t lanes = aur_lanes_set(rays->packet.valid);
    const uint32_t found = aur_gather_intersect(plan, order, &rays->packet);
    const bool has_sky = aur_scene_has_environment(plan->scene);
    const uint32_t plain = plain_lanes(plan, &rays->packet, found);
    waiting_paths waiting;
    waiting.count = 0;
    prefetch(plan, &rays->packet, found, plain);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            rays->radiance[c][k] = 0.0f;
    for (uint32_t rest = has_sky ? lanes : found; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const bool hits = aur_has_lane(found, lane);
        aur_vector radiance;
        if (aur_has_lane(plain, lane)) {
            radiance = plain_radiance(plan, lane, &waiting, rays);
        } else {
            /* Only light that is sampled too asks for the density. */
            const bool weighed = !hits || plan->classes[rays->packet.query.hit.geomID[lane]].emits;
            const gather_chain chain = {.ray = aur_packet_ray(&rays->packet, lane),
                                        .lane = lane,
                                        .hash = aur_gather_rays_hash(rays, lane),
                                        .specular = true,
                                        .reference = rays->reference[lane],
                                        .density = weighed ? density_of(rays, lane) : 0.0f,
                                        .light_draws = (float)plan->light.draws};
            aur_hit hit = {0};
            if (hits)
                hit = aur_packet_hit(plan->scene, &rays->packet, lane);
            radiance = chain_radiance(plan, chain, hits ? &hit : NULL, &waiting, rays, counters);
        }
        rays->radiance[0][lane] += radiance.x;
        rays->radiance[1][lane] += radiance.y;
        rays->radiance[2][lane] += radiance.z;
    }
    walk_paths(plan, &waiting, rays);
}
