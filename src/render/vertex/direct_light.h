/* Direct light at a surface point by multiple importance sampling of lights and BSDF (Veach 1997, power
 * heuristic). */
#pragma once

#include "render/film/integrator.h"
#include "render/vertex/shading.h"

/* The weight of a sample drawn with density `pdf` where the rival technique has density `other`. */
static inline float aur_power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* A light sample before it is known whether anything lies between. */
typedef struct aur_shadow {
    aur_ray ray; /* from the surface to the light */
    aur_vector
        radiance; /* reflected towards the viewer if nothing does, by its share in the sum of samples */
} aur_shadow;

/* How many light samples there are at a surface, and how many BSDF samples rival with them. */
typedef struct aur_light_draws {
    float count, rivals;
} aur_light_draws;

static const aur_light_draws AUR_LIGHT_DRAWS_OF_PATHS = {1.0f, 1.0f};

/* One of the light samples; u[0] chooses the light and the others a point on it, in [0,1). False: no light
 * comes that way. */
bool aur_direct_light_choose(const aur_scene *scene, const aur_shading *shading, const aur_light_draws *draws,
                             const float u[3], aur_shadow *shadow);
/* The same of a point that has been drawn. */
bool aur_direct_light_shadow(const aur_shading *shading, const aur_light_draws *draws,
                             const aur_light_sample *light, aur_shadow *shadow);
