/* Surfaces in one plane: the first in the file wins. */
#pragma once

#include "render/scene/scene_data.h"

/* Cuts off meshes what triangles that come before, in the order of shapes and triangles, cover in their plane
 * (overlaps.h), before they are recentred: rays and lights then meet the first of such surfaces only. Shapes
 * of groups are cut by others of their group alone. Leaves in scene->overlap how many triangles were cut, and
 * the first pair. Does what scene->overlap_rule says. Errors: MEMORY. */
aur_result aur_scene_cut_overlaps(aur_scene *scene, size_t threads, aur_error *error);

/* One counted warning, if something was cut. */
void aur_scene_warn_of_overlaps(const aur_scene *scene, const aur_warnings *warnings);
