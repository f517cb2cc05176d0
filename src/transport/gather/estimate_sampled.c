/* Lobes without a formula: the rule's points of the square choose among the BSDF's own draws. */
#include "core/random.h"
#include "transport/gather/estimators.h"

/* A draw of a place's sampled lobe becomes the lane's ray; false: there is none. */
static bool aim_draw(const aur_gather_place *place, size_t lane, const float u[3], float draws,
                     aur_gather_rays *rays, aur_vector *value) {
    const aur_surface *const surface = &place->surface;
    aur_bsdf_sample drawn;
    if (!aur_bsdf_draw(surface->bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, place->view, u, &drawn) ||
        !(drawn.pdf > 0.0f))
        return false;
    const aur_vector light = aur_frame_to_world(&surface->frame, drawn.light);
    if (aur_vector_dot(surface->geometric_normal, light) * drawn.light.z <= 0.0f)
        return false;
    *value = aur_vector_scale(drawn.weight, 1.0f / draws);
    const aur_ray ray = aur_surface_ray(surface, light);
    aur_packet_set(&rays->packet, lane, &ray);
    rays->density[lane] = drawn.pdf * draws;
    rays->reference[lane] = surface->position;
    return true;
}

void aur_gather_by_sampling(const aur_gather_plan *plan, const aur_gather_places *places, size_t lobe,
                            uint32_t lanes, aur_gather_sums *sums, aur_gather_scratch *scratch) {
    const aur_gather_lobe_rule *const sampled = &plan->rules.sampled;
    aur_gather_rays *const rays = &scratch->rays;
    aur_gather_sweep sweep;
    aur_gather_sweep_start(plan, places, sampled, lobe, lanes, &sweep, rays);
    const size_t first = aur_first_lane(lanes), parts = plan->samples_per_pixel;
    for (size_t i = places->index % parts; i < sampled->rule.count; i += parts) {
        aur_vector value[AUR_PACKET_SIZE];
        float u[3] = {0.0f, 0.0f, 0.0f};
        uint32_t aimed = 0;
        aur_packet_empty(&rays->packet);
        rays->hash = aur_hash3(places->pixels[first], i, lobe);
        if (sweep.together)
            aur_gather_rule_square(&sampled->rule, &sweep.rotations[first], i, &u[1]);
        for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            if (!sweep.together)
                aur_gather_rule_square(&sampled->rule, &sweep.rotations[lane], i, &u[1]);
            u[0] = aur_unit_float((uint32_t)aur_hash2(rays->hash, ~(uint64_t)lane));
            aimed |= (uint32_t)aim_draw(&places->at[lane], lane, u, sampled->directions, rays, &value[lane])
                     << lane;
        }
        if (aimed == 0)
            continue;
        aur_gather_rays_trace(plan, places->order, rays, sums->counters);
        for (uint32_t rest = aimed; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            const aur_vector incident = {rays->radiance[0][lane], rays->radiance[1][lane],
                                         rays->radiance[2][lane]};
            aur_gather_add(sums, places, lane, aur_vector_multiply(value[lane], incident));
        }
    }
}
