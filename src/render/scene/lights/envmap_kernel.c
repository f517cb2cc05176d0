/* Arithmetic of environment map directions. Branch-free, so that loops vectorise. Operations are not
 * contracted or reordered: results are bit-identical for all instruction sets. */
#include "render/scene/lights/envmap.h"

static void envmap_draw_lanes(const aur_envmap *given, const aur_lane_numbers corner[4],
                              aur_envmap_positions *restrict positions,
                              aur_lane_vectors *restrict directions) {
    const aur_envmap map = *given; /* outputs must not alias these */
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float corners[4] = {corner[0][k], corner[1][k], corner[2][k], corner[3][k]};
        aur_envmap_position at = {positions->i[k], positions->j[k], positions->s[k], 0.0f, positions->w[k]};
        aur_lane_set(directions, k, aur_envmap_draw(&map, corners, &at));
        positions->s[k] = at.s;
        positions->t[k] = at.t;
        positions->w[k] = at.w;
    }
}

static void envmap_find_lanes(const aur_envmap *given, const aur_lane_vectors *restrict directions,
                              aur_envmap_positions *restrict positions) {
    const aur_envmap map = *given;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_envmap_position at = aur_envmap_find(&map, aur_lane_vector(directions, k));
        positions->i[k] = at.i;
        positions->j[k] = at.j;
        positions->s[k] = at.s;
        positions->t[k] = at.t;
        positions->w[k] = at.w;
    }
}

const aur_envmap_kernels AUR_KERNEL(aur_envmap_kernels) = {envmap_draw_lanes, envmap_find_lanes};
