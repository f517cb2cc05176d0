/* Paths that go on from a surface, in place of a photon map's estimate there. Rays that met a texel nearly as
 * wide as they are long always go on, for the place that they left sees how the light differs within it.
 * Others go on now and then, to take away what the map is wrong by: the map is a control variate. A sample
 * with light M of the map and light L of a path, drawn with probability p, counts M + (L - M) / p, whose mean
 * is that of L whatever the map says (two levels of Giles 2008; Misso and others 2022 have the same for other
 * biased estimators). */
#pragma once

#include "core/random.h"
#include "film/tile.h"
#include "transport/photons/irradiance.h"

typedef struct aur_onward {
    const aur_scene *scene;
    const aur_irradiance_map *map;
    const aur_irradiance_map *caustics; /* of light that specular bounces brought, if `map` lacks it */
    uint32_t max_depth;                 /* edges of a light path; UINT32_MAX: no limit */
    float share; /* p, in [0, 1]; with 0 a path ends at the first texel that is far enough */
    float reach; /* rays that are shorter than so many widths of the texel that they meet go on */
    bool lone;   /* the correction counts without what it corrects */
} aur_onward;

/* What a path draws its numbers by. */
static inline uint64_t aur_onward_walk_hash(uint64_t hash) {
    return aur_mix64(~hash);
}

/* The map's light `known`, or that of a path where the texel is near, or `known` corrected by a path where
 * the hash says so: the mean over hashes is the surface's true light, if the share is not 0. A lone
 * correction is what that is more than it would be with a share of 0. `edges` have led from the eye to the
 * surface, and `view` is unit and of the world. */
aur_vector aur_onward_correct(const aur_onward *onward, const aur_surface *surface, aur_vector view,
                              uint32_t edges, uint64_t hash, bool near, aur_vector known,
                              aur_counters *counters);
/* Asks the memory for what the path of that hash reads first. */
static inline aur_light_fetch aur_onward_fetch(const aur_onward *onward, uint64_t hash) {
    uint64_t walk = aur_onward_walk_hash(hash);
    float u[3];
    aur_draw_units(&walk, u);
    return aur_light_fetch_begin(onward->scene, u);
}
/* Whether a ray of this length is short for a texel of this area. */
static inline bool aur_onward_is_near(const aur_onward *onward, float distance, float area) {
    return distance * distance < onward->reach * onward->reach * area;
}
/* Whether the sample that a hash stands for is one that is corrected, and what counts of one that is not. */
static inline bool aur_onward_is_due(const aur_onward *onward, uint64_t hash) {
    return aur_unit_float((uint32_t)(hash >> 32)) < onward->share;
}
static inline aur_vector aur_onward_kept(const aur_onward *onward, aur_vector known) {
    return onward->lone ? (aur_vector){0} : known;
}
