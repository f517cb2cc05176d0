/* Loops over lanes without branches, so that the compiler vectorises them; operations in a fixed order
 * without contraction, so that results are bit-identical on all machines. */
#include "render/vertex/vertex_lanes.h"

#include "render/scene/materials/sampling.h"
#include "render/trace/packet_rays.h"
#include "render/vertex/candidates.h"
#include "render/vertex/vertex.h"

static void lanes_surface(aur_vertex_lanes *restrict lanes, const aur_packet *restrict packet) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    const struct RTCHit16 *const hits = &packet->query.hit;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_vector corner = aur_lane_vector(&lanes->corner[0], k);
        const aur_vector b = aur_lane_vector(&lanes->corner[1], k), c = aur_lane_vector(&lanes->corner[2], k);
        const aur_vector way = {rays->dir_x[k], rays->dir_y[k], rays->dir_z[k]};
        const float u = hits->u[k], v = hits->v[k];
        const aur_vector cross =
            aur_vector_cross(aur_vector_subtract(b, corner), aur_vector_subtract(c, corner));
        const float squared = aur_vector_dot(cross, cross);
        const float scale = 1.0f / sqrtf(squared > 0.0f ? squared : 1.0f);
        /* A triangle too thin for its normal faces the ray. */
        const aur_vector normal = {squared > 0.0f ? cross.x * scale : -way.x,
                                   squared > 0.0f ? cross.y * scale : -way.y,
                                   squared > 0.0f ? cross.z * scale : -way.z};
        const aur_vector position =
            aur_vector_add_scaled(aur_vector_add_scaled(aur_vector_scale(corner, 1.0f - u - v), u, b), v, c);
        const float along = aur_vector_dot(normal, way);
        const float side = along > 0.0f ? -1.0f : 1.0f;
        aur_lane_set(&lanes->position, k, position);
        aur_lane_set(&lanes->normal, k, normal);
        aur_lane_set(&lanes->facing, k, aur_vector_scale(normal, side));
        lanes->side[k] = side;
        const float offset = aur_triangle_offset(corner, b, c, normal);
        aur_lane_set(&lanes->origin, k, aur_vector_add_scaled(position, side * offset, normal));
        lanes->reflectance.x[k] = along > 0.0f ? lanes->albedo[1].x[k] : lanes->albedo[0].x[k];
        lanes->reflectance.y[k] = along > 0.0f ? lanes->albedo[1].y[k] : lanes->albedo[0].y[k];
        lanes->reflectance.z[k] = along > 0.0f ? lanes->albedo[1].z[k] : lanes->albedo[0].z[k];
    }
}

static uint32_t lanes_tilted(const aur_vertex_lanes *lanes, size_t first) {
    const aur_vector reference = aur_lane_vector(&lanes->position, first);
    const aur_vector normal = aur_vector_scale(aur_lane_vector(&lanes->normal, first), lanes->side[first]);
    uint32_t tilted = 0;
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_vector offset = aur_vector_subtract(aur_lane_vector(&lanes->position, k), reference);
        const float cosine = aur_vector_dot(aur_lane_vector(&lanes->normal, k), normal) * lanes->side[k];
        tilted |= aur_is_off_plane(offset, normal, cosine) << k;
    }
    return tilted;
}

static void lanes_shadow(aur_vertex_lanes *restrict lanes, aur_packet *restrict packet) {
    struct RTCRay16 *const rays = &packet->query.ray;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_vector origin = aur_lane_vector(&lanes->origin, k);
        const aur_vector way = aur_vector_subtract(aur_lane_vector(&lanes->light.position, k), origin);
        const float squared = aur_vector_dot(way, way);
        const float distance = sqrtf(squared > 1e-38f ? squared : 1e-38f);
        const float scale = 1.0f / distance;
        const float cosine = aur_vector_dot(aur_lane_vector(&lanes->normal, k), way) * lanes->side[k] * scale;
        const float pdf = lanes->light.pdf[k];
        const float bsdf_pdf = cosine / AUR_PI_F;
        const float weight = aur_power_heuristic(pdf, bsdf_pdf * lanes->light.reachable[k]) * bsdf_pdf / pdf;
        const aur_vector light = aur_vector_multiply(aur_lane_vector(&lanes->reflectance, k),
                                                     aur_lane_vector(&lanes->light.radiance, k));
        const float any = light.x + light.y + light.z;
        aur_lane_set(
            &lanes->shadow, k,
            aur_vector_multiply(aur_lane_vector(&lanes->throughput, k), aur_vector_scale(light, weight)));
        lanes->lit[k] = -((int)(pdf > 0.0f) & (int)(cosine > 0.0f) & (int)(any > 0.0f));
        rays->org_x[k] = origin.x;
        rays->org_y[k] = origin.y;
        rays->org_z[k] = origin.z;
        rays->tnear[k] = 0.0f;
        rays->dir_x[k] = way.x * scale;
        rays->dir_y[k] = way.y * scale;
        rays->dir_z[k] = way.z * scale;
        rays->tfar[k] = distance;
    }
}

