/* A surface point seen from a direction: its BSDF asked in world directions. */
#ifndef AUR_TRANSPORT_LIGHTS_SHADING_H
#define AUR_TRANSPORT_LIGHTS_SHADING_H

#include "scene/scene.h"

typedef struct aur_shading {
    const aur_surface *surface;
    aur_vector view; /* local, unit */
} aur_shading;

static inline aur_shading aur_shading_at(const aur_surface *surface, aur_vector view_world) {
    return (aur_shading){surface, aur_frame_to_local(&surface->frame, view_world)};
}

/* BSDF * |cos| towards a world direction. A light on one side of the surface and shaded on the other is
 * black. */
static inline aur_vector aur_shading_evaluate(const aur_shading *shading, aur_vector light_world) {
    const aur_surface *const surface = shading->surface;
    const aur_vector light = aur_frame_to_local(&surface->frame, light_world);
    if (aur_vector_dot(surface->geometric_normal, light_world) * light.z <= 0.0f)
        return (aur_vector){0};
    return surface->bsdf->descriptor->evaluate(surface->bsdf, surface->texture, shading->view, light);
}

static inline float aur_shading_pdf(const aur_shading *shading, aur_vector light_world) {
    const aur_surface *const surface = shading->surface;
    const aur_vector light = aur_frame_to_local(&surface->frame, light_world);
    return surface->bsdf->descriptor->pdf(surface->bsdf, surface->texture, shading->view, light);
}

/* sample->light comes back in world coordinates. */
static inline bool aur_shading_sample(const aur_shading *shading, const float u[3], aur_bsdf_sample *sample) {
    const aur_surface *const surface = shading->surface;
    if (!surface->bsdf->descriptor->sample(surface->bsdf, surface->texture, shading->view, u, sample))
        return false;
    const float side = sample->light.z;
    sample->light = aur_frame_to_world(&surface->frame, sample->light);
    return aur_vector_dot(surface->geometric_normal, sample->light) * side > 0.0f;
}

/* What one lobe with a formula has towards a local direction: BSDF * |cos|. */
static inline aur_vector aur_lobe_value(const aur_bsdf_lobe *lobe, aur_vector light) {
    const float along = aur_vector_dot(lobe->axis, light);
    if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || along <= 0.0f)
        return (aur_vector){0};
    const float power = lobe->exponent == 1.0f ? along : powf(along, lobe->exponent);
    const float factor = aur_lobe_factor(lobe, fabsf(light.z));
    return aur_vector_scale(lobe->coefficient,
                            factor * (lobe->times_cosine ? power * fabsf(light.z) : power));
}

#endif
