#include "render/vertex/panes.h"

bool aur_panes_exist(const aur_scene *scene) {
    for (size_t i = 0; i < aur_scene_shape_count(scene); ++i)
        if (aur_scene_shape_bsdf(scene, i)->passes)
            return true;
    return false;
}

aur_vector aur_panes_passed(const aur_scene *scene, const aur_ray *ray, size_t most) {
    aur_vector left = {1.0f, 1.0f, 1.0f};
    aur_ray rest = *ray;
    for (size_t i = 0; i <= most && !aur_vector_is_zero(left); ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, &rest, &hit))
            return left;
        aur_surface surface;
        aur_scene_surface(scene, &rest, &hit, &surface);
        const aur_vector view = aur_vector_scale(rest.direction, -1.0f);
        left = aur_vector_multiply(
            left, aur_bsdf_passed(surface.bsdf, surface.texture, aur_frame_to_local(&surface.frame, view)));
        const float farthest = rest.farthest - hit.distance;
        rest = aur_surface_ray(&surface, rest.direction);
        rest.farthest = farthest;
    }
    return (aur_vector){0};
}
