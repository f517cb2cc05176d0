#include "render/gather/continuation.h"

#include "points/base/random.h"
#include "render/trace/packet_rays.h"
#include "render/vertex/vertex.h"

typedef struct continuation_walk {
    aur_walk path;
    uint64_t hash;
    bool estimated; /* the map has estimated the rest of the path; estimated_sum is the sum at that point */
    aur_vector estimated_sum;
} continuation_walk;

/* Adds the emission that the ray hits; `surface` NULL: the sky. Emission behind mirrors belongs to the
 * caustic map. */
static void add_emission(const aur_continuation *continuation, const aur_surface *surface,
                         continuation_walk *walk) {
    if (!walk->path.bounce.specular_bounce || continuation->caustics == NULL)
        aur_walk_add_emission(continuation->scene, surface, &walk->path);
}

/* Russian roulette. If the map covers all scattering of the surface, it is the control variate: a path that
 * ends adds the map's estimate of the rest, and a path that continues subtracts it in proportion. */
static bool survives(const aur_continuation *continuation, const aur_hit *hit, const aur_shading *shading,
                     aur_vector view, continuation_walk *walk) {
    const float map_survival = continuation->share > 0.0f ? 0.5f : 0.0f;
    const unsigned kinds = aur_bsdf_scatters(shading->surface->bsdf, shading->view.z);
    aur_texel_view texel = {0};
    bool estimated = (kinds & (AUR_SCATTERS_SPECULAR | AUR_SCATTERS_SAMPLED)) == 0;
    if (estimated) {
        texel = aur_irradiance_view(continuation->map, continuation->scene, hit, shading->surface, view);
        estimated = !aur_continuation_is_near(continuation, hit->distance, texel.area);
    }
    const float survival = estimated ? map_survival : aur_survival(walk->path.beta);
    aur_vector estimate = {0};
    if (estimated)
        estimate = aur_vector_multiply(walk->path.beta, texel.radiance);
    walk->path.radiance = aur_vector_add(walk->path.radiance, estimate);
    if (continuation->caustics != NULL) {
        const aur_texel_view caustic =
            aur_irradiance_view(continuation->caustics, continuation->scene, hit, shading->surface, view);
        walk->path.radiance =
            aur_vector_add(walk->path.radiance, aur_vector_multiply(walk->path.beta, caustic.radiance));
    }
    if (estimated && !walk->estimated) {
        walk->estimated = true;
        walk->estimated_sum = walk->path.radiance;
    }
    if (!aur_vertex_survives(survival, aur_draw_unit(&walk->hash), &walk->path.beta))
        return false;
    walk->path.radiance = aur_vector_add_scaled(walk->path.radiance, -1.0f / survival, estimate);
    return true;
}

/* --- sixteen paths, bounce by bounce */

typedef struct continuation_walks {
    const aur_continuation *continuation;
    uint32_t alive;
    aur_vertex_lobes
        lobes; /* of each path's current surface: at the first one the lobes that the map covers, then all */
    continuation_walk walk[AUR_PACKET_SIZE];
    aur_surface surfaces[AUR_PACKET_SIZE];
    aur_vector view[AUR_PACKET_SIZE];
    uint32_t edges[AUR_PACKET_SIZE];
    aur_packet packet;
} continuation_walks;

/* Few rays are traced one by one: a packet would be nearly empty. */
static bool is_packet(const aur_continuation *continuation, uint32_t lanes) {
    return continuation->packets && aur_lane_count(lanes) >= AUR_PACKET_SIZE / 4;
}

/* A point on a light for each path. */
static void draw_lights(continuation_walks *walks, aur_light_lanes *lights) {
    aur_lane_vectors positions = {0}, normals = {0};
    aur_lane_numbers choice = {0}, u = {0}, v = {0};
    for (uint32_t rest = walks->alive; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_shading shading = aur_shading_at(&walks->surfaces[k], walks->view[k]);
        const aur_light_reference reference = aur_shading_reference(&shading);
        float units[3];
        aur_draw_units(&walks->walk[k].hash, units);
        aur_lane_set(&positions, k, reference.position);
        aur_lane_set(&normals, k, reference.normal);
        choice[k] = units[0];
        u[k] = units[1];
        v[k] = units[2];
    }
    const aur_light_references references = {&positions, &normals};
    aur_light_lanes_each(walks->continuation->scene, walks->alive, &references, choice, u, v, lights);
}

static void add_direct_light(continuation_walks *walks) {
    const aur_scene *const scene = walks->continuation->scene;
    aur_vector radiance[AUR_PACKET_SIZE];
    aur_light_lanes lights;
    uint32_t lit = 0;
    if (aur_scene_emitter_count(scene) == 0)
        return;
    draw_lights(walks, &lights);
    aur_packet_empty(&walks->packet);
    for (uint32_t rest = walks->alive; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_shading shading = aur_shading_at(&walks->surfaces[k], walks->view[k]);
        const aur_light_sample light = aur_light_lane(&lights, k);
        aur_shadow shadow;
        if (!aur_vertex_light(&shading, walks->lobes, AUR_VERTEX_ONE_EACH, &light, &shadow))
            continue;
        radiance[k] = shadow.radiance;
        aur_packet_set(&walks->packet, k, &shadow.ray);
        lit |= 1u << k;
    }
    if (lit == 0)
        return;
    lit &= ~(is_packet(walks->continuation, lit)
                 ? aur_scene_occluded16(scene, AUR_EMBREE_INCOHERENT, &walks->packet)
                 : aur_scene_occluded_each(scene, &walks->packet));
    for (uint32_t rest = lit; rest != 0; rest &= rest - 1) {
        aur_walk *const path = &walks->walk[aur_first_lane(rest)].path;
        path->radiance =
            aur_vector_add(path->radiance, aur_vector_multiply(path->beta, radiance[aur_first_lane(rest)]));
    }
}

