/* Environment map: tables to sample directions and to look up radiance. */
#pragma once

#include "points/base/simd.h"
#include "render/scene/lanes.h"
#include "render/scene/lights/arcs.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/patches.h"

/* Red, green, blue, and in proportion to what directions are sampled for light. */
typedef float aur_texel __attribute__((vector_size(16)));

typedef struct aur_envmap_kernels aur_envmap_kernels;

/* A latitude-longitude image, +y up. Values are at azimuths (i + 1/2) / width and, from pole to pole, at
 * polar angles j / rows. They are interpolated: each patch lies between four of them. */
typedef struct aur_envmap {
    size_t width, rows;
    aur_texel *texels;               /* [rows + 1][width + 1]: the first column is repeated at the end */
    float *heights;                  /* [rows + 1]: cosines of the rows' polar angles */
    aur_frame frame;                 /* the image axes as world directions */
    aur_patches patches, emission;   /* by the fourth values of texels, and by luminance, for particles */
    float density, emission_density; /* pdf by solid angle over these values, interpolated */
    const aur_envmap_kernels *kernels;
} aur_envmap;

/* A position in patch (i, j): s across columns; across rows t by polar angle, used to interpolate radiance,
 * and w by height, used to sample directions. All are in [0, 1]. */
typedef struct aur_envmap_position {
    uint32_t i, j;
    float s, t, w;
} aur_envmap_position;

typedef struct aur_envmap_positions {
    uint32_t i[AUR_PACKET_SIZE], j[AUR_PACKET_SIZE];
    aur_lane_numbers s, t, w;
} aur_envmap_positions;

/* Kernels for 16 directions, one per instruction set; all are bit-identical to the scalar functions. Masked
 * lanes must be valid positions too. */
struct aur_envmap_kernels {
    /* Warps s and w, uniform in the patch with these corner luminances; sets t and the world direction. */
    void (*draw)(const aur_envmap *map, const aur_lane_numbers corner[4], aur_envmap_positions *positions,
                 aur_lane_vectors *directions);
    /* The map positions of world directions. */
    void (*find)(const aur_envmap *map, const aur_lane_vectors *directions, aur_envmap_positions *positions);
};

AUR_KERNELS(const aur_envmap_kernels, aur_envmap_kernels);

static inline float aur_envmap_part(float x) {
    return aur_smaller(aur_larger(x, 0.0f), 1.0f);
}

/* The local direction with this height, and azimuth in turns, 0 to below 2. */
static inline aur_vector aur_envmap_direction(float height, float turns) {
    const int nearest = (int)(4.0f * turns + 0.5f);
    float cosine, sine;
    aur_eighth_turn(8.0f * (turns - 0.25f * (float)nearest), &cosine, &sine);
    const bool odd = (nearest & 1) != 0;
    const float first = odd ? sine : cosine, second = odd ? cosine : sine;
    const float x = (nearest & 2) != 0 ? -second : second;
    const float z = ((nearest + 1) & 2) != 0 ? first : -first;
    const float radius = sqrtf(aur_larger(1.0f - height * height, 0.0f));
    return (aur_vector){radius * x, height, radius * z};
}

/* Row coordinate of a direction's height. */
static inline float aur_envmap_row(float rows, float height) {
    return aur_arc(aur_smaller(aur_larger(height, -1.0f), 1.0f)) * (rows / AUR_PI_F);
}

/* Scalar form of aur_envmap_kernels::draw. */
static inline aur_vector aur_envmap_draw(const aur_envmap *map, const float corner[4],
                                         aur_envmap_position *at) {
    const aur_bilinear corners = {{corner[0], corner[1], corner[2], corner[3]}};
    aur_patch_draw(&corners, &at->s, &at->w);
    const float top = map->heights[at->j], bottom = map->heights[at->j + 1];
    const float height = top + at->w * (bottom - top);
    at->t = aur_envmap_part(aur_envmap_row((float)map->rows, height) - (float)at->j);
    const aur_vector local = aur_envmap_direction(height, ((float)at->i + at->s + 0.5f) / (float)map->width);
    return aur_frame_to_world(&map->frame, local);
}

/* Scalar form of aur_envmap_kernels::find. */
static inline aur_envmap_position aur_envmap_find(const aur_envmap *map, aur_vector direction) {
    const aur_vector local = aur_frame_to_local(&map->frame, direction);
    const float width = (float)map->width, rows = (float)map->rows;
    const float azimuth = aur_turn(-local.z, local.x) - 0.5f / width;
    const float positive = azimuth < 0.0f ? azimuth + 1.0f : azimuth;
    const float x = aur_smaller(positive, 0x1.fffffep-1f) * width, y = aur_envmap_row(rows, local.y);
    const int i = (int)x, last = (int)map->rows - 1, below = (int)y, j = below < last ? below : last;
    const float top = map->heights[j], bottom = map->heights[j + 1];
    return (aur_envmap_position){(uint32_t)i, (uint32_t)j, x - (float)i, aur_envmap_part(y - (float)j),
                                 aur_envmap_part((top - local.y) / (top - bottom))};
}
