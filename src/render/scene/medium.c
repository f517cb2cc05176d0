/* Which medium a ray is in. */
#include "render/scene/medium.h"

#include "render/scene/scene_data.h"

/* The first medium that a shape bounds or that contains the camera; unreferenced media do not count. */
static const aur_medium *first_of(const aur_scene *scene) {
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_shape *const shape = scene->shapes[i];
        if (shape->bounds_media)
            return shape->interior != NULL ? shape->interior : shape->exterior;
    }
    return scene->sensor.medium;
}

bool aur_scene_has_media(const aur_scene *scene) {
    return first_of(scene) != NULL;
}

const aur_medium *aur_scene_camera_medium(const aur_scene *scene) {
    return scene->sensor.medium;
}

void aur_surface_medium(const aur_scene *scene, const aur_surface *surface, aur_vector direction,
                        const aur_medium **medium) {
    const aur_shape *const shape = scene->shapes[surface->shape];
    if (shape->bounds_media)
        *medium =
            aur_vector_dot(direction, surface->geometric_normal) > 0.0f ? shape->exterior : shape->interior;
}

float aur_light_reach(const aur_scene *scene, const aur_light_sample *sample, aur_vector reference) {
    if (sample->environment)
        return INFINITY;
    if (!scene->emitters[sample->emitter]->descriptor->is_far)
        return sample->distance;
    const float distance_to_center = aur_vector_length(aur_vector_subtract(scene->center, reference));
    return 2.0f * aur_larger(scene->radius, distance_to_center);
}

aur_result aur_scene_refuse_media(const aur_scene *scene, const char *what, aur_error *error) {
    const aur_medium *const first = first_of(scene);
    return first == NULL
               ? AUR_OK
               : aur_fail_at(error, first->location, AUR_ERROR_UNSUPPORTED,
                             "%s takes no media: 'volpath' is the integrator for scenes with them", what);
}

void aur_scene_warn_of_media(const aur_scene *scene, const char *what, const aur_warnings *warnings) {
    const aur_medium *const first = first_of(scene);
    if (first != NULL)
        aur_warn_at(warnings, first->location, "%s leaves media out: 'volpath' renders them", what);
}