/* Traces the active rays; returns the lanes that hit a surface. */
static uint32_t trace(continuation_walks *walks) {
    const aur_scene *const scene = walks->continuation->scene;
    aur_packet_empty(&walks->packet);
    for (uint32_t rest = walks->alive; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_shading shading = aur_shading_at(&walks->surfaces[k], walks->view[k]);
        float u[3];
        aur_draw_units(&walks->walk[k].hash, u);
        if (aur_walk_scatter(&shading, walks->lobes, u, &walks->walk[k].path))
            aur_packet_set(&walks->packet, k, &walks->walk[k].path.ray);
        else
            walks->alive &= ~(1u << k);
    }
    if (walks->alive == 0)
        return 0;
    return is_packet(walks->continuation, walks->alive)
               ? aur_scene_intersect16(scene, AUR_EMBREE_INCOHERENT, &walks->packet)
               : aur_scene_intersect_each(scene, &walks->packet);
}

/* Computes the surfaces that the paths hit. What is read of them comes from memory together. */
static void find_surfaces(continuation_walks *walks, uint32_t found) {
    const aur_scene *const scene = walks->continuation->scene;
    aur_packet_prefetch_indices(scene, &walks->packet, found);
    for (uint32_t rest = found; rest != 0; rest &= rest - 1) {
        const aur_hit hit = aur_packet_hit(scene, &walks->packet, aur_first_lane(rest));
        const aur_texels *const texels = &walks->continuation->map->texels;
        __builtin_prefetch(&texels->ranges[aur_element_of(&texels->elements, &hit)]);
    }
    aur_packet_prefetch_vertices(scene, &walks->packet, found);
    for (uint32_t rest = found; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_hit hit = aur_packet_hit(scene, &walks->packet, k);
        aur_scene_surface(scene, &walks->walk[k].path.ray, &hit, &walks->surfaces[k]);
        aur_surface_prefetch(scene, &walks->surfaces[k]);
        walks->view[k] = aur_vector_scale(walks->walk[k].path.ray.direction, -1.0f);
    }
}

/* Adds the light of the surface that a path hits; false if the path ends there. */
static bool visit_surface(continuation_walks *walks, size_t k) {
    const aur_continuation *const continuation = walks->continuation;
    continuation_walk *const walk = &walks->walk[k];
    add_emission(continuation, &walks->surfaces[k], walk);
    if (++walks->edges[k] >= continuation->max_depth)
        return false;
    const aur_hit hit = aur_packet_hit(continuation->scene, &walks->packet, k);
    const aur_shading shading = aur_shading_at(&walks->surfaces[k], walks->view[k]);
    return survives(continuation, &hit, &shading, walks->view[k], walk);
}

static void bounce(continuation_walks *walks) {
    add_direct_light(walks);
    const uint32_t found = trace(walks);
    find_surfaces(walks, found);
    for (uint32_t rest = walks->alive; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        if (!aur_has_lane(found, k))
            add_emission(walks->continuation, NULL, &walks->walk[k]);
        if (!aur_has_lane(found, k) || !visit_surface(walks, k))
            walks->alive &= ~(1u << k);
    }
}

static aur_vector corrected(const aur_continuation *continuation, const aur_continuation_start *start,
                            const continuation_walk *walk) {
    if (start->near && continuation->single)
        return walk->estimated ? aur_vector_subtract(walk->path.radiance, walk->estimated_sum)
                               : (aur_vector){0};
    if (start->near)
        return walk->path.radiance;
    return aur_vector_add_scaled(aur_continuation_uncorrected(continuation, start->map_radiance),
                                 1.0f / continuation->share,
                                 aur_vector_subtract(walk->path.radiance, start->map_radiance));
}

void aur_continuation_correct(const aur_continuation *continuation, size_t count,
                              const aur_continuation_start *starts, aur_vector *radiance) {
    continuation_walks walks;
    walks.continuation = continuation;
    walks.alive = 0;
    aur_packet_clear(&walks.packet);
    for (size_t k = 0; k < count; ++k) {
        walks.walk[k] =
            (continuation_walk){.path = {.beta = {1.0f, 1.0f, 1.0f}}, .hash = aur_mix64(~starts[k].hash)};
        walks.surfaces[k] = starts[k].surface;
        walks.view[k] = starts[k].view;
        walks.edges[k] = starts[k].edges;
        if (starts[k].edges < continuation->max_depth)
            walks.alive |= 1u << k;
    }
    for (walks.lobes = AUR_VERTEX_MAPPED; walks.alive != 0; walks.lobes = AUR_VERTEX_ALL)
        bounce(&walks);
    for (size_t k = 0; k < count; ++k)
        radiance[k] = corrected(continuation, &starts[k], &walks.walk[k]);
}
