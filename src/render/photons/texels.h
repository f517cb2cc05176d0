/* Texels over the surfaces of a scene, sized by photon density. An element with many photons is divided into
 * side x side parts of equal area; small elements that are close together and have similar normals share one
 * texel, which is no smaller than a photon's share of the lit area where it has neighbours. So the light at a
 * hit is one array read, photons count only for the surface that they hit, and the texels have the total
 * power of the photons. */
#pragma once

#include "render/scene/elements.h"

typedef struct aur_texel_range {
    uint32_t first; /* texel */
    uint32_t side;  /* at least 1 */
} aur_texel_range;

typedef struct aur_texels {
    aur_elements elements;
    aur_texel_range *ranges; /* one per element */
    size_t count;
    float *areas; /* of texels, square scene units; 0: no element has it */
} aur_texels;

enum { AUR_TEXELS_SIDE_MAX = 4096 };

/* `hits` is the number of photons on each element; a texel is sized for about `photons_a_texel` of them.
 * `hits` has an entry for each of `elements`, which the texels own afterwards in every case. Errors: MEMORY,
 * ARGUMENT for more texels than 32 bits can number. */
aur_result aur_texels_create(const aur_scene *scene, aur_elements elements, const uint32_t *hits,
                             double photons_a_texel, aur_texels *texels);
void aur_texels_release(aur_texels *texels);

/* The texel of a triangle's point: barycentric u, v with u + v <= 1. */
static inline uint32_t aur_texel_of_triangle(aur_texel_range range, float u, float v) {
    if (range.side == 1)
        return range.first;
    const float n = (float)range.side;
    const uint32_t last = range.side - 1;
    uint32_t row = (uint32_t)(u * n), column = (uint32_t)(v * n);
    row = row < last ? row : last;
    const uint32_t columns = last - row; /* the last column of the row */
    column = column < columns ? column : columns;
    const uint32_t upper = (u * n - (float)row) + (v * n - (float)column) > 1.0f && column < columns ? 1 : 0;
    return range.first + row * (2 * range.side - row) + 2 * column + upper;
}

/* The texel of a curved shape's point of the unit square. */
static inline uint32_t aur_texel_of_square(aur_texel_range range, float u, float v) {
    const float n = (float)range.side;
    uint32_t row = (uint32_t)(u * n), column = (uint32_t)(v * n);
    row = row < range.side ? row : range.side - 1;
    column = column < range.side ? column : range.side - 1;
    return range.first + row * range.side + column;
}
