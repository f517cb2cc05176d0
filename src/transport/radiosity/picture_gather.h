/* Indirect light at a point (Keller 1994, eq. 9): directions distributed as sin^2 theta, one pattern an image
 * turned at random at every point, and the solution's radiance where they end. */
#pragma once

#include <aureole/quadrature.h>

#include "transport/radiosity/picture_direct.h"
#include "transport/radiosity/solution.h"

typedef struct aur_radiosity_gather {
    const aur_radiosity_scene *scene;
    aur_vector
        *exitance; /* patch -> power received / (pi area): times the albedo it is the reflected radiance */
    size_t count;
    float *x, *y, *z, *weights; /* of the pattern, about +z; the weights are for cos / pi */
} aur_radiosity_gather;

/* `rule` is read for set, points and weights. */
aur_result aur_radiosity_gather_create(const aur_radiosity *radiosity, const aur_rule_options *rule,
                                       aur_radiosity_gather *gather, aur_error *error);
void aur_radiosity_gather_release(aur_radiosity_gather *gather);

/* The irradiance over pi at a place; `hash` turns the pattern. */
aur_vector aur_radiosity_gather_at(const aur_radiosity_gather *gather, const aur_radiosity_place *place,
                                   uint64_t hash, uint64_t *rays);