static void lanes_consider(aur_vertex_lanes *restrict lanes, const aur_packet *restrict packet,
                           aur_vertex_candidates *restrict selected) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_vector light = aur_lane_vector(&lanes->shadow, k);
        const float brings = aur_candidate_weight(light);
        const float weight = lanes->lit[k] != 0 ? brings : 0.0f;
        const bool wins = aur_candidate_wins(weight, &selected->total[k], &lanes->selection[k]);
        selected->weight[k] = wins ? weight : selected->weight[k];
        selected->light.x[k] = wins ? light.x : selected->light.x[k];
        selected->light.y[k] = wins ? light.y : selected->light.y[k];
        selected->light.z[k] = wins ? light.z : selected->light.z[k];
        selected->origin.x[k] = wins ? rays->org_x[k] : selected->origin.x[k];
        selected->origin.y[k] = wins ? rays->org_y[k] : selected->origin.y[k];
        selected->origin.z[k] = wins ? rays->org_z[k] : selected->origin.z[k];
        selected->direction.x[k] = wins ? rays->dir_x[k] : selected->direction.x[k];
        selected->direction.y[k] = wins ? rays->dir_y[k] : selected->direction.y[k];
        selected->direction.z[k] = wins ? rays->dir_z[k] : selected->direction.z[k];
        selected->farthest[k] = wins ? rays->tfar[k] : selected->farthest[k];
    }
}

static void lanes_choose(const aur_vertex_candidates *restrict selected, uint32_t count,
                         aur_vertex_lanes *restrict lanes, aur_packet *restrict packet) {
    struct RTCRay16 *const rays = &packet->query.ray;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float weight = selected->weight[k];
        const float scale = aur_candidate_scale(count, selected->total[k], weight > 0.0f ? weight : 1.0f);
        lanes->lit[k] = -(int)(weight > 0.0f);
        aur_lane_set(&lanes->shadow, k, aur_vector_scale(aur_lane_vector(&selected->light, k), scale));
        rays->org_x[k] = selected->origin.x[k];
        rays->org_y[k] = selected->origin.y[k];
        rays->org_z[k] = selected->origin.z[k];
        rays->tnear[k] = 0.0f;
        rays->dir_x[k] = selected->direction.x[k];
        rays->dir_y[k] = selected->direction.y[k];
        rays->dir_z[k] = selected->direction.z[k];
        rays->tfar[k] = selected->farthest[k];
    }
}

static void lanes_add(aur_vertex_lanes *restrict lanes, uint32_t lit) {
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const bool on = (lit >> k & 1u) != 0;
        lanes->sum.x[k] += on ? lanes->shadow.x[k] : 0.0f;
        lanes->sum.y[k] += on ? lanes->shadow.y[k] : 0.0f;
        lanes->sum.z[k] += on ? lanes->shadow.z[k] : 0.0f;
    }
}

static void lanes_scatter(aur_vertex_lanes *restrict lanes, bool roulette, aur_packet *restrict packet) {
    struct RTCRay16 *const rays = &packet->query.ray;
    const float least = roulette ? 0.0f : 1.0f; /* survival probability */
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        /* aur_sample_cosine without its branches. */
        const float a = 2.0f * lanes->direction_u[k] - 1.0f, b = 2.0f * lanes->direction_v[k] - 1.0f;
        const bool wide = fabsf(a) > fabsf(b);
        const float radius = wide ? a : b, other = wide ? b : a;
        float cosine, sine;
        aur_eighth_turn(other / (radius == 0.0f ? 1.0f : radius), &cosine, &sine);
        const float x = radius * (wide ? cosine : sine), y = radius * (wide ? sine : cosine);
        const float z = sqrtf(fabsf(1.0f - x * x - y * y)); /* below 0 by rounding only */

        const aur_vector normal = aur_lane_vector(&lanes->normal, k);
        const aur_frame frame = aur_frame_about(normal);
        const aur_vector way = aur_frame_to_world(&frame, (aur_vector){x, y, lanes->side[k] * z});
        const aur_vector throughput = aur_vector_multiply(aur_lane_vector(&lanes->throughput, k),
                                                          aur_lane_vector(&lanes->reflectance, k));
        const float most = aur_vector_max(throughput);
        const float survival = aur_larger(aur_survival(throughput), least);
        aur_lane_set(&lanes->throughput, k, aur_vector_scale(throughput, 1.0f / survival));
        lanes->alive[k] = -((int)(lanes->roulette[k] < survival) & (int)(most > 0.0f));
        lanes->pdf[k] = z / AUR_PI_F;
        const aur_vector origin = aur_lane_vector(&lanes->origin, k);
        aur_lane_set(&lanes->from, k, origin);
        aur_lane_set(&lanes->from_normal, k, aur_lane_vector(&lanes->facing, k));
        rays->org_x[k] = origin.x;
        rays->org_y[k] = origin.y;
        rays->org_z[k] = origin.z;
        rays->tnear[k] = 0.0f;
        rays->dir_x[k] = way.x;
        rays->dir_y[k] = way.y;
        rays->dir_z[k] = way.z;
        rays->tfar[k] = INFINITY;
    }
}

const aur_vertex_kernels AUR_KERNEL(aur_vertex_kernels) = {
    lanes_surface, lanes_tilted, lanes_shadow, lanes_consider, lanes_choose, lanes_add, lanes_scatter};
