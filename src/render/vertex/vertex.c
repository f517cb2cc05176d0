#include "render/vertex/vertex.h"

aur_vector aur_vertex_emission(const aur_scene *scene, const aur_bounce *bounce, aur_vector direction,
                               const aur_surface *surface, float *light_pdf) {
    *light_pdf = 0.0f;
    if (surface == NULL) {
        float pdf;
        const aur_vector sky = aur_environment_light(scene, direction, &pdf);
        *light_pdf = bounce->specular_bounce ? 0.0f : pdf;
        return sky;
    }
    const aur_vector emission = aur_surface_emission(scene, surface, aur_vector_scale(direction, -1.0f));
    if (!bounce->specular_bounce && !aur_vector_is_zero(emission))
        *light_pdf = aur_light_pdf_direct(scene, &bounce->from, surface);
    return emission;
}

static unsigned kinds_of(const aur_shading *shading) {
    return aur_bsdf_scatters(shading->surface->bsdf, shading->view.z);
}

aur_vector aur_vertex_evaluate(const aur_shading *shading, aur_vertex_lobes lobes, aur_vector wi,
                               float *pdf) {
    float unused;
    if (lobes != AUR_VERTEX_UNMAPPED) {
        const aur_vector value = aur_shading_evaluate(shading, AUR_BSDF_WHOLE, wi, pdf);
        if (lobes == AUR_VERTEX_ALL || *pdf == 0.0f || (kinds_of(shading) & AUR_SCATTERS_SAMPLED) == 0)
            return value;
        return aur_vector_subtract(value, aur_shading_evaluate(shading, AUR_BSDF_SAMPLED_LOBES, wi, &unused));
    }
    *pdf = 0.0f;
    if ((kinds_of(shading) & AUR_SCATTERS_SAMPLED) == 0)
        return (aur_vector){0};
    const aur_vector value = aur_shading_evaluate(shading, AUR_BSDF_SAMPLED_LOBES, wi, pdf);
    if ((kinds_of(shading) & AUR_SCATTERS_SPECULAR) != 0 && !aur_vector_is_zero(value))
        aur_shading_evaluate(shading, AUR_BSDF_WHOLE, wi, pdf);
    return value;
}

bool aur_vertex_direction(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3],
                          aur_bsdf_sample *sample) {
    const unsigned kinds = kinds_of(shading);
    if (lobes == AUR_VERTEX_UNMAPPED && (kinds & AUR_SCATTERS_SPECULAR) == 0)
        return (kinds & AUR_SCATTERS_SAMPLED) != 0 &&
               aur_shading_draw(shading, AUR_BSDF_SAMPLED_LOBES, u, sample);
    if (!aur_shading_sample(shading, u, sample))
        return false;
    if (lobes == AUR_VERTEX_ALL)
        return true;
    if (sample->specular)
        return lobes == AUR_VERTEX_UNMAPPED;
    if (lobes == AUR_VERTEX_UNMAPPED && (kinds & AUR_SCATTERS_SAMPLED) == 0)
        return false;
    float pdf;
    const aur_vector value = lobes == AUR_VERTEX_MAPPED
                                 ? aur_vertex_evaluate(shading, lobes, sample->light, &pdf)
                                 : aur_shading_evaluate(shading, AUR_BSDF_SAMPLED_LOBES, sample->light, &pdf);
    sample->weight = aur_vector_scale(value, 1.0f / sample->pdf);
    return sample->pdf > 0.0f;
}

aur_vector aur_vertex_adjoint(const aur_shading *shading, const aur_bsdf_sample *sample, aur_vector in,
                              aur_vector normal, float least) {
    const float cos_in = fabsf(aur_vector_dot(normal, in));
    const float cos_out = fabsf(aur_vector_dot(normal, sample->light));
    const aur_shading reversed = aur_shading_at(shading->surface, sample->light);
    if (!(cos_in > 0.0f))
        return (aur_vector){0};
    if (sample->specular) {
        const float bent =
            fabsf(shading->view.z) * cos_out / (aur_larger(fabsf(reversed.view.z), 1e-6f) * cos_in);
        return aur_vector_scale(sample->weight,
                                bent * (sample->ior_squared > 0.0f ? sample->ior_squared : 1.0f));
    }
    float pdf;
    return aur_vector_scale(aur_shading_evaluate(&reversed, AUR_BSDF_WHOLE, in, &pdf),
                            cos_out / (aur_larger(cos_in, least) * sample->pdf));
}

