/* Paths through participating media, one by itself. */
#pragma once

#include "render/film/integrator.h"
#include "render/scene/medium.h"

typedef struct aur_volume_path {
    uint32_t max_depth; /* as aur_path has them: edges between scatterings, at surfaces or in media */
    uint32_t rr_depth;
    bool hide_emitters;
    bool passes; /* some surface lets light straight through; set by whoever makes this ready */
} aur_volume_path;

/* Radiance along one camera ray. */
aur_vector aur_volume_path_radiance(const aur_volume_path *data, const aur_scene *scene,
                                    const aur_camera_sample *sample, aur_counters *counters);
