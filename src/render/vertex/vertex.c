#include "render/vertex/vertex.h"

bool aur_direct_light_choose(const aur_scene *scene, const aur_shading *shading, const aur_light_draws *draws,
                             const float u[3], aur_shadow *shadow) {
    aur_light_sample light;
    return aur_shading_draw_light(scene, shading, u, &light) &&
           aur_direct_light_shadow(shading, draws, &light, shadow);
}

bool aur_direct_light_shadow(const aur_shading *shading, const aur_light_draws *draws,
                             const aur_light_sample *light, aur_shadow *shadow) {
    float pdf;
    if (!(light->pdf > 0.0f))
        return false;
    const aur_vector scattered = aur_shading_evaluate(shading, light->direction, &pdf);
    const aur_vector radiance = aur_vector_multiply(scattered, light->radiance);
    if (aur_vector_is_zero(radiance))
        return false;
    float distance;
    shadow->ray = aur_surface_ray_to(shading->surface, light->position, &distance);
    const float weight =
        light->delta ? 1.0f : aur_power_heuristic(draws->count * light->pdf, draws->rivals * pdf);
    shadow->radiance = aur_vector_scale(radiance, weight / draws->count / light->pdf);
    return true;
}
