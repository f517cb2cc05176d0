/* Paths through participating media, one at a time. */
#pragma once

#include "render/film/integrator.h"
#include "render/film/tile.h"
#include "render/scene/medium.h"

typedef struct aur_volume_path {
    uint32_t max_depth; /* as in aur_path: edges between scatterings, at surfaces or in media */
    uint32_t rr_depth;
    bool hide_emitters;
    float clamp;
    bool passes; /* some surface transmits light unscattered; set by the creator */
} aur_volume_path;

/* Radiance along one camera ray, and its directly visible emission. */
aur_vector aur_volume_path_radiance(const aur_volume_path *data, const aur_scene *scene,
                                    const aur_camera_sample *sample, aur_vector *unscattered,
                                    aur_counters *counters);

/* Light from a light sample, through media and surfaces that transmit it unscattered. */

/* The most transmitting surfaces in sequence on a path or a shadow ray. */
enum { AUR_MOST_PASSED = 1000 };

/* Multiplies `walk` by the transmittance along the ray, which begins in `medium` and ends at the light, or at
 * a point beyond the scene: then `reach` is the distance up to which media attenuate it (aur_light_reach).
 * False: nothing is transmitted. `passes`: surfaces may transmit light. */
bool aur_volume_shadow(const aur_scene *scene, bool passes, float reach, const aur_ray *ray,
                       const aur_medium *medium, aur_medium_walk *walk, aur_counters *counters);
