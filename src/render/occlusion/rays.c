#include "render/occlusion/rays.h"

#include "render/trace/packet_rays.h"

/* --- shading points */

static void put(float arrays[3][AUR_OCCLUSION_POINTS], size_t surface_point, aur_vector v) {
    arrays[0][surface_point] = v.x;
    arrays[1][surface_point] = v.y;
    arrays[2][surface_point] = v.z;
}

/* Surfaces are seen from either side. */
static void set_point(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit, size_t surface_point,
                      aur_occlusion_points *surface_points) {
    aur_surface surface;
    aur_scene_surface(scene, ray, hit, &surface);
    const float side = aur_vector_dot(surface.geometric_normal, ray->direction) > 0.0f ? -1.0f : 1.0f;
    const aur_frame frame = aur_frame_about(aur_vector_scale(surface.frame.z, side));
    put(surface_points->origin, surface_point,
        aur_surface_ray(&surface, aur_vector_scale(surface.geometric_normal, side)).origin);
    put(surface_points->axis[0], surface_point, frame.x);
    put(surface_points->axis[1], surface_point, frame.y);
    put(surface_points->axis[2], surface_point, frame.z);
    surface_points->seen[surface_point] = true;
}

void aur_occlusion_find_points(const aur_view *view, size_t x, size_t y, uint32_t index,
                               aur_occlusion_points *surface_points) {
    aur_packet packet;
    aur_packet_clear(&packet);
    surface_points->arrangement = aur_group_arrangement(aur_hash3(view->seed, y, x));
    aur_ray rays[AUR_PACKET_SIZE];
    for (size_t block = 0; block < AUR_PACKET_SIZE; ++block) {
        for (size_t within = 0; within < AUR_PACKET_SIZE; ++within) {
            const size_t surface_point = within * AUR_PACKET_SIZE + block;
            const size_t pixel = aur_group_pixel(surface_points->arrangement, (uint32_t)within, block);
            aur_camera_sample sample;
            aur_view_sample(view, x + pixel % AUR_TILE_SIZE, y + pixel / AUR_TILE_SIZE, index, &sample);
            surface_points->offset[surface_point][0] = sample.offset[0];
            surface_points->offset[surface_point][1] = sample.offset[1];
            surface_points->pixel[surface_point] = sample.stream.pixel;
            surface_points->seen[surface_point] = false;
            rays[within] = sample.ray;
            aur_packet_set(&packet, within, &sample.ray);
        }
        const uint32_t hits = aur_scene_intersect16(view->scene, AUR_EMBREE_COHERENT, &packet);
        for (size_t within = 0; within < AUR_PACKET_SIZE; ++within)
            if ((hits >> within & 1) != 0) {
                const aur_hit hit = aur_packet_hit(view->scene, &packet, within);
                set_point(view->scene, &rays[within], &hit, within * AUR_PACKET_SIZE + block, surface_points);
            }
    }
}

/* --- rays */

static aur_vector get(const float arrays[3][AUR_OCCLUSION_POINTS], size_t surface_point) {
    return (aur_vector){arrays[0][surface_point], arrays[1][surface_point], arrays[2][surface_point]};
}

/* Packets are fast together where their surface is flat, and slower than apart where it is not. */
static aur_embree_order order_of(const aur_occlusion_points *surface_points, size_t first) {
    const aur_vector origin = get(surface_points->origin, first),
                     normal = get(surface_points->axis[2], first);
    uint32_t apart = 0;
    for (size_t k = first; k < first + AUR_PACKET_SIZE; ++k)
        apart |= (uint32_t)!surface_points->seen[k] |
                 aur_is_off_plane(aur_vector_subtract(get(surface_points->origin, k), origin), normal,
                                  aur_vector_dot(get(surface_points->axis[2], k), normal));
    return apart == 0 ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
}

/* Direction `index` of the rule in the frames of 16 shading points, which share one randomisation or have one
 * each. */
