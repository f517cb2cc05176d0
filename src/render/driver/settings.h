/* What a render is to do. */
#pragma once

#include <aureole-render/render.h>

#include "render/scene/scene.h"

/* Puts the scene's own values into the options in the places that were left open, and finds the filter.
 * Errors: NAME for a filter, ARGUMENT for a crop. */
aur_result aur_render_options_complete(const aur_scene *scene, aur_render_options *options,
                                       const aur_filter **filter, aur_error *error);
