/* Interleaved pixels (Keller and Heidrich 2001): a tile of 16 x 16 pixels is processed in 16 groups of 16
 * pixels, one from each 4 x 4 block of the tile. Pixels of a group share random numbers, so their errors are
 * correlated. At a fixed position in all blocks this would be visible as a pattern of period 4. So each block
 * permutes its pixels by four bits of a hash. Half of the blocks also swap columns and rows: neighbours in a
 * row differ by other rotations than neighbours in a column, which would be visible as streaks. A hash of 0
 * is the identity. */
#pragma once

#include "points/base/random.h"
#include "render/film/tile.h"
#include "render/trace/packet.h"

enum {
    /* Groups, and pixels of a group, along each side of the tile. */
    AUR_GROUPS_A_SIDE = 4,
    AUR_GROUP_COUNT = AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE,
    AUR_TILE_PIXELS = AUR_TILE_SIZE * AUR_TILE_SIZE
};

/* The hash that permutes the pixels of a tile, from a hash of the seed and the tile. */
static inline uint64_t aur_group_arrangement(uint64_t tile) {
    return aur_hash2(tile, UINT64_C(0x7765617665));
}

/* Where the pixel of a group's lane lies in its block, which is number `lane`, both counted row by row. */
static inline uint32_t aur_group_pixel_index(uint64_t hash, uint32_t group, size_t lane) {
    const bool transposed = (aur_mix64(hash) >> lane & 1u) != 0;
    const uint32_t turned =
        transposed ? group % AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE + group / AUR_GROUPS_A_SIDE : group;
    return turned ^ (uint32_t)(hash >> 4 * lane & (AUR_GROUP_COUNT - 1));
}

/* The pixel of a group's lane, counted row by row within the tile. */
static inline size_t aur_group_pixel(uint64_t hash, uint32_t group, size_t lane) {
    const uint32_t index = aur_group_pixel_index(hash, group, lane);
    const size_t x = index % AUR_GROUPS_A_SIDE + AUR_GROUPS_A_SIDE * (lane % AUR_GROUPS_A_SIDE);
    const size_t y = index / AUR_GROUPS_A_SIDE + AUR_GROUPS_A_SIDE * (lane / AUR_GROUPS_A_SIDE);
    return y * AUR_TILE_SIZE + x;
}

/* Columns and rows in the image of the pixels of a group in the tile at (x0, y0). */
static inline void aur_group_pixels(uint64_t hash, uint32_t group, size_t x0, size_t y0,
                                    size_t x[AUR_PACKET_SIZE], size_t y[AUR_PACKET_SIZE]) {
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        const size_t pixel = aur_group_pixel(hash, group, lane);
        x[lane] = x0 + pixel % AUR_TILE_SIZE;
        y[lane] = y0 + pixel / AUR_TILE_SIZE;
    }
}

/* Columns and rows of the pixels of block `block`, 4 x 4 neighbours. Paths with independent random numbers
 * are grouped by blocks: their first hits are close together, so packets are more coherent, and lanes read
 * the same triangles. */
static inline void aur_block_pixels(uint32_t block, size_t x0, size_t y0, size_t x[AUR_PACKET_SIZE],
                                    size_t y[AUR_PACKET_SIZE]) {
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        x[lane] = x0 + block % AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE + lane % AUR_GROUPS_A_SIDE;
        y[lane] = y0 + block / AUR_GROUPS_A_SIDE * AUR_GROUPS_A_SIDE + lane / AUR_GROUPS_A_SIDE;
    }
}

/* The lanes of a group whose pixels lie in columns x0 .. x1 - 1 and rows y0 .. y1 - 1 of the image. */
static inline uint32_t aur_group_lanes_within(const size_t x[AUR_PACKET_SIZE],
                                              const size_t y[AUR_PACKET_SIZE], size_t x0, size_t x1,
                                              size_t y0, size_t y1) {
    uint32_t lanes = 0;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        const bool inside = x[lane] >= x0 && x[lane] < x1 && y[lane] >= y0 && y[lane] < y1;
        lanes |= (uint32_t)inside << lane;
    }
    return lanes;
}

/* The lanes of a group to trace for sample `index`: all of `lanes`, or, if not all need it, only those that
 * do. */
static inline uint32_t aur_group_lanes_needed(const aur_tile *tile, const size_t x[AUR_PACKET_SIZE],
                                              const size_t y[AUR_PACKET_SIZE], uint32_t lanes,
                                              uint32_t index) {
    if (tile->begins == NULL)
        return lanes;
    uint32_t needed = aur_group_lanes_within(x, y, tile->x0, tile->x1, tile->y0, tile->y1);
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        if ((needed >> lane & 1u) != 0 && !aur_tile_needs(tile, x[lane], y[lane], index))
            needed &= ~(1u << lane);
    return needed;
}

/* The rank of a group in a 4 x 4 ordered dither, which separates close ranks: of 16 rotations of a pattern,
 * neighbouring pixels get very different ones. */
static inline uint32_t aur_group_rank(uint32_t group) {
    static const uint8_t ranks[AUR_GROUP_COUNT] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return ranks[group];
}
