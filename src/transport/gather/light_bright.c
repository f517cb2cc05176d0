/* Light of sixteen pixels from bright texels: a point on one of them each, one packet of shadow rays. */
#include "transport/gather/group.h"

/* What the points on texels shine towards the lanes' places. */
static aur_light_sample light_from(const aur_final_gather *data, const aur_bright_point *point,
                                   aur_vector place) {
    const aur_vector albedo = data->classes[point->shape].albedo_on_pi[point->behind];
    const aur_texel_light *const light =
        aur_irradiance_on_triangle(data->map, point->element, point->u, point->v, point->behind);
    const aur_vector known = aur_vector_multiply(albedo, light->irradiance);
    const aur_vector offset = aur_vector_subtract(point->position, place);
    const float square = aur_vector_dot(offset, offset), distance = sqrtf(square);
    const aur_vector direction = aur_vector_scale(offset, 1.0f / distance);
    const float cosine = -aur_vector_dot(direction, point->normal);
    aur_light_sample sample = {.position = point->position,
                               .normal = point->normal,
                               .direction = direction,
                               .distance = distance,
                               .radiance = known};
    if (!(cosine > 0.0f) || !(square > 0.0f))
        return sample;
    sample.pdf =
        aur_bright_texels_density(&data->bright, known) * (float)data->bright_share * square / cosine;
    if (data->caustics != NULL) {
        const aur_texel_light *const caustic =
            aur_irradiance_on_triangle(data->caustics, point->element, point->u, point->v, point->behind);
        sample.radiance = aur_vector_add(sample.radiance, aur_vector_multiply(albedo, caustic->irradiance));
    }
    return sample;
}

static void add_draw(aur_group *group, uint32_t index) {
    const aur_final_gather *const data = group->task->data;
    const uint32_t pair = AUR_PAIR_FIRST + AUR_GATHER_PAIRS * group->chain;
    const aur_sampler *const sampler = group->task->view->sampler;
    float choice[AUR_PACKET_SIZE], rest[AUR_PACKET_SIZE], u[AUR_PACKET_SIZE], v[AUR_PACKET_SIZE];
    aur_stream_pixels(sampler, AUR_PACKET_SIZE, group->pixels, index, pair + AUR_GATHER_PAIR_TEXEL, choice,
                      rest);
    aur_stream_pixels(sampler, AUR_PACKET_SIZE, group->pixels, index, pair + AUR_GATHER_PAIR_TEXEL_POSITION,
                      u, v);
    aur_vector contribution[AUR_PACKET_SIZE];
    uint32_t aimed = 0;
    aur_packet_empty(&group->rays.packet);
    for (uint32_t lanes = group->lanes; lanes != 0; lanes &= lanes - 1) {
        const size_t lane = aur_first_lane(lanes);
        const aur_gather_place *const p = &group->places[lane];
        const aur_bright_point point = aur_bright_texels_sample(
            &data->bright, data->scene, data->map, (double)choice[lane], (const float[2]){u[lane], v[lane]});
        const aur_light_sample light = light_from(data, &point, p->surface.position);
        if (!(light.pdf > 0.0f))
            continue;
        const aur_vector value = aur_group_weighted_value(data, p, &light);
        contribution[lane] = aur_vector_scale(aur_vector_multiply(value, light.radiance), 1.0f / light.pdf);
        if (aur_vector_is_zero(contribution[lane]))
            continue;
        float distance;
        const aur_ray shadow = aur_surface_ray_to(&p->surface, light.position, &distance);
        aur_packet_set(&group->rays.packet, lane, &shadow);
        aimed |= 1u << lane;
    }
    aur_group_add_unoccluded(group, AUR_EMBREE_INCOHERENT, aimed, contribution);
}

void aur_group_add_bright_light(aur_group *group) {
    const uint32_t share = (uint32_t)group->task->data->bright_share;
    for (uint32_t k = 0; k < share; ++k)
        add_draw(group, group->task->index * share + k);
}
