/* GGX lobes by a pattern with optimal weights: the BSDF samples visible normals with the pattern's points and
 * returns their throughput; the rule gives the weights. */
#include "render/gather/estimators.h"

void aur_gather_by_ggx(const aur_gather_points *surface_points, size_t lobe, uint32_t lanes,
                       aur_gather_sums *sums) {
    const aur_gather_plan *const plan = surface_points->plan;
    const size_t parts = plan->samples_per_pattern, first = aur_first_lane(lanes);
    const size_t count = surface_points->at[first].ggx->count;
    aur_gather_rays *const rays = &sums->rays;
    aur_ggx_view views[AUR_PACKET_SIZE];
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_point *const surface_point = &surface_points->at[lane];
        bool mirrored;
        const size_t rotation =
            aur_gather_prepared_rotation(surface_points, surface_point->ggx->rotations, lane, &mirrored);
        views[lane] = aur_ggx_rule_view(surface_point->ggx, rotation, mirrored, surface_point->view);
    }
    for (size_t i = aur_gather_part(surface_points); i < count; i += parts) {
        aur_vector value[AUR_PACKET_SIZE];
        uint32_t aimed = 0;
        aur_packet_empty(&rays->packet);
        aur_gather_set_probability(surface_points, lobe, i, rays);
        for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            float u[3] = {aur_unit_float((uint32_t)aur_mix64(aur_gather_rays_hash(rays, lane)))}, height;
            aur_ggx_view_square(&views[lane], i, &u[1]);
            if (!aur_gather_aim_draw(&surface_points->at[lane], lane, u, (float)count / (float)parts, rays,
                                     &value[lane], &height))
                continue;
            aimed |= 1u << lane;
            value[lane] =
                aur_vector_scale(value[lane], (float)count * aur_ggx_view_weight(&views[lane], i, height));
        }
        if (aimed == 0)
            continue;
        aur_gather_rays_trace(plan, surface_points->order, rays, sums->counters);
        for (uint32_t rest = aimed; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            const aur_vector incident = {rays->radiance[0][lane], rays->radiance[1][lane],
                                         rays->radiance[2][lane]};
            aur_gather_add(sums, surface_points, lane, aur_vector_multiply(value[lane], incident));
        }
    }
}
