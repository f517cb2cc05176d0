/* Whether the rays that leave 16 places in like directions make a coherent packet: where the places lie on
 * one plane, nearly. A function of positions and normals, never of timing. */
#pragma once

#include "points/base/vector.h"

/* 1 where a place is off the plane of another one: `offset` leads there, `normal` is the plane's, and
 * `cosine` that of the angle between the two places' normals. The limits are 6 degrees each. Without
 * branches, for loops over lanes. */
static inline uint32_t aur_is_off_plane(aur_vector offset, aur_vector normal, float cosine) {
    const float height = aur_vector_dot(offset, normal);
    return (uint32_t)(cosine < 0.995f) | (uint32_t)(height * height > 0.01f * aur_vector_dot(offset, offset));
}
