#include "render/film/blocks.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static size_t columns_of(const aur_blocks *blocks) {
    return (blocks->width + AUR_BLOCK_SIDE - 1) / AUR_BLOCK_SIDE;
}

aur_result aur_blocks_create(size_t width, size_t height, aur_blocks *blocks, aur_error *error) {
    const double g = 1.32471795724474602596; /* of the plane's R2 sequence (Roberts 2018) */
    *blocks = (aur_blocks){.width = width, .height = height};
    const size_t columns = columns_of(blocks), rows = (height + AUR_BLOCK_SIDE - 1) / AUR_BLOCK_SIDE;
    const size_t all = columns * rows;
    bool *const taken = calloc(all, sizeof *taken);
    blocks->order = calloc(all, sizeof *blocks->order);
    if (taken == NULL || blocks->order == NULL) {
        free(taken);
        return aur_fail_memory(error);
    }
    /* First the blocks of points in sequence, then the blocks that no point has hit. */
    for (size_t i = 0; i < 65 * all && blocks->count < all; ++i) {
        const double x = fmod(0.5 + (double)i / g, 1.0), y = fmod(0.5 + (double)i / (g * g), 1.0);
        const size_t hit_block = (size_t)(y * (double)rows) * columns + (size_t)(x * (double)columns);
        const size_t block = i < 64 * all ? hit_block : i - 64 * all;
        if (!taken[block])
            blocks->order[blocks->count++] = block;
        taken[block] = true;
    }
    free(taken);
    return AUR_OK;
}

void aur_blocks_release(aur_blocks *blocks) {
    free(blocks->order);
    *blocks = (aur_blocks){.count = 0};
}

size_t aur_blocks_pixels(const aur_blocks *blocks, size_t index, size_t pixels[AUR_BLOCK_PIXELS]) {
    const size_t x0 = index % columns_of(blocks) * AUR_BLOCK_SIDE;
    const size_t y0 = index / columns_of(blocks) * AUR_BLOCK_SIDE;
    size_t count = 0;
    for (size_t y = y0; y < y0 + AUR_BLOCK_SIDE && y < blocks->height; ++y)
        for (size_t x = x0; x < x0 + AUR_BLOCK_SIDE && x < blocks->width; ++x)
            pixels[count++] = y * blocks->width + x;
    return count;
}
