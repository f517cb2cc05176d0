/* Interleaved pixels (Keller and Heidrich 2001): a tile of 16 x 16 pixels is done in 16 groups of 16 pixels,
 * which are those at one place of all 4 x 4 blocks of the tile. */
#ifndef AUR_TRANSPORT_PACKETS_INTERLEAVE_H
#define AUR_TRANSPORT_PACKETS_INTERLEAVE_H

#include "film/tile.h"

enum {
    /* Groups, and pixels of a group, along each side of the tile. */
    AUR_GROUPS_A_SIDE = 4,
    AUR_TILE_PIXELS = AUR_TILE_SIZE * AUR_TILE_SIZE
};

/* The pixel of a group's lane, counted row by row within the tile. */
static inline size_t aur_group_pixel(uint32_t group, size_t lane) {
    const size_t x = group % AUR_GROUPS_A_SIDE + AUR_GROUPS_A_SIDE * (lane % AUR_GROUPS_A_SIDE);
    const size_t y = group / AUR_GROUPS_A_SIDE + AUR_GROUPS_A_SIDE * (lane / AUR_GROUPS_A_SIDE);
    return y * AUR_TILE_SIZE + x;
}

#endif
