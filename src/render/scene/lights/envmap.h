/* Light from a picture around the scene: the tables that directions are drawn and radiance is looked up by.
 */
#pragma once

#include "render/scene/packet.h"
#include "render/scene/patches.h"

/* Red, green, blue and luminance. */
typedef float aur_texel __attribute__((vector_size(16)));

typedef struct aur_envmap_kernels aur_envmap_kernels;

/* A latitude-longitude picture, +y up. Its values stand at azimuths (i + 1/2) / width and, from pole to pole,
 * at polar angles j / rows, and are interpolated between: each patch lies between four of them. */
typedef struct aur_envmap {
    size_t width, rows;
    aur_texel *texels; /* [rows + 1][width + 1]: the first column stands at the end once more */
    float *heights;    /* [rows + 1], the cosines of the rows' polar angles */
    float density;     /* of directions, a steradian, over the luminance that they are drawn by */
    aur_frame frame;   /* the world's directions of the picture's axes */
    aur_patches patches;
    const aur_envmap_kernels *kernels;
} aur_envmap;

/* A place in patch (i, j): s between its columns, and between its rows t by the angle, which radiance is
 * interpolated by, and w by the height, which directions are drawn by; all in [0, 1]. */
typedef struct aur_envmap_place {
    uint32_t i, j;
    float s, t, w;
} aur_envmap_place;

typedef struct aur_envmap_places {
    uint32_t i[AUR_PACKET_SIZE], j[AUR_PACKET_SIZE];
    aur_lane_numbers s, t, w;
} aur_envmap_places;

/* The arithmetic of sixteen directions, for each instruction set; the bits are the same for each, and those
 * of one direction alone. Lanes of no meaning must have a place in the picture, too. */
struct aur_envmap_kernels {
    /* Moves s and w, uniform in the patch whose corners have these luminances, to what is drawn there; sets
     * t, and the world's direction. */
    void (*draw)(const aur_envmap *map, const aur_lane_numbers corner[4], aur_envmap_places *places,
                 aur_lane_vectors *directions);
    /* The places of the world's directions. */
    void (*find)(const aur_envmap *map, const aur_lane_vectors *directions, aur_envmap_places *places);
};

/* By this processor's instructions. */
const aur_envmap_kernels *aur_envmap_kernels_here(void);
