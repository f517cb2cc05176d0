/* Paths that go on from a surface, to take away what a photon map's estimate there is wrong by: the map is a
 * control variate. A sample with light M of the map and light L of a path, drawn with probability p, counts
 * M + (L - M) / p, whose mean is that of L whatever the map says (two levels of Giles 2008; Misso and others
 * 2022 have the same for other biased estimators). */
#pragma once

#include "core/random.h"
#include "film/tile.h"
#include "transport/photons/irradiance.h"

typedef struct aur_onward {
    const aur_scene *scene;
    const aur_irradiance_map *map;
    uint32_t max_depth; /* edges of a light path; UINT32_MAX: no limit */
    float share;        /* p, in (0, 1] */
} aur_onward;

/* What a surface scatters towards `view` (world, unit) by the lobes that the map answers for, the diffuse
 * ones and those with a power of a cosine, along one random path. `edges` have led from the eye to the
 * surface; `hash` stands for the path's numbers. */
aur_vector aur_onward_scattered(const aur_onward *onward, const aur_surface *surface, aur_vector view,
                                uint32_t edges, uint64_t hash, aur_counters *counters);

/* The map's light `known`, now and then corrected by a path: its mean is the surface's true light. */
aur_vector aur_onward_correct(const aur_onward *onward, const aur_surface *surface, aur_vector view,
                              uint32_t edges, uint64_t hash, aur_vector known, aur_counters *counters);
/* Whether the sample that a hash stands for is one that is corrected. */
static inline bool aur_onward_is_due(const aur_onward *onward, uint64_t hash) {
    return aur_unit_float((uint32_t)(hash >> 32)) < onward->share;
}
