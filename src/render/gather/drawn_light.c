#include "render/gather/estimators.h"
#include "render/vertex/vertex.h"

/* BSDF * cos towards a light, with each lobe's MIS weight against its gather rays. */
static aur_vector weighted_value(const aur_gather_plan *plan, const aur_gather_point *surface_point,
                                 const aur_light_sample *light) {
    const aur_surface *const surface = &surface_point->surface;
    const aur_vector local = aur_frame_to_local(&surface->frame, light->direction);
    if (aur_vector_dot(surface->geometric_normal, light->direction) * local.z <= 0.0f)
        return (aur_vector){0};
    aur_vector sum = {0};
    for (size_t i = 0; i < surface_point->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &surface_point->lobes[i];
        if (aur_vector_is_zero(lobe->coefficient))
            continue;
        aur_vector value = {0};
        float density = 0.0f;
        if (lobe->shape == AUR_LOBE_SHAPE_SAMPLED) {
            value = aur_bsdf_evaluate(surface->bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture,
                                      surface_point->view, local, &density);
            density *= plan->rules.sampled.directions;
        } else if (lobe->shape == AUR_LOBE_SHAPE_COSINE_POWER && surface_point->view.z * local.z > 0.0f) {
            value = aur_lobe_value(lobe, local);
            const aur_gather_lobe_rule *const rule = surface_point->rules[i];
            if (surface_point->paired)
                density = aur_gather_point_pair_density(plan, surface_point, local);
            else if (!aur_vector_is_zero(value))
                density = aur_gather_rule_density(&rule->rule, aur_vector_dot(lobe->axis, local)) *
                          rule->directions;
        }
        const bool gathers = aur_gather_plan_gathers(plan, lobe);
        sum = aur_vector_add_scaled(
            sum, gathers ? aur_light_weight(light, AUR_VERTEX_ONE_EACH, density) : 1.0f, value);
    }
    return sum;
}

/* Adds one light sample per lane if it is unoccluded; the pdfs count all draws of a sample. */
static void add_lights(const aur_gather_points *surface_points, aur_embree_order order,
                       const aur_light_lanes *lights, aur_gather_sums *sums) {
    aur_packet *const packet = &sums->rays.packet;
    aur_vector radiance[AUR_PACKET_SIZE];
    uint32_t aimed = 0;
    aur_packet_empty(packet);
    for (uint32_t rest = surface_points->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_point *const surface_point = &surface_points->at[lane];
        const aur_light_sample light = aur_light_lane(lights, lane);
        if (!(light.pdf > 0.0f))
            continue;
        aur_shadow shadow;
        if (!aur_vertex_shadow(&surface_point->surface, &light,
                               weighted_value(surface_points->plan, surface_point, &light), 1.0f, &shadow))
            continue;
        radiance[lane] = shadow.radiance;
        aur_packet_set(packet, lane, &shadow.ray);
        aimed |= 1u << lane;
    }
    if (aimed == 0)
        return;
    const uint32_t lit = aimed & ~aur_gather_occluded(surface_points->plan, order, packet);
    for (uint32_t rest = lit; rest != 0; rest &= rest - 1)
        aur_gather_add(sums, surface_points, aur_first_lane(rest), radiance[aur_first_lane(rest)]);
}

/* Sets the directions from the reference points, and the pdfs of all draws. */
static void complete(const aur_lane_vectors *position, float draws, aur_light_lanes *lights) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float x = lights->position.x[k] - position->x[k], y = lights->position.y[k] - position->y[k];
        const float z = lights->position.z[k] - position->z[k];
        const float length = sqrtf(x * x + y * y + z * z);
        const float scale = length > 0.0f ? 1.0f / length : 1.0f;
        lights->direction.x[k] = x * scale;
        lights->direction.y[k] = y * scale;
        lights->direction.z[k] = z * scale;
        lights->pdf[k] *= draws;
    }
}

void aur_gather_add_direct_light(const aur_gather_points *surface_points, aur_gather_sums *sums) {
    const aur_gather_plan *const plan = surface_points->plan;
    /* Lanes without a shading point take the position of the first lane; their samples are discarded. */
    aur_lane_vectors position, normal;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        const size_t from =
            aur_has_lane(surface_points->lanes, lane) ? lane : aur_first_lane(surface_points->lanes);
        const aur_light_reference reference = aur_gather_point_reference(&surface_points->at[from]);
        aur_lane_set(&position, lane, reference.position);
        aur_lane_set(&normal, lane, reference.normal);
    }
    const aur_light_references references = {&position, &normal};
    const bool chooses = aur_light_chooses(plan->scene);
    const uint32_t pair = aur_gather_first_pair(surface_points->bounces), draws = plan->light.draws;
    aur_light_lanes lights = {0};
    for (uint32_t k = 0; k < draws; ++k) {
        uint32_t index[AUR_PACKET_SIZE];
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
            index[lane] = surface_points->index[lane] * draws + k;
        float choice[AUR_PACKET_SIZE], unused[AUR_PACKET_SIZE], u[AUR_PACKET_SIZE], v[AUR_PACKET_SIZE];
        if (chooses)
            aur_stream_samples(surface_points->sampler, AUR_PACKET_SIZE, surface_points->pixels, index,
                               pair + AUR_GATHER_PAIR_CHOICE, choice, unused);
        aur_stream_samples(surface_points->sampler, AUR_PACKET_SIZE, surface_points->pixels, index,
                           pair + AUR_GATHER_PAIR_POSITION, u, v);
        aur_light_lanes_direct(plan->scene, surface_points->lanes, &references, choice, u, v, &lights);
        complete(&position, (float)draws, &lights);
        add_lights(surface_points, surface_points->order, &lights, sums);
    }
}

