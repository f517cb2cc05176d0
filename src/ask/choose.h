/* Which integrator answers a wish. */
#pragma once

#include "scene/scene.h"

/* NAME[:key=value] as aur_render_options take it; NULL keeps the scene's own. A new text. Errors: MEMORY. */
aur_result aur_ask_choose(const aur_scene *scene, const char *wanted, char **integrator, aur_error *error);
