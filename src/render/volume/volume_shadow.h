/* Light on its way from a point on a light, through media and surfaces that let it straight on. */
#pragma once

#include "render/film/tile.h"
#include "render/scene/medium.h"

/* At most so many surfaces that let light through follow one another on a path or a shadow ray. */
enum { AUR_MOST_PASSED = 1000 };

/* Multiplies `walk` by what is left of the light along the ray, which begins in `medium` and ends at the
 * light, or at a point beyond the scene: then `reach` says how far media take from it (aur_light_reach).
 * False: nothing is left. `passes`: surfaces may let light through. */
bool aur_volume_shadow(const aur_scene *scene, bool passes, float reach, const aur_ray *ray,
                       const aur_medium *medium, aur_medium_walk *walk, aur_counters *counters);
