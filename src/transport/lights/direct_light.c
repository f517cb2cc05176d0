#include "transport/lights/direct_light.h"

bool aur_direct_light_choose(const aur_scene *scene, const aur_shading *shading, float choice,
                             const float position[2], aur_shadow *shadow) {
    const aur_surface *const surface = shading->surface;
    aur_light_sample light;
    if (!aur_light_sample_direct(scene, surface->position, AUR_LEAST_LIGHT_OF_PATHS,
                                 (const float[3]){choice, position[0], position[1]}, &light))
        return false;
    float pdf;
    const aur_vector scattered = aur_shading_evaluate_with_pdf(shading, light.direction, &pdf);
    const aur_vector radiance = aur_vector_multiply(scattered, light.radiance);
    if (!(light.pdf > 0.0f) || aur_vector_is_zero(radiance))
        return false;
    float distance;
    shadow->ray = aur_surface_ray_to(surface, light.position, &distance);
    const float weight = light.delta ? 1.0f : aur_power_heuristic(light.pdf, pdf);
    shadow->radiance = aur_vector_scale(radiance, weight / light.pdf);
    return true;
}