bool aur_vertex_irradiance(const aur_light_reference *sensor, aur_vertex_samples samples,
                           const aur_light_sample *light, aur_shadow *shadow) {
    const float cosine = aur_vector_dot(sensor->normal, light->direction);
    if (!(light->pdf > 0.0f) || !(cosine > 0.0f))
        return false;
    const float weight = aur_light_weight(light, samples, cosine / AUR_PI_F) / samples.lights;
    if (!aur_shadow_radiance(light, (aur_vector){1.0f, 1.0f, 1.0f}, weight * cosine, shadow))
        return false;
    shadow->ray = aur_ray_between(sensor->position, light->position);
    return true;
}

bool aur_vertex_light(const aur_shading *shading, aur_vertex_lobes lobes, aur_vertex_samples samples,
                      const aur_light_sample *light, aur_shadow *shadow) {
    float pdf;
    if (!(light->pdf > 0.0f))
        return false;
    const aur_vector value = aur_vertex_evaluate(shading, lobes, light->direction, &pdf);
    return !aur_vector_is_zero(value) &&
           aur_vertex_shadow(shading->surface, light, value,
                             aur_light_weight(light, samples, pdf) / samples.lights, shadow);
}

bool aur_vertex_draw_light(const aur_scene *scene, const aur_shading *shading, aur_vertex_lobes lobes,
                           aur_vertex_samples samples, const float u[3], aur_shadow *shadow) {
    const aur_light_reference reference = aur_shading_reference(shading);
    aur_light_sample light;
    return aur_light_sample_direct(scene, &reference, u, &light) &&
           aur_vertex_light(shading, lobes, samples, &light, shadow);
}

void aur_walk_add_emission(const aur_scene *scene, const aur_surface *surface, aur_walk *walk) {
    float light_pdf;
    if (surface != NULL && surface->emitter == AUR_NO_EMITTER)
        return;
    const aur_vector emission =
        aur_vertex_emission(scene, &walk->bounce, walk->ray.direction, surface, &light_pdf);
    if (!aur_vector_is_zero(emission))
        walk->radiance = aur_vector_add_scaled(walk->radiance, aur_bounce_weight(&walk->bounce, light_pdf),
                                               aur_vector_multiply(walk->beta, emission));
}

bool aur_walk_scatter(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3], aur_walk *walk) {
    aur_bsdf_sample sample;
    if (!aur_vertex_direction(shading, lobes, u, &sample))
        return false;
    walk->beta = aur_vector_multiply(walk->beta, sample.weight);
    walk->ray = aur_surface_ray(shading->surface, sample.light);
    walk->bounce = (aur_bounce){aur_shading_reference(shading), sample.pdf, 1.0f, sample.specular};
    return !aur_vector_is_zero(walk->beta);
}

bool aur_panes_exist(const aur_scene *scene) {
    for (size_t i = 0; i < aur_scene_shape_count(scene); ++i)
        if (aur_scene_shape_bsdf(scene, i)->passes)
            return true;
    return false;
}

aur_ray aur_ray_behind(const aur_ray *ray, const aur_surface *surface) {
    aur_ray rest = aur_surface_ray(surface, ray->direction);
    if (!isfinite(ray->farthest))
        return rest;
    double end[3], from[3], direction[3];
    aur_vector_to_doubles(ray->direction, direction);
    aur_vector_to_doubles(ray->origin, end);
    aur_vector_to_doubles(rest.origin, from);
    for (size_t d = 0; d < 3; ++d)
        end[d] += (double)ray->farthest * direction[d] - from[d];
    const aur_vector left = {(float)end[0], (float)end[1], (float)end[2]};
    rest.farthest = aur_vector_dot(left, ray->direction) > 0.0f ? aur_vector_length(left) : 0.0f;
    if (rest.farthest > 0.0f)
        rest.direction = aur_vector_scale(left, 1.0f / rest.farthest);
    return rest;
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
        rest = aur_ray_behind(ray, &surface);
    }
    return (aur_vector){0};
}
