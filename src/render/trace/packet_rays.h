/* The rays of a packet, and which of its lanes have one. */
#pragma once

#include <string.h>

#include "render/trace/lanes.h"

/* Takes all rays out of the packet. */
static inline void aur_packet_empty(aur_packet *packet) {
    memset(packet->valid, 0, sizeof packet->valid);
}

/* Makes the lanes of a mask, and no others, those that have a ray. */
static inline void aur_packet_set_lanes(aur_packet *packet, uint32_t lanes) {
    for (uint32_t k = 0; k < AUR_PACKET_SIZE; ++k)
        packet->valid[k] = -(int)(lanes >> k & 1u);
}
