/* A group of shapes for one instance alone. */
#pragma once

#include "render/scene/scene_data.h"

/* Gives the instance a group with copies of the shapes of its own one, all of them meshes in doubles. Errors:
 * MEMORY. */
aur_result aur_instance_own_group(aur_scene *scene, aur_instance *instance, aur_error *error);
