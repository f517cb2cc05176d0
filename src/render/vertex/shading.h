/* A surface point seen from a direction: evaluates its BSDF in world directions. */
#pragma once

#include "render/scene/scene.h"

typedef struct aur_shading {
    const aur_surface *surface;
    aur_vector view; /* local, unit */
} aur_shading;

static inline aur_shading aur_shading_at(const aur_surface *surface, aur_vector view_world) {
    return (aur_shading){surface, aur_frame_to_local(&surface->frame, view_world)};
}

/* The reference point for light sampling. On surfaces that transmit light, it counts from all sides. */
static inline aur_light_reference aur_shading_reference(const aur_shading *shading) {
    const aur_surface *const surface = shading->surface;
    aur_light_reference reference = {.position = surface->position};
    if (!surface->bsdf->transmits) {
        reference.normal = aur_vector_scale(surface->frame.z, shading->view.z < 0.0f ? -1.0f : 1.0f);
        reference.position = aur_surface_leave(surface, reference.normal);
    }
    return reference;
}

/* BSDF * |cos| of a lobe set towards a world direction, and the pdf of aur_shading_draw there. The value is 0
 * if the shading and geometric normals disagree on the side of the light. */
static inline aur_vector aur_shading_evaluate(const aur_shading *shading, aur_bsdf_part part, aur_vector wi,
                                              float *pdf) {
    const aur_surface *const surface = shading->surface;
    const aur_vector light = aur_frame_to_local(&surface->frame, wi);
    *pdf = 0.0f;
    if (aur_vector_dot(surface->geometric_normal, wi) * light.z <= 0.0f)
        return (aur_vector){0};
    return aur_bsdf_evaluate(surface->bsdf, part, surface->texture, shading->view, light, pdf);
}

/* sample->light comes back in world coordinates. */
static inline bool aur_shading_draw(const aur_shading *shading, aur_bsdf_part part, const float u[3],
                                    aur_bsdf_sample *sample) {
    const aur_surface *const surface = shading->surface;
    if (!aur_bsdf_draw(surface->bsdf, part, surface->texture, shading->view, u, sample))
        return false;
    const float side = sample->light.z;
    sample->light = aur_frame_to_world(&surface->frame, sample->light);
    return aur_vector_dot(surface->geometric_normal, sample->light) * side > 0.0f;
}

static inline bool aur_shading_sample(const aur_shading *shading, const float u[3], aur_bsdf_sample *sample) {
    return aur_shading_draw(shading, AUR_BSDF_WHOLE, u, sample);
}
