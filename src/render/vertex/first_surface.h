/* The surface that a camera ray sees. */
#pragma once

#include "render/film/tile.h"

/* The nearest surface along *ray, which begins anew behind each light that it passes when lights are hidden;
 * false when there is none. */
static inline bool aur_visible_surface(const aur_scene *scene, bool hide_emitters, aur_ray *ray,
                                       aur_surface *surface, aur_counters *counters) {
    enum { MOST_LIGHTS = 1000 }; /* hidden ones, one behind the other */
    for (size_t i = 0; i < MOST_LIGHTS; ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, ray, &hit))
            return false;
        aur_scene_surface(scene, ray, &hit, surface);
        if (!hide_emitters || surface->emitter == AUR_NO_EMITTER)
            return true;
        *ray = aur_surface_ray(surface, ray->direction);
    }
    ++counters->cut;
    return false;
}
