/* Continues paths from a surface in place of the photon map's estimate. Rays that are short compared with the
 * texel that they hit always continue, because radiance varies within the texel as seen from their origin.
 * Others continue with probability p to correct the map's bias: the map is a control variate. With the map's
 * radiance M and a path's radiance L, a continued sample counts M + (L - M) / p. Its mean is that of L for
 * any map (two levels of Giles 2008; Misso and others 2022 have the same for other biased estimators). */
#pragma once

#include "points/base/random.h"
#include "render/film/tile.h"
#include "render/photons/irradiance.h"

typedef struct aur_continuation {
    const aur_scene *scene;
    const aur_irradiance_map *map;
    const aur_irradiance_map *caustics; /* light after specular bounces, if `map` lacks it */
    uint32_t max_depth;                 /* edges of a light path; UINT32_MAX: no limit */
    float share;  /* p, in [0, 1]; with 0 a path ends at the first texel that is far enough */
    float reach;  /* rays shorter than this many widths of the texel that they hit continue */
    bool single;  /* the correction counts without what it corrects */
    bool packets; /* rays of several paths are traced together */
} aur_continuation;

/* Where a path begins. */
typedef struct aur_continuation_start {
    aur_surface surface;
    aur_vector view;         /* unit, of the world */
    uint32_t edges;          /* from the camera to the surface */
    uint64_t hash;           /* seed of the random decisions */
    bool near;               /* the texel is: see aur_continuation_is_near */
    aur_vector map_radiance; /* the map's light */
} aur_continuation_start;

/* Returns the radiance of a path where the texel is near; else the map's radiance corrected by a path. With a
 * share above 0, and aur_continuation_is_due selecting the corrected samples, the mean over hashes is
 * unbiased. With `single`, the result is only the difference from a share of 0. At most sixteen paths are
 * traced together, bounce by bounce, each as it would be alone up to the rounding of packets. */
void aur_continuation_correct(const aur_continuation *continuation, size_t count,
                              const aur_continuation_start *starts, aur_vector *radiance);
/* Whether a ray of this length is short for a texel of this area. */
static inline bool aur_continuation_is_near(const aur_continuation *continuation, float distance,
                                            float area) {
    return distance * distance < continuation->reach * continuation->reach * area;
}
/* Whether the sample with this hash is corrected; and what a sample that is not corrected counts. */
static inline bool aur_continuation_is_due(const aur_continuation *continuation, uint64_t hash) {
    return aur_unit_float((uint32_t)(hash >> 32)) < continuation->share;
}
static inline aur_vector aur_continuation_uncorrected(const aur_continuation *continuation,
                                                      aur_vector map_radiance) {
    return continuation->single ? (aur_vector){0} : map_radiance;
}
