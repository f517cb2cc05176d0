/* Paths that go on from a surface, in place of a photon map's estimate there. Rays that met a texel nearly as
 * wide as they are long always go on, for the place that they left sees how the light differs within it.
 * Others go on now and then, to take away what the map is wrong by: the map is a control variate. A sample
 * with light M of the map and light L of a path, drawn with probability p, counts M + (L - M) / p, whose mean
 * is that of L whatever the map says (two levels of Giles 2008; Misso and others 2022 have the same for other
 * biased estimators). */
#pragma once

#include "points/base/random.h"
#include "render/film/tile.h"
#include "render/photons/irradiance.h"

typedef struct aur_continuation {
    const aur_scene *scene;
    const aur_irradiance_map *map;
    const aur_irradiance_map *caustics; /* of light that specular bounces brought, if `map` lacks it */
    uint32_t max_depth;                 /* edges of a light path; UINT32_MAX: no limit */
    float share;  /* p, in [0, 1]; with 0 a path ends at the first texel that is far enough */
    float reach;  /* rays that are shorter than so many widths of the texel that they meet go on */
    bool single;  /* the correction counts without what it corrects */
    bool packets; /* rays of several paths are traced together */
} aur_continuation;

/* Where a path begins. */
typedef struct aur_continuation_start {
    aur_surface surface;
    aur_vector view;  /* unit, of the world */
    uint32_t edges;   /* that have led from the eye to the surface */
    uint64_t hash;    /* of what chance decides */
    bool near;        /* the texel is: see aur_continuation_is_near */
    aur_vector known; /* the map's light */
} aur_continuation_start;

/* The light of a path where the texel is near, else the map's corrected by a path: the mean over hashes, if
 * aur_continuation_is_due says which are corrected, is the surface's true light, if the share is not 0. A
 * lone correction is what that is more than it would be with a share of 0. At most sixteen paths go on
 * together, bounce by bounce: each as it would alone, but for the rounding of packets. */
void aur_continuation_correct(const aur_continuation *continuation, size_t count,
                              const aur_continuation_start *starts, aur_vector *radiance);
/* Whether a ray of this length is short for a texel of this area. */
static inline bool aur_continuation_is_near(const aur_continuation *continuation, float distance,
                                            float area) {
    return distance * distance < continuation->reach * continuation->reach * area;
}
/* Whether the sample that a hash stands for is one that is corrected, and what counts of one that is not. */
static inline bool aur_continuation_is_due(const aur_continuation *continuation, uint64_t hash) {
    return aur_unit_float((uint32_t)(hash >> 32)) < continuation->share;
}
static inline aur_vector aur_continuation_kept(const aur_continuation *continuation, aur_vector known) {
    return continuation->single ? (aur_vector){0} : known;
}
