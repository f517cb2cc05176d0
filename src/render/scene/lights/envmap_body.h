/* The arithmetic of an environment map's directions, compiled once for each instruction set. Without
 * branches, so that loops become vector code; plain operations in one order without contraction: the bits are
 * the same everywhere. */
#pragma once

#include "points/base/simd.h"
#include "render/scene/lights/arcs.h"
#include "render/scene/lights/envmap.h"
#include "render/scene/materials/sampling.h"

static inline float envmap_part(float x) {
    return aur_smaller(aur_larger(x, 0.0f), 1.0f);
}

/* The local direction of a height and an azimuth in turns, from 0 to below 2. */
static inline aur_vector envmap_direction(float height, float turns) {
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

/* In rows, of the height of a direction. */
static inline float envmap_row(float rows, float height) {
    return aur_arc(aur_smaller(aur_larger(height, -1.0f), 1.0f)) * (rows / AUR_PI_F);
}

/* aur_envmap_kernels::draw of one. */
static inline aur_vector envmap_draw(const aur_envmap *map, const float corner[4], aur_envmap_place *at) {
    const aur_bilinear corners = {{corner[0], corner[1], corner[2], corner[3]}};
    aur_patch_draw(&corners, &at->s, &at->w);
    const float top = map->heights[at->j], bottom = map->heights[at->j + 1];
    const float height = top + at->w * (bottom - top);
    at->t = envmap_part(envmap_row((float)map->rows, height) - (float)at->j);
    const aur_vector local = envmap_direction(height, ((float)at->i + at->s + 0.5f) / (float)map->width);
    return aur_frame_to_world(&map->frame, local);
}

/* aur_envmap_kernels::find of one. */
static inline aur_envmap_place envmap_find(const aur_envmap *map, aur_vector direction) {
    const aur_vector local = aur_frame_to_local(&map->frame, direction);
    const float width = (float)map->width, rows = (float)map->rows;
    const float azimuth = aur_turn(-local.z, local.x) - 0.5f / width;
    const float positive = azimuth < 0.0f ? azimuth + 1.0f : azimuth;
    const float x = aur_smaller(positive, 0x1.fffffep-1f) * width, y = envmap_row(rows, local.y);
    const int i = (int)x, last = (int)map->rows - 1, below = (int)y, j = below < last ? below : last;
    const float top = map->heights[j], bottom = map->heights[j + 1];
    return (aur_envmap_place){(uint32_t)i, (uint32_t)j, x - (float)i, envmap_part(y - (float)j),
                              envmap_part((top - local.y) / (top - bottom))};
}

static void envmap_draw_lanes(const aur_envmap *given, const aur_lane_numbers corner[4],
                              aur_envmap_places *restrict places, aur_lane_vectors *restrict directions) {
    const aur_envmap map = *given; /* which the outputs cannot overlap */
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float corners[4] = {corner[0][k], corner[1][k], corner[2][k], corner[3][k]};
        aur_envmap_place at = {places->i[k], places->j[k], places->s[k], 0.0f, places->w[k]};
        aur_lane_set(directions, k, envmap_draw(&map, corners, &at));
        places->s[k] = at.s;
        places->t[k] = at.t;
        places->w[k] = at.w;
    }
}

static void envmap_find_lanes(const aur_envmap *given, const aur_lane_vectors *restrict directions,
                              aur_envmap_places *restrict places) {
    const aur_envmap map = *given;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_envmap_place at = envmap_find(&map, aur_lane_vector(directions, k));
        places->i[k] = at.i;
        places->j[k] = at.j;
        places->s[k] = at.s;
        places->t[k] = at.t;
        places->w[k] = at.w;
    }
}

#define AUR_ENVMAP_KERNELS                                                                                   \
    { envmap_draw_lanes, envmap_find_lanes }

extern const aur_envmap_kernels aur_envmap_kernels_avx2;
extern const aur_envmap_kernels aur_envmap_kernels_avx512;
