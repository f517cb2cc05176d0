/* A surface point seen from a direction: its BSDF asked in world directions. */
#pragma once

#include "scene/scene.h"

typedef struct aur_shading {
    const aur_surface *surface;
    aur_vector view; /* local, unit */
} aur_shading;

static inline aur_shading aur_shading_at(const aur_surface *surface, aur_vector view_world) {
    return (aur_shading){surface, aur_frame_to_local(&surface->frame, view_world)};
}

/* BSDF * |cos| towards a world direction, and the density that aur_shading_sample has there. A light on one
 * side of the surface and shaded on the other is black. */
static inline aur_vector aur_shading_evaluate(const aur_shading *shading, aur_vector light_world,
                                              float *pdf) {
    const aur_surface *const surface = shading->surface;
    const aur_vector light = aur_frame_to_local(&surface->frame, light_world);
    *pdf = 0.0f;
    if (aur_vector_dot(surface->geometric_normal, light_world) * light.z <= 0.0f)
        return (aur_vector){0};
    return aur_bsdf_evaluate(surface->bsdf, AUR_BSDF_WHOLE, surface->texture, shading->view, light, pdf);
}

/* aur_light_sample_direct for the surface: light that an opaque one has behind it is not looked for. */
static inline bool aur_shading_draw_light(const aur_scene *scene, const aur_shading *shading, float least,
                                          const float u[3], aur_light_sample *light) {
    const aur_surface *const surface = shading->surface;
    const float side = surface->bsdf->transmits ? 0.0f : shading->view.z < 0.0f ? -1.0f : 1.0f;
    const aur_vector normal = aur_vector_scale(surface->geometric_normal, side);
    return aur_light_sample_facing(scene, surface->position, normal, least, u, light);
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