/* A point on a bright texel as a light sample seen from `position`; `hash` seeds the path that corrects it.
 */
static aur_light_sample light_from(const aur_gather_plan *plan, const aur_bright_point *point,
                                   aur_vector position, uint64_t hash) {
    const aur_gather_light *const from = &plan->light;
    const uint32_t texel =
        aur_texel_of_triangle(from->map->texels.ranges[point->element], point->u, point->v);
    const aur_photon_radiance map_light =
        aur_gather_plan_photons(plan, point->shape, point->element, texel, point->u, point->v, point->behind);
    aur_vector radiance = map_light.radiance;
    const aur_vector offset = aur_vector_subtract(point->position, position);
    const float square = aur_vector_dot(offset, offset);
    const aur_vector direction = aur_vector_scale(offset, 1.0f / sqrtf(square));
    const float cosine = -aur_vector_dot(direction, point->normal);
    aur_light_sample sample = {
        .position = aur_surface_target(position, point->position, point->normal, point->rounding),
        .direction = direction};
    if (cosine > 0.0f && square > 0.0f) {
        sample.pdf = aur_bright_texels_density(from->bright, map_light.radiance) * (float)from->bright_draws *
                     square / cosine;
        const bool near = aur_continuation_is_near(&plan->continuation, sqrtf(square), map_light.area);
        if (!near && !aur_continuation_is_due(&plan->continuation, hash)) {
            radiance = aur_continuation_uncorrected(&plan->continuation, radiance);
        } else {
            const aur_ray ray = {position, 0.0f, direction, INFINITY};
            const aur_hit hit = {.distance = sqrtf(square),
                                 .u = point->u,
                                 .v = point->v,
                                 .shape = point->shape,
                                 .primitive = point->primitive,
                                 .instance = AUR_NO_INSTANCE};
            aur_continuation_start start = {.view = aur_vector_scale(direction, -1.0f),
                                            .edges = 2,
                                            .hash = hash,
                                            .near = near,
                                            .map_radiance = radiance};
            aur_scene_surface(plan->scene, &ray, &hit, &start.surface);
            aur_continuation_correct(&plan->continuation, 1, &start, &radiance);
        }
    }
    sample.radiance = aur_vector_add(radiance, map_light.caustics);
    return sample;
}

void aur_gather_add_bright_light(const aur_gather_points *surface_points, aur_gather_sums *sums) {
    const aur_gather_plan *const plan = surface_points->plan;
    const aur_gather_light *const from = &plan->light;
    const uint32_t pair = aur_gather_first_pair(surface_points->bounces);
    for (uint32_t k = 0; k < from->bright_draws; ++k) {
        uint32_t index[AUR_PACKET_SIZE];
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
            index[lane] = surface_points->index[lane] * from->bright_draws + k;
        float choice[AUR_PACKET_SIZE], unused[AUR_PACKET_SIZE], u[AUR_PACKET_SIZE], v[AUR_PACKET_SIZE];
        aur_stream_samples(surface_points->sampler, AUR_PACKET_SIZE, surface_points->pixels, index,
                           pair + AUR_GATHER_PAIR_TEXEL, choice, unused);
        aur_stream_samples(surface_points->sampler, AUR_PACKET_SIZE, surface_points->pixels, index,
                           pair + AUR_GATHER_PAIR_TEXEL_POSITION, u, v);
        aur_light_lanes lights;
        for (uint32_t rest = surface_points->lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            const aur_bright_point point =
                aur_bright_texels_sample(from->bright, plan->scene, from->map, (double)choice[lane],
                                         (const float[2]){u[lane], v[lane]});
            const aur_light_sample sample =
                light_from(plan, &point, surface_points->at[lane].surface.position,
                           aur_hash4(surface_points->pixels[lane], index[lane], pair, plan->seed));
            aur_light_lane_set(&lights, lane, &sample);
        }
        add_lights(surface_points, AUR_EMBREE_INCOHERENT, &lights, sums);
    }
}
