/* The texels of an image in the smallest form that loses nothing: images of 8 bits have up to 256 values,
 * those of halves and of 16 bits up to 65,536, and a texel is then one number of a table. Tiles keep texels
 * that are close in the image close in memory. With pages (texel_pages.h), texels lie in a file, and memory
 * holds what is in use. */
#pragma once

#include "points/base/error.h"
#include "render/scene/materials/texel_pages.h"

typedef struct aur_bitmap {
    size_t width, height;
    size_t tile_x, tile_y; /* a tile has 2^tile_x columns and 2^tile_y rows */
    size_t tiles_across;
    size_t channels;    /* 1: grey */
    size_t value_bytes; /* 1 and 2: of numbers in the table; 4: values */
    float *table;
    size_t table_step; /* from a channel's part of the table to that of the next; 0: they share one */
    const unsigned char *values;
    unsigned char *memory;  /* that of the values; NULL where they lie in pages */
    aur_texel_pages *pages; /* NULL: the values are in memory */
    size_t first_block;     /* of the pages */
} aur_bitmap;

/* Where texels come from: value i of a row-major image, whose top row is first. */
typedef struct aur_texel_source {
    size_t width, height, stride; /* `stride` floats from one pixel to the next */
    const float *data;
    size_t channel[3];
    /* What becomes of the image's value in red, green or blue; a pure function. */
    float (*map)(const void *context, size_t channel, float value);
    const void *context;
    bool same; /* it does not depend on the channel */
} aur_texel_source;

/* Of values, those below 0 as 0. */
typedef struct aur_texel_range {
    double sum[3];
    float maximum;
} aur_texel_range;

/* `pages` may be NULL, and must outlive the texels. Errors: MEMORY, WRITE of the pages' file. */
aur_result aur_bitmap_pack(const aur_texel_source *source, aur_texel_pages *pages, aur_bitmap *texels,
                           aur_texel_range *range, aur_error *error);
void aur_bitmap_release(aur_bitmap *texels);

static inline size_t aur_bitmap_index(const aur_bitmap *texels, size_t x, size_t y) {
    const size_t across = ((size_t)1 << texels->tile_x) - 1, down = ((size_t)1 << texels->tile_y) - 1;
    const size_t tile = (y >> texels->tile_y) * texels->tiles_across + (x >> texels->tile_x);
    return tile << (texels->tile_x + texels->tile_y) | (y & down) << texels->tile_x | (x & across);
}

/* Red, green and blue with their signs, of a texel that is there. */
static inline void aur_bitmap_at(const aur_bitmap *texels, size_t x, size_t y, float rgb[3]) {
    const size_t bytes = texels->channels * texels->value_bytes;
    const size_t at = aur_bitmap_index(texels, x, y) * bytes;
    const unsigned char *const value = texels->values + at;
    const size_t second = texels->channels == 3 ? 1 : 0;
    if (texels->pages != NULL)
        aur_texel_pages_use(texels->pages, texels->first_block, at, at + bytes - 1);
    for (size_t c = 0; c < 3; ++c) {
        const size_t i = c * second;
        uint16_t number;
        switch (texels->value_bytes) {
        case 1:
            rgb[c] = texels->table[c * texels->table_step + value[i]];
            break;
        case 2:
            memcpy(&number, value + 2 * i, sizeof number);
            rgb[c] = texels->table[c * texels->table_step + number];
            break;
        default:
            memcpy(&rgb[c], value + 4 * i, sizeof rgb[c]);
        }
    }
}
