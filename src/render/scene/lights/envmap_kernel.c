/* The arithmetic of an environment map's directions. Without
 * branches, so that loops become vector code; plain operations in one order without contraction: the bits are
 * the same everywhere. */
#include "render/scene/lights/envmap.h"

static void envmap_draw_lanes(const aur_envmap *given, const aur_lane_numbers corner[4],
                              aur_envmap_places *restrict places, aur_lane_vectors *restrict directions) {
    const aur_envmap map = *given; /* which the outputs cannot overlap */
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float corners[4] = {corner[0][k], corner[1][k], corner[2][k], corner[3][k]};
        aur_envmap_place at = {places->i[k], places->j[k], places->s[k], 0.0f, places->w[k]};
        aur_lane_set(directions, k, aur_envmap_draw(&map, corners, &at));
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
        const aur_envmap_place at = aur_envmap_find(&map, aur_lane_vector(directions, k));
        places->i[k] = at.i;
        places->j[k] = at.j;
        places->s[k] = at.s;
        places->t[k] = at.t;
        places->w[k] = at.w;
    }
}

const aur_envmap_kernels AUR_KERNEL(aur_envmap_kernels) = {envmap_draw_lanes, envmap_find_lanes};
