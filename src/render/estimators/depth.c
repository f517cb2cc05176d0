/* Depth: the distance along the camera ray in all three channels, 0 where it hits nothing. */
#include "render/film/integrator.h"

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    aur_hit hit;
    (void)counters;
    if (!aur_scene_intersect(integrator->scene, &sample->ray, &hit))
        return (aur_vector){0};
    return (aur_vector){hit.distance, hit.distance, hit.distance};
}

const aur_integrator_descriptor aur_integrator_depth = {
    .row = {.name = "depth",
            .summary = "distance along the camera ray to the first surface",
            .source = "Mitsuba 3"},
    .radiance = radiance,
    .own_image = true,
};
