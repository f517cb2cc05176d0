/* The rays of a packet, and its lane masks. */
#pragma once

#include <string.h>

#include "points/base/vector.h"
#include "render/scene/scene.h"
#include "render/trace/packet.h"

/* Masks of a packet's sixteen lanes: bit k is lane k. To visit all lanes of a mask in ascending order:
 *
 *     for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
 *         const size_t lane = aur_first_lane(rest); */

/* The lowest lane of a mask that is not 0. */
static inline uint32_t aur_first_lane(uint32_t lanes) {
    return (uint32_t)__builtin_ctz(lanes);
}

static inline uint32_t aur_lane_count(uint32_t lanes) {
    return (uint32_t)__builtin_popcount(lanes);
}

static inline bool aur_has_lane(uint32_t lanes, size_t lane) {
    return (lanes >> lane & 1u) != 0;
}

/* The lanes whose flag is -1; the others' is 0. */
static inline uint32_t aur_lanes_set(const int flags[AUR_PACKET_SIZE]) {
    uint32_t lanes = 0;
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k)
        lanes |= (uint32_t)(flags[k] & 1) << k;
    return lanes;
}

/* Takes all rays out of the packet. */
static inline void aur_packet_empty(aur_packet *packet) {
    memset(packet->valid, 0, sizeof packet->valid);
}

/* Sets `valid` for the lanes of a mask, and clears it for the others. */
static inline void aur_packet_set_lanes(aur_packet *packet, uint32_t lanes) {
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k)
        packet->valid[k] = -(int)(lanes >> k & 1u);
}

/* Whether the rays that leave 16 shading points in similar directions form a coherent packet: if the points
 * are nearly coplanar. A function of positions and normals, never of timing. */

/* 1 if a point is off the plane of another one. `offset` is the vector between them, `normal` that of the
 * plane, and `cosine` the cosine between the two points' normals. The limits are 6 degrees each. Without
 * branches, for loops over lanes. */
static inline uint32_t aur_is_off_plane(aur_vector offset, aur_vector normal, float cosine) {
    const float height = aur_vector_dot(offset, normal);
    return (uint32_t)(cosine < 0.995f) | (uint32_t)(height * height > 0.01f * aur_vector_dot(offset, offset));
}

/* Properties of each shape that are known before a ray hits it, so that most hits need no evaluation of their
 * surface. */

typedef struct aur_shape_class {
    bool curved; /* not a mesh */
    bool emits;
    /* A mesh with only uniform diffuse reflection, and no emission. */
    bool plain;
    bool plain_flat; /* plain, and without normals at its vertices */
    /* The same with a textured reflectance. */
    bool textured_flat;
    /* Reflectance of plain shapes on the side of the normal, and on the back: RGB, and the same divided by
     * pi. */
    aur_vector albedo[2], albedo_on_pi[2];
} aur_shape_class;

/* One class per shape of the scene; freed by the caller. Errors: MEMORY. */
aur_result aur_shape_classes_create(const aur_scene *scene, aur_shape_class **classes, aur_error *error);
