/* Blocks of 4 x 4 pixels of a film, for what is measured in a part of an image. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

enum { AUR_BLOCK_SIDE = 4, AUR_BLOCK_PIXELS = AUR_BLOCK_SIDE * AUR_BLOCK_SIDE };

typedef struct aur_blocks {
    size_t width, height; /* of the film */
    size_t count;
    size_t *order; /* [count] indices of all blocks, row by row of the film, in a low-discrepancy order */
} aur_blocks;

/* To be released in every case. Errors: MEMORY. */
aur_result aur_blocks_create(size_t width, size_t height, aur_blocks *blocks, aur_error *error);
void aur_blocks_release(aur_blocks *blocks);

/* The pixels of the block with an index, row by row of the film: returns their number. */
size_t aur_blocks_pixels(const aur_blocks *blocks, size_t index, size_t pixels[AUR_BLOCK_PIXELS]);
