/* Sets of a packet's sixteen lanes: bit k of a mask stands for lane k. All lanes of a mask are visited, from
 * the lowest one on, by
 *
 *     for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
 *         const size_t lane = aur_first_lane(rest);
 */
#pragma once

#include "render/scene/packet.h"

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
