/* Radiance along one gather ray, which may go on from mirrors, glass and rough facets. */
#pragma once

#include "transport/gather/plan.h"

enum { AUR_LONGEST_CHAIN = 16 }; /* bounces in a row that are followed */

/* A ray that has left a gathering point. */
typedef struct aur_gather_ray {
    aur_ray ray;
    aur_vector reference; /* the point */
    float density;        /* as in aur_gather_rays */
    uint64_t hash;        /* of what chance decides on its way */
} aur_gather_ray;

/* `hit` is the ray's first one, or NULL when it left the scene. */
aur_vector aur_gather_chain_radiance(const aur_gather_plan *plan, const aur_gather_ray *from,
                                     const aur_hit *hit, aur_counters *counters);
