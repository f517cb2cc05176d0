/* What rooms above know of a renderer. */
#pragma once

#include <aureole/render.h>

const aur_scene *aur_renderer_scene(const aur_renderer *renderer);
