/* Sixteen rays at once, in Embree's layout (one array per field), so that rays are written in place and not
 * copied. Narrower processors trace them as two packets of 8 or four of 4, which are copies; the choice
 * depends only on the processor.
 *
 * A packet is filled lane by lane (aur_packet_set), or by writing query.ray's arrays org_x .. tfar and valid
 * in loops of 16. Lanes whose `valid` is 0 are not traced. */
#pragma once

#include <string.h>

#include "points/base/error.h"
#include "render/scene/lanes.h"
#include "render/trace/embree.h"

typedef struct aur_packet {
    _Alignas(64) int valid[AUR_PACKET_SIZE]; /* -1: a ray, 0: none */
    struct RTCRayHit16 query;                /* directions of unit length */
} aur_packet;

/* Removes all rays and sets what they share; needed once per packet, however often it is refilled. */
static inline void aur_packet_clear(aur_packet *packet) {
    memset(packet, 0, sizeof *packet);
    memset(packet->query.ray.mask, 0xff, sizeof packet->query.ray.mask);
}

static inline void aur_packet_set(aur_packet *packet, size_t lane, const aur_ray *ray) {
    struct RTCRay16 *const rays = &packet->query.ray;
    packet->valid[lane] = -1;
    rays->org_x[lane] = ray->origin.x;
    rays->org_y[lane] = ray->origin.y;
    rays->org_z[lane] = ray->origin.z;
    rays->tnear[lane] = ray->nearest;
    rays->dir_x[lane] = ray->direction.x;
    rays->dir_y[lane] = ray->direction.y;
    rays->dir_z[lane] = ray->direction.z;
    rays->tfar[lane] = ray->farthest;
}

/* The ray of a lane; after tracing it ends at its hit. */
static inline aur_ray aur_packet_ray(const aur_packet *packet, size_t lane) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    return (aur_ray){.origin = {rays->org_x[lane], rays->org_y[lane], rays->org_z[lane]},
                     .nearest = rays->tnear[lane],
                     .direction = {rays->dir_x[lane], rays->dir_y[lane], rays->dir_z[lane]},
                     .farthest = rays->tfar[lane]};
}

/* The nearest hits. Bit k of the result is set if the ray of lane k hits something, which aur_packet_hit
 * returns. The distance of a hit overwrites tfar, so tfar must be set again before the next call. */
AUR_INTERNAL uint32_t aur_scene_intersect16(const aur_scene *scene, aur_embree_order order,
                                            aur_packet *packet);
/* The same by single rays: the reference and the alternative to packets. */
uint32_t aur_scene_intersect_each(const aur_scene *scene, aur_packet *packet);
AUR_INTERNAL aur_hit aur_packet_hit(const aur_scene *scene, const aur_packet *packet, size_t lane);

/* Whether anything lies between: bit k for lane k. Changes tfar of the rays that are stopped. */
AUR_INTERNAL uint32_t aur_scene_occluded16(const aur_scene *scene, aur_embree_order order,
                                           aur_packet *packet);
/* The same by single rays; does not modify the packet. */
uint32_t aur_scene_occluded_each(const aur_scene *scene, const aur_packet *packet);

/* --- what the sixteen hits need, an array a coordinate */

/* Prefetches what aur_scene_surface will read of these lanes' hits: first their vertex indices, then the
 * vertices. In scenes larger than the cache the sixteen loads then overlap. */
void aur_packet_prefetch_indices(const aur_scene *scene, const aur_packet *packet, uint32_t lanes);
void aur_packet_prefetch_vertices(const aur_scene *scene, const aur_packet *packet, uint32_t lanes);

/* The corners of the triangles that the lanes whose bit is set have hit. They must be triangles of meshes
 * outside instances. */
void aur_packet_corners(const aur_scene *scene, const aur_packet *packet, uint32_t lanes,
                        aur_lane_vectors corner[3]);

/* Texture coordinates, and the mesh's colours there, of such a hit. */
aur_bsdf_point aur_packet_texture(const aur_scene *scene, const aur_packet *packet, size_t lane);
