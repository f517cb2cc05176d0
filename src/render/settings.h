/* What a render is to do: the caller's options, with the scene's own values in the places that were left
 * open. */
#pragma once

#include <aureole/render.h>

#include "scene/scene.h"

typedef struct aur_render_settings {
    size_t width, height, samples_per_pixel;
    size_t x0, x1, y0, y1;
    const aur_filter *filter;
    const char *sampler;
    uint64_t seed;
    size_t threads;
    aur_progress progress;
    aur_warnings warnings;
} aur_render_settings;

/* Errors: NAME for a filter, ARGUMENT for a crop. */
aur_result aur_render_settings_read(const aur_scene *scene, const aur_render_options *options,
                                    aur_render_settings *settings, aur_error *error);
