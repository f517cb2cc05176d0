/* Points on surfaces, and rays that leave them. */
#include "scene/scene_data.h"

/* Positions are found to a few parts in 10^7 of their coordinates (seven roundings of 2^-24); the offset is a
 * little beyond that, so that a ray never meets the surface that it leaves. */
static float offset_at(aur_vector position) {
    const float size = fmaxf(fabsf(position.x), fmaxf(fabsf(position.y), fabsf(position.z)));
    return 1.5e-6f * size + 1e-9f;
}

static aur_vector interpolate(const float *values, const uint32_t *index, const float weight[3]) {
    aur_vector sum = {0.0f, 0.0f, 0.0f};
    for (size_t i = 0; i < 3; ++i) {
        const float *const v = &values[3 * (size_t)index[i]];
        sum = aur_vector_add_scaled(sum, weight[i], (aur_vector){v[0], v[1], v[2]});
    }
    return sum;
}

void aur_scene_surface(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit, aur_surface *surface) {
    const aur_shape *const shape = scene->shapes[hit->shape];
    const aur_mesh *const mesh = &shape->mesh;
    const uint32_t *const index = &mesh->indices[3 * (size_t)hit->primitive];
    const float weight[3] = {1.0f - hit->u - hit->v, hit->u, hit->v};
    aur_vector corner[3];
    aur_mesh_corners(mesh, hit->primitive, corner);
    surface->position = interpolate(mesh->positions, index, weight);
    const aur_vector normal = aur_vector_cross(aur_vector_subtract(corner[1], corner[0]),
                                               aur_vector_subtract(corner[2], corner[0]));
    const float length = aur_vector_length(normal);
    /* A triangle too thin for its normal faces the ray. */
    surface->geometric_normal =
        length > 0.0f ? aur_vector_scale(normal, 1.0f / length) : aur_vector_scale(ray->direction, -1.0f);
    aur_vector shading = surface->geometric_normal;
    if (mesh->normals != NULL) {
        const aur_vector smooth = interpolate(mesh->normals, index, weight);
        const float squared = aur_vector_dot(smooth, smooth);
        if (squared > 1e-12f)
            shading = aur_vector_scale(smooth, 1.0f / sqrtf(squared));
        if (aur_vector_dot(shading, surface->geometric_normal) < 0.0f)
            shading = aur_vector_scale(shading, -1.0f);
    }
    surface->frame = aur_frame_about(shading);
    surface->texture = (aur_bsdf_point){hit->u, hit->v};
    if (mesh->uvs != NULL) {
        surface->texture = (aur_bsdf_point){0.0f, 0.0f};
        for (size_t i = 0; i < 3; ++i) {
            surface->texture.u += weight[i] * mesh->uvs[2 * (size_t)index[i]];
            surface->texture.v += weight[i] * mesh->uvs[2 * (size_t)index[i] + 1];
        }
    }
    surface->bsdf = shape->bsdf;
    surface->shape = hit->shape;
    surface->primitive = hit->primitive;
    surface->emitter = shape->emitter;
}

/* A point beside the surface, on the side of `direction`. */
static aur_vector leave(const aur_surface *surface, aur_vector direction) {
    const float side = aur_vector_dot(direction, surface->geometric_normal) < 0.0f ? -1.0f : 1.0f;
    return aur_vector_add_scaled(surface->position, side * offset_at(surface->position),
                                 surface->geometric_normal);
}

aur_ray aur_surface_ray(const aur_surface *surface, aur_vector direction) {
    return (aur_ray){leave(surface, direction), 0.0f, direction, INFINITY};
}

aur_ray aur_surface_ray_to(const aur_surface *surface, aur_vector target, float *distance) {
    const aur_vector from = leave(surface, aur_vector_subtract(target, surface->position));
    const aur_vector way = aur_vector_subtract(target, from);
    *distance = aur_vector_length(way);
    return (aur_ray){from, 0.0f, aur_vector_scale(way, 1.0f / fmaxf(*distance, 1e-30f)),
                     *distance * (1.0f - 1e-4f)};
}
