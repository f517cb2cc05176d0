/* The rays of a packet, and which of its lanes have one. */
#pragma once

#include <string.h>

#include "transport/packets/lanes.h"

/* The ray of a lane, which ends at its hit once the packet has been traced. */
static inline aur_ray aur_packet_ray(const aur_packet *packet, size_t lane) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    return (aur_ray){.origin = {rays->org_x[lane], rays->org_y[lane], rays->org_z[lane]},
                     .nearest = rays->tnear[lane],
                     .direction = {rays->dir_x[lane], rays->dir_y[lane], rays->dir_z[lane]},
                     .farthest = rays->tfar[lane]};
}

/* Takes all rays out of the packet. */
static inline void aur_packet_empty(aur_packet *packet) {
    memset(packet->valid, 0, sizeof packet->valid);
}

/* Makes the lanes of a mask, and no others, those that have a ray. */
static inline void aur_packet_set_lanes(aur_packet *packet, uint32_t lanes) {
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k)
        packet->valid[k] = -(int)(lanes >> k & 1u);
}
