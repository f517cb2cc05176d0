#include "transport/direct_light.h"

bool aur_direct_light_choose(const aur_scene *scene, const aur_shading *shading, float choice,
                             const float position[2], aur_shadow *shadow) {
    const aur_surface *const surface = shading->surface;
    aur_light_sample light;
    if (!aur_light_sample_direct(scene, surface->position, AUR_LEAST_LIGHT_OF_PATHS,
                                 (const float[3]){choice, position[0], position[1]}, &light))
        return false;
    const aur_vector scattered = aur_shading_evaluate(shading, light.direction);
    const aur_vector radiance = aur_vector_multiply(scattered, light.radiance);
    if (!(light.pdf > 0.0f) || aur_vector_is_zero(radiance))
        return false;
    float distance;
    shadow->ray = aur_surface_ray_to(surface, light.position, &distance);
    const float weight =
        light.delta ? 1.0f : aur_power_heuristic(light.pdf, aur_shading_pdf(shading, light.direction));
    shadow->radiance = aur_vector_scale(radiance, weight / light.pdf);
    return true;
}

aur_vector aur_direct_light_sampled(const aur_scene *scene, const aur_shading *shading, float choice,
                                    const float position[2], aur_counters *counters) {
    const aur_vector black = {0};
    aur_shadow shadow;
    if (!aur_direct_light_choose(scene, shading, choice, position, &shadow))
        return black;
    ++counters->rays;
    return aur_scene_occluded(scene, &shadow.ray) ? black : shadow.radiance;
}

/* The BSDF-sampling half. */
static aur_vector reflected_emission(const aur_scene *scene, const aur_shading *shading, const float u[3],
                                     aur_counters *counters) {
    const aur_vector black = {0};
    aur_bsdf_sample sample;
    if (!aur_shading_sample(shading, u, &sample) || sample.specular)
        return black;
    const aur_ray ray = aur_surface_ray(shading->surface, sample.light);
    aur_hit hit;
    ++counters->rays;
    if (!aur_scene_intersect(scene, &ray, &hit)) {
        const aur_vector sky = aur_scene_environment(scene, ray.direction);
        if (aur_vector_is_zero(sky))
            return black;
        const float rival = aur_environment_pdf_direct(scene, ray.direction);
        return aur_vector_scale(aur_vector_multiply(sample.weight, sky),
                                aur_power_heuristic(sample.pdf, rival));
    }
    aur_surface light;
    aur_scene_surface(scene, &ray, &hit, &light);
    const aur_vector emission = aur_surface_emission(scene, &light, aur_vector_scale(ray.direction, -1.0f));
    if (aur_vector_is_zero(emission))
        return black;
    float weight = 1.0f;
    if (!sample.specular)
        weight = aur_power_heuristic(sample.pdf, aur_light_pdf_direct(scene, shading->surface->position,
                                                                      AUR_LEAST_LIGHT_OF_PATHS, &light));
    return aur_vector_scale(aur_vector_multiply(sample.weight, emission), weight);
}

aur_vector aur_direct_light(const aur_scene *scene, const aur_shading *shading, const aur_stream *stream,
                            uint32_t pair, aur_counters *counters) {
    if (aur_scene_emitter_count(scene) == 0)
        return (aur_vector){0};
    float choice[2], position[2], direction[2];
    aur_stream_pair(stream, pair, choice);
    aur_stream_pair(stream, pair + 1, position);
    aur_stream_pair(stream, pair + 2, direction);
    const aur_vector sampled = aur_direct_light_sampled(scene, shading, choice[0], position, counters);
    const float u[3] = {choice[1], direction[0], direction[1]};
    return aur_vector_add(sampled, reflected_emission(scene, shading, u, counters));
}
