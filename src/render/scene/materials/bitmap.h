/* Texels in the smallest lossless format. 8-bit images have at most 256 distinct values, halves and 16-bit
 * images at most 65,536; a texel is then an index into a table. Tiling keeps texels that are close in the
 * image close in memory. With pages (texel_pages.h), texels are in a file, and only those in use are in
 * memory. */
#pragma once

#include "points/base/error.h"
#include "render/scene/materials/texel_pages.h"

typedef struct aur_bitmap {
    size_t width, height;
    size_t tile_x, tile_y; /* a tile has 2^tile_x columns and 2^tile_y rows */
    size_t tiles_across;
    size_t channels;    /* 1: grey */
    size_t value_bytes; /* 1 and 2: indices into the table; 4: values */
    float *table;
    size_t table_step; /* offset between the tables of channels; 0: one table for all */
    const unsigned char *values;
    unsigned char *memory;  /* texel data; NULL if paged */
    aur_texel_pages *pages; /* NULL: texels are values */
    size_t first_block;     /* offset within the pages */
} aur_bitmap;

/* Source of texels: value i of a row-major image, top row first. */
typedef struct aur_texel_source {
    size_t width, height, stride; /* `stride` floats from one pixel to the next */
    const float *data;
    /* Not NULL: codes instead of `data`, and what they stand for, each a different value, in all channels. */
    const unsigned char *codes;
    float code_values[256];
    size_t channel[3];
    /* The value stored for an image value in red, green or blue; a pure function. */
    float (*map)(const void *context, size_t channel, float value);
    const void *context;
    bool same; /* the same for all channels */
} aur_texel_source;

/* Sum per channel and maximum of the values; negative values count as 0. */
typedef struct aur_texel_range {
    double sum[3];
    float maximum;
} aur_texel_range;

/* `pages` may be NULL, and must outlive the texels. Errors: MEMORY, WRITE for the pages' file. */
aur_result aur_bitmap_pack(const aur_texel_source *source, aur_texel_pages *pages, aur_bitmap *texels,
                           aur_texel_range *range, aur_error *error);
void aur_bitmap_release(aur_bitmap *texels);

static inline size_t aur_bitmap_index(const aur_bitmap *texels, size_t x, size_t y) {
    const size_t across = ((size_t)1 << texels->tile_x) - 1, down = ((size_t)1 << texels->tile_y) - 1;
    const size_t tile = (y >> texels->tile_y) * texels->tiles_across + (x >> texels->tile_x);
    return tile << (texels->tile_x + texels->tile_y) | (y & down) << texels->tile_x | (x & across);
}

/* The value of channel c at `from`. */
static inline float aur_bitmap_value(const aur_bitmap *texels, size_t value_bytes, size_t c,
                                     const unsigned char *from) {
    uint16_t number;
    float value;
    switch (value_bytes) {
    case 1:
        return texels->table[c * texels->table_step + *from];
    case 2:
        memcpy(&number, from, sizeof number);
        return texels->table[c * texels->table_step + number];
    default:
        memcpy(&value, from, sizeof value);
        return value;
    }
}

/* Red, green and blue, possibly negative, of a valid texel. */
static inline void aur_bitmap_at(const aur_bitmap *texels, size_t x, size_t y, float rgb[3]) {
    const size_t bytes = texels->channels * texels->value_bytes;
    const size_t at = aur_bitmap_index(texels, x, y) * bytes;
    const unsigned char *const value = texels->values + at;
    const size_t second = texels->channels == 3 ? texels->value_bytes : 0;
    if (texels->pages != NULL)
        aur_texel_pages_use(texels->pages, texels->first_block, at, at + bytes - 1);
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = aur_bitmap_value(texels, texels->value_bytes, c, value + c * second);
}
