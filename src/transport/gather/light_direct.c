/* Direct light of sixteen pixels: a point on a light each, one packet of shadow rays. */
#include "transport/gather/estimate_merged.h"
#include "transport/lights/direct_light.h"

aur_vector aur_group_weighted_value(const aur_final_gather *data, const aur_gather_place *p,
                                    const aur_light_sample *light) {
    const aur_vector local = aur_frame_to_local(&p->surface.frame, light->direction);
    if (aur_vector_dot(p->surface.geometric_normal, light->direction) * local.z <= 0.0f)
        return (aur_vector){0};
    aur_vector sum = {0};
    size_t merged[2];
    const aur_gather_pair *const pair = aur_group_pair(data, p, merged);
    for (size_t i = 0; i < p->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &p->lobes[i];
        if (aur_vector_is_zero(lobe->coefficient))
            continue;
        aur_vector value = {0};
        float density = 0.0f;
        if (lobe->shape == AUR_LOBE_SHAPE_SAMPLED) {
            value = aur_bsdf_evaluate(p->surface.bsdf, AUR_BSDF_SAMPLED_LOBES, p->surface.texture, p->view,
                                      local);
            density =
                aur_bsdf_pdf(p->surface.bsdf, AUR_BSDF_SAMPLED_LOBES, p->surface.texture, p->view, local) *
                aur_final_gather_share(data, &data->visible);
        } else if (lobe->shape == AUR_LOBE_SHAPE_COSINE_POWER && p->view.z * local.z > 0.0f) {
            value = aur_lobe_value(lobe, local);
            const aur_gather_rule *const rule = aur_final_gather_rule(data, lobe);
            if (pair != NULL)
                density = aur_group_pair_density(pair, p, merged, local);
            else if (!aur_vector_is_zero(value))
                density = aur_gather_density(rule, aur_vector_dot(lobe->axis, local)) *
                          aur_final_gather_share(data, rule);
        }
        const bool rivals = !light->delta && aur_group_gathers(data, lobe);
        sum = aur_vector_add_scaled(sum, rivals ? aur_power_heuristic(light->pdf, density) : 1.0f, value);
    }
    return sum;
}

void aur_group_add_unoccluded(aur_group *group, aur_embree_order order, uint32_t aimed,
                              const aur_vector contribution[AUR_PACKET_SIZE]) {
    if (aimed == 0)
        return;
    const uint32_t lit =
        aimed & ~aur_final_gather_occluded(group->task->data, order, &group->rays.packet, group->counters);
    for (uint32_t rest = lit; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        group->sum[lane] = aur_vector_add(group->sum[lane],
                                          aur_vector_multiply(group->throughput[lane], contribution[lane]));
    }
}

static void add_draw(aur_group *group, const aur_vector references[AUR_PACKET_SIZE], uint32_t index) {
    const aur_final_gather *const data = group->task->data;
    const aur_scene *const scene = data->scene;
    const bool chooses = aur_light_chooses(scene);
    const uint32_t pair = AUR_PAIR_FIRST + AUR_GATHER_PAIRS * group->chain;
    const aur_sampler *const sampler = group->task->view->sampler;
    float choice[AUR_PACKET_SIZE], unused[AUR_PACKET_SIZE], u[AUR_PACKET_SIZE], v[AUR_PACKET_SIZE];
    if (chooses)
        aur_stream_pixels(sampler, AUR_PACKET_SIZE, group->pixels, index, pair + AUR_GATHER_PAIR_CHOICE,
                          choice, unused);
    aur_stream_pixels(sampler, AUR_PACKET_SIZE, group->pixels, index, pair + AUR_GATHER_PAIR_POSITION, u, v);
    aur_light_sample lights[AUR_PACKET_SIZE];
    aur_light_samples_direct(scene, AUR_PACKET_SIZE, references, AUR_LEAST_LIGHT_SEEN,
                             chooses ? choice : NULL, u, v, lights);
    aur_vector contribution[AUR_PACKET_SIZE];
    uint32_t aimed = 0;
    aur_packet_empty(&group->rays.packet);
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_place *const p = &group->places[lane];
        aur_light_sample *const light = &lights[lane];
        if (!(light->pdf > 0.0f))
            continue;
        light->pdf *= (float)data->light_share;
        const aur_vector value = aur_group_weighted_value(data, p, light);
        contribution[lane] = aur_vector_scale(aur_vector_multiply(value, light->radiance), 1.0f / light->pdf);
        if (aur_vector_is_zero(contribution[lane]))
            continue;
        float distance;
        const aur_ray shadow = aur_surface_ray_to(&p->surface, light->position, &distance);
        aur_packet_set(&group->rays.packet, lane, &shadow);
        aimed |= 1u << lane;
    }
    aur_group_add_unoccluded(group, group->flat ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT, aimed,
                             contribution);
}

void aur_group_add_direct_light(aur_group *group) {
    /* Lanes without a place stand where the first one is: their samples are drawn and thrown away. */
    aur_vector references[AUR_PACKET_SIZE];
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        const size_t from = (group->lanes >> lane & 1u) != 0 ? lane : aur_first_lane(group->lanes);
        references[lane] = group->places[from].surface.position;
    }
    const uint32_t share = group->task->data->light_share;
    for (uint32_t k = 0; k < share; ++k)
        add_draw(group, references, group->task->index * share + k);
}
