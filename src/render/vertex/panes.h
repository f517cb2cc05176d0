/* Surfaces that let light straight through: panes, masks. */
#pragma once

#include "points/base/internal.h"
#include "render/film/integrator.h"

/* Whether the scene has any. */
AUR_INTERNAL bool aur_panes_exist(const aur_scene *scene);

/* What the surfaces on a ray, at most `most` of them, leave of the light that comes along it; 0 where one of
 * them lets none through. */
aur_vector aur_panes_passed(const aur_scene *scene, const aur_ray *ray, size_t most);
