/* Selection of lights, and sampling of points and directions on them. */
#include "render/scene/scene_data.h"

bool aur_light_sample_chosen(const aur_scene *scene, const aur_chosen_light *chosen,
                             const aur_light_reference *reference, const float u[3],
                             aur_light_sample *sample) {
    const aur_emitter *const emitter = chosen->emitter;
    const aur_light_query query = {.reference = *reference, .u = {u[0], u[1], u[2]}, .part = chosen->part};
    *sample = (aur_light_sample){0};
    if (!emitter->descriptor->sample(emitter, &query, sample))
        return false;
    sample->pdf *= chosen->probability;
    sample->emitter = emitter->index;
    sample->environment = emitter->descriptor->radiance_from != NULL;
    /* Overlapping environments count as one light, as for rays that reach them. */
    if (sample->environment && scene->environment_count > 1) {
        sample->radiance = aur_environment_light(scene, sample->direction, &sample->pdf);
    }
    return true;
}

bool aur_light_sample_direct(const aur_scene *scene, const aur_light_reference *reference, const float u[3],
                             aur_light_sample *sample) {
    float rest[3] = {u[0], u[1], u[2]};
    aur_chosen_light chosen;
    return aur_light_choose(scene, reference, rest, &chosen) &&
           aur_light_sample_chosen(scene, &chosen, reference, rest, sample);
}

float aur_light_pdf_direct(const aur_scene *scene, const aur_light_reference *reference,
                           const aur_surface *surface) {
    if (surface->emitter == AUR_NO_EMITTER)
        return 0.0f;
    const aur_emitter *const emitter = scene->emitters[surface->emitter];
    if (!aur_emitter_glows(emitter))
        return 0.0f;
    const aur_vector way = aur_vector_subtract(surface->position, reference->position);
    const float squared = aur_vector_dot(way, way);
    const float cosine = -aur_vector_dot(way, surface->geometric_normal) / sqrtf(squared);
    if (!(cosine > 0.0f))
        return 0.0f;
    const float pdf = emitter->descriptor->pdf_seen(emitter, reference, surface, cosine);
    return isfinite(pdf) ? aur_light_choice_probability(scene, reference, surface) * pdf : 0.0f;
}

aur_vector aur_surface_emission(const aur_scene *scene, const aur_surface *surface, aur_vector view) {
    if (surface->emitter == AUR_NO_EMITTER || !(aur_vector_dot(view, surface->geometric_normal) > 0.0f))
        return (aur_vector){0};
    const aur_emitter *const emitter = scene->emitters[surface->emitter];
    return aur_emitter_glows(emitter) ? aur_color_at(&emitter->radiance, surface->texture) : (aur_vector){0};
}

void aur_surface_prefetch(const aur_scene *scene, const aur_surface *surface) {
    const aur_bsdf *const bsdf = surface->bsdf;
    for (size_t i = 0; i < bsdf->texture_count; ++i)
        bsdf->textures[i]->descriptor->prefetch(bsdf->textures[i], surface->texture);
    if (surface->emitter == AUR_NO_EMITTER)
        return;
    const aur_texture *const texture = scene->emitters[surface->emitter]->radiance.texture;
    if (texture != NULL && texture->descriptor->prefetch != NULL)
        texture->descriptor->prefetch(texture, surface->texture);
}

/* Lights that no ray can hit: points and single directions. */
static bool is_hidden(const aur_emitter *emitter) {
    return !aur_emitter_glows(emitter) && emitter->descriptor->radiance_from == NULL;
}

bool aur_scene_has_hidden_light(const aur_scene *scene) {
    for (size_t i = 0; i < scene->emitter_count; ++i)
        if (is_hidden(scene->emitters[i]))
            return true;
    return false;
}

bool aur_light_emit(const aur_scene *scene, const float u[5], aur_ray *ray, aur_vector *power, bool *hidden) {
    float rest[5] = {u[0], u[1], u[2], u[3], u[4]};
    if (!(scene->lights.total > 0.0))
        return false;
    const size_t chosen = aur_distribution_choose(&scene->lights, &rest[0]);
    const aur_emitter *const emitter = scene->emitters[chosen];
    if (!emitter->descriptor->emit(emitter, rest, ray, power))
        return false;
    const float probability = (float)aur_distribution_probability(&scene->lights, chosen);
    *power = aur_vector_scale(*power, 1.0f / probability);
    *hidden = is_hidden(emitter);
    return true;
}

bool aur_scene_has_environment(const aur_scene *scene) {
    return scene->environment_count > 0;
}

aur_vector aur_scene_environment(const aur_scene *scene, aur_vector direction) {
    aur_vector sum = {0};
    for (size_t i = 0; i < scene->environment_count; ++i) {
        const aur_emitter *const emitter = scene->environments[i];
        sum = aur_vector_add(sum, emitter->descriptor->radiance_from(emitter, direction));
    }
    return sum;
}

bool aur_scene_has_background(const aur_scene *scene) {
    return scene->has_background || scene->environment_count > 0;
}

aur_vector aur_scene_background(const aur_scene *scene, aur_vector direction) {
    const float *const color = scene->background;
    return scene->has_background ? (aur_vector){color[0], color[1], color[2]}
                                 : aur_scene_environment(scene, direction);
}

float aur_environment_pdf_direct(const aur_scene *scene, aur_vector direction) {
    float sum = 0.0f;
    for (size_t i = 0; i < scene->environment_count; ++i) {
        const aur_emitter *const emitter = scene->environments[i];
        sum += emitter->probability * emitter->descriptor->pdf_from(emitter, direction);
    }
    return sum;
}

aur_vector aur_environment_light(const aur_scene *scene, aur_vector direction, float *pdf) {
    aur_vector sum = {0};
    *pdf = 0.0f;
    for (size_t i = 0; i < scene->environment_count; ++i) {
        const aur_emitter *const emitter = scene->environments[i];
        float density;
        sum = aur_vector_add(sum, aur_emitter_light_from(emitter, direction, &density));
        *pdf += emitter->probability * density;
    }
    return sum;
}

size_t aur_scene_emitter_count(const aur_scene *scene) {
    return scene->emitter_count;
}
