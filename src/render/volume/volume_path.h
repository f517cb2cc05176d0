/* Paths through participating media, one by itself. */
#pragma once

#include "render/film/integrator.h"
#include "render/film/tile.h"
#include "render/scene/medium.h"

typedef struct aur_volume_path {
    uint32_t max_depth; /* as aur_path has them: edges between scatterings, at surfaces or in media */
    uint32_t rr_depth;
    bool hide_emitters;
    float clamp;
    bool passes; /* some surface lets light straight through; set by whoever makes this ready */
} aur_volume_path;

/* Radiance along one camera ray, and what of it lights send straight. */
aur_vector aur_volume_path_radiance(const aur_volume_path *data, const aur_scene *scene,
                                    const aur_camera_sample *sample, aur_vector *straight,
                                    aur_counters *counters);

/* Light on its way from a point on a light, through media and surfaces that let it straight on. */

/* At most so many surfaces that let light through follow one another on a path or a shadow ray. */
enum { AUR_MOST_PASSED = 1000 };

/* Multiplies `walk` by what is left of the light along the ray, which begins in `medium` and ends at the
 * light, or at a point beyond the scene: then `reach` says how far media take from it (aur_light_reach).
 * False: nothing is left. `passes`: surfaces may let light through. */
bool aur_volume_shadow(const aur_scene *scene, bool passes, float reach, const aur_ray *ray,
                       const aur_medium *medium, aur_medium_walk *walk, aur_counters *counters);