static void aim(const aur_gather_rule *rule, const aur_occlusion_points *surface_points, size_t first,
                const aur_gather_rotation *rotations, bool together, size_t index, struct RTCRay16 *rays) {
    aur_lane_vectors local;
    aur_vector direction;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if (k == 0 || !together)
            aur_gather_rule_direction(rule, &rotations[k], index, &direction);
        aur_lane_set(&local, k, direction);
    }
    float *const out[3] = {rays->dir_x, rays->dir_y, rays->dir_z};
    for (size_t c = 0; c < 3; ++c) {
        const float *const x = surface_points->axis[0][c] + first;
        const float *const y = surface_points->axis[1][c] + first;
        const float *const z = surface_points->axis[2][c] + first;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            out[c][k] = local.x[k] * x[k] + local.y[k] * y[k] + local.z[k] * z[k];
    }
}

/* The part of the pattern that a sample uses. Tiles and groups start at different parts, so that incomplete
 * patterns do not all lack the same directions (aur_gather_part). */
static size_t part_of(const aur_occlusion *occlusion, uint64_t tile, size_t within, uint32_t index) {
    const size_t parts = occlusion->samples_per_pattern;
    if (!occlusion->renews)
        return index % parts;
    const size_t first = tile % parts + aur_group_rank((uint32_t)within);
    return (first + index % parts * occlusion->part_stride) % parts;
}

/* The pattern's rotation for all shading points of a group, or for one of them. */
static aur_gather_rotation rotation_of(const aur_occlusion *occlusion, uint64_t tile, size_t within) {
    const aur_gather_rule *const rule = &occlusion->rule;
    const aur_gather_rotation rotation =
        aur_gather_rule_rotation(rule, tile + aur_group_rank((uint32_t)within));
    if (!occlusion->renews || rule->scramble != AUR_SCRAMBLE_ROTATE)
        return rotation;
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)aur_mix64(tile));
    return aur_gather_rotation_by(rotation, cosf(angle), sinf(angle));
}

size_t aur_occlusion_visit(const aur_occlusion *occlusion, const aur_occlusion_points *surface_points,
                           size_t x, size_t y, uint32_t index, aur_occlusion_visitor visit, void *context) {
    const aur_gather_rule *const rule = &occlusion->rule;
    const uint64_t pattern = occlusion->renews ? index / occlusion->samples_per_pattern : 0;
    const uint64_t seed = pattern > 0 ? aur_hash2(occlusion->seed, pattern) : occlusion->seed;
    const uint64_t tile = aur_hash3(seed, y, x) >> 8;
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t within = 0; within < AUR_PACKET_SIZE; ++within) {
        const size_t first = within * AUR_PACKET_SIZE;
        bool any = false;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            packet.valid[k] = surface_points->seen[first + k] ? -1 : 0;
            packet.query.ray.org_x[k] = surface_points->origin[0][first + k];
            packet.query.ray.org_y[k] = surface_points->origin[1][first + k];
            packet.query.ray.org_z[k] = surface_points->origin[2][first + k];
            any = any || surface_points->seen[first + k];
        }
        if (!any)
            continue;
        const aur_embree_order order = order_of(surface_points, first);
        const bool together = rule->rotation_count > 0 || rule->scramble == AUR_SCRAMBLE_NONE;
        aur_gather_rotation rotations[AUR_PACKET_SIZE];
        for (size_t k = 0; k < (together ? 1 : AUR_PACKET_SIZE); ++k)
            rotations[k] =
                together ? rotation_of(occlusion, tile, within)
                         : aur_gather_rule_rotation(rule, aur_hash2(seed, surface_points->pixel[first + k]));
        for (size_t i = part_of(occlusion, tile, within, index); i < rule->count;
             i += occlusion->samples_per_pattern) {
            aim(rule, surface_points, first, rotations, together, i, &packet.query.ray);
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                packet.query.ray.tfar[k] = occlusion->max_distance;
            visit(context, first, order, &packet);
        }
    }
    return rule->count / occlusion->samples_per_pattern;
}
