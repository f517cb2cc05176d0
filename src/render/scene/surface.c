/* Points on surfaces, and rays that leave them. */
#include "render/scene/scene_data.h"

static aur_vector interpolate(const float *values, const uint32_t *index, const float weight[3]) {
    aur_vector sum = {0.0f, 0.0f, 0.0f};
    for (size_t i = 0; i < 3; ++i) {
        const float *const v = &values[3 * (size_t)index[i]];
        sum = aur_vector_add_scaled(sum, weight[i], (aur_vector){v[0], v[1], v[2]});
    }
    return sum;
}

/* The tangents: steps that increase u by 1 at constant v, and vice versa. */
static void mesh_tangents(const aur_mesh *mesh, const uint32_t *index, const aur_vector edge[2],
                          aur_vector tangents[2]) {
    tangents[0] = edge[0];
    tangents[1] = edge[1];
    if (mesh->uvs == NULL)
        return;
    const float *const uv[3] = {&mesh->uvs[2 * (size_t)index[0]], &mesh->uvs[2 * (size_t)index[1]],
                                &mesh->uvs[2 * (size_t)index[2]]};
    const float v1 = uv[1][1] - uv[0][1], v2 = uv[2][1] - uv[0][1];
    const float u1 = uv[1][0] - uv[0][0], u2 = uv[2][0] - uv[0][0];
    const float determinant = u1 * v2 - u2 * v1;
    if (determinant == 0.0f)
        return;
    tangents[0] =
        aur_vector_scale(aur_vector_subtract(aur_vector_scale(edge[0], v2), aur_vector_scale(edge[1], v1)),
                         1.0f / determinant);
    tangents[1] =
        aur_vector_scale(aur_vector_subtract(aur_vector_scale(edge[1], u1), aur_vector_scale(edge[0], u2)),
                         1.0f / determinant);
}

/* Normal of a triangle so large or thin that its cross product overflows or underflows floats; a degenerate
 * one faces the ray. */
static aur_vector unusual_normal(const aur_vector edge[2], const aur_ray *ray) {
    const aur_vector normal = aur_extreme_triangle_normal(edge[0], edge[1], NULL);
    return aur_vector_is_zero(normal) ? aur_vector_scale(ray->direction, -1.0f) : normal;
}

static void mesh_surface(const aur_shape *shape, const aur_ray *ray, const aur_hit *hit,
                         aur_surface *surface) {
    const aur_mesh *const mesh = &shape->mesh;
    const uint32_t *const index = &mesh->indices[3 * (size_t)hit->primitive];
    const float weight[3] = {1.0f - hit->u - hit->v, hit->u, hit->v};
    aur_vector corner[3];
    aur_mesh_corners(mesh, hit->primitive, corner);
    const aur_vector edge[2] = {aur_vector_subtract(corner[1], corner[0]),
                                aur_vector_subtract(corner[2], corner[0])};
    const aur_vector cross = aur_vector_cross(edge[0], edge[1]);
    const float squared = aur_vector_dot(cross, cross);
    aur_vector normal;
    if (aur_is_usual_square(squared))
        normal = aur_vector_scale(cross, 1.0f / sqrtf(squared));
    else
        normal = unusual_normal(edge, ray);
    surface->position = aur_vector_add_scaled(
        aur_vector_add_scaled(aur_vector_scale(corner[0], weight[0]), weight[1], corner[1]), weight[2],
        corner[2]);
    surface->geometric_normal = normal;
    surface->offset = aur_triangle_offset(corner[0], corner[1], corner[2], normal);
    surface->frame.z = normal;
    if (mesh->normals != NULL) {
        const aur_vector smooth = interpolate(mesh->normals, index, weight);
        const float size = aur_vector_dot(smooth, smooth);
        if (size > 1e-12f)
            surface->frame.z = aur_vector_scale(smooth, 1.0f / sqrtf(size));
    }
    surface->texture = aur_mesh_texture(mesh, hit->primitive, hit->u, hit->v);
    aur_vector tangents[2] = {edge[0], edge[1]};
    if (shape->bsdf->anisotropic)
        mesh_tangents(mesh, index, edge, tangents);
    surface->frame.x = tangents[0];
    surface->frame.y = tangents[1];
}

static void curved_surface(const aur_shape *shape, const aur_ray *ray, const aur_hit *hit,
                           aur_surface *surface) {
    aur_shape_point point;
    aur_vector tangents[2] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    shape->curved->surface(shape, aur_vector_add_scaled(ray->origin, hit->distance, ray->direction), hit,
                           &point, shape->bsdf->anisotropic ? tangents : NULL);
    surface->position = point.position;
    surface->offset = point.offset;
    surface->geometric_normal = surface->frame.z = point.normal;
    surface->texture = point.texture;
    surface->frame.x = tangents[0];
    surface->frame.y = tangents[1];
}

/* frame.z is unit; frame.x is made perpendicular to it if the material depends on its direction. The original
 * tangents are stored for bump mapping. */
static void finish_frame(const aur_bsdf *bsdf, aur_surface *surface) {
    if (aur_vector_dot(surface->frame.z, surface->geometric_normal) < 0.0f)
        surface->frame.z = aur_vector_scale(surface->frame.z, -1.0f);
    const aur_vector z = surface->frame.z;
    if (bsdf->anisotropic) {
        const aur_vector x = aur_vector_add_scaled(surface->frame.x, -aur_vector_dot(surface->frame.x, z), z);
        const float length = aur_vector_length(x);
        if (length > 0.0f && isfinite(length)) {
            const aur_vector u = surface->frame.x, v = surface->frame.y;
            surface->frame.x = aur_vector_scale(x, 1.0f / length);
            surface->frame.y = aur_vector_cross(z, surface->frame.x);
            if (bsdf->bumpy) {
                surface->texture.tangents[0] = aur_vector_dot(u, surface->frame.x);
                surface->texture.tangents[1] = aur_vector_dot(v, surface->frame.x);
                surface->texture.tangents[2] = aur_vector_dot(v, surface->frame.y);
            }
            return;
        }
    }
    surface->frame = aur_frame_about(z);
}

static void shape_surface(const aur_shape *shape, const aur_ray *ray, const aur_hit *hit,
                          aur_surface *surface) {
    if (shape->curved != NULL)
        curved_surface(shape, ray, hit, surface);
    else
        mesh_surface(shape, ray, hit, surface);
}

/* Embree transforms ray origins to the group's space. Bounds its rounding, in products of the matrix with a
 * point and with the group's origin. */
static float instance_rounding(const aur_instance *instance, aur_vector position, aur_vector local_normal) {
    const double *const m = instance->to_local.m, *const w = instance->to_world.m;
    const double from[3] = {fabs((double)position.x) + fabs(w[3]), fabs((double)position.y) + fabs(w[7]),
                            fabs((double)position.z) + fabs(w[11])};
    double reach[3];
    for (size_t i = 0; i < 3; ++i)
        reach[i] = fabs(m[4 * i]) * from[0] + fabs(m[4 * i + 1]) * from[1] + fabs(m[4 * i + 2]) * from[2];
    return aur_surface_rounding((aur_vector){(float)reach[0], (float)reach[1], (float)reach[2]},
                                local_normal);
}

/* Finds the surface in the group's space, then transforms it to the instance. A distance of 1 along the unit
 * normal n there is 1 / |to_local^T n| along the normal here. */
static void instance_surface(const aur_instance *instance, const aur_shape *shape, const aur_ray *ray,
                             const aur_hit *hit, aur_surface *surface) {
    aur_ray local = *ray;
    local.origin = aur_transform_point_f(&instance->to_local, ray->origin);
    local.direction = aur_transform_direction_f(&instance->to_local, ray->direction);
    shape_surface(shape, &local, hit, surface);
    surface->position = aur_transform_point_f(&instance->to_world, surface->position);
    const float local_offset = surface->offset - AUR_LEAST_OFFSET +
                               instance_rounding(instance, surface->position, surface->geometric_normal);
    const aur_vector normal = aur_transform_normal_f(&instance->to_local, surface->geometric_normal);
    surface->geometric_normal = aur_vector_normalize(normal);
    surface->offset = aur_surface_offset(surface->position, surface->geometric_normal) +
                      local_offset / aur_larger(aur_vector_length(normal), 1e-30f);
    surface->frame.z = aur_vector_normalize(aur_transform_normal_f(&instance->to_local, surface->frame.z));
    surface->frame.x = aur_transform_direction_f(&instance->to_world, surface->frame.x);
    surface->frame.y = aur_transform_direction_f(&instance->to_world, surface->frame.y);
}

void aur_scene_surface(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit, aur_surface *surface) {
    const aur_shape *const shape = scene->shapes[hit->shape];
    if (hit->instance == AUR_NO_INSTANCE)
        shape_surface(shape, ray, hit, surface);
    else
        instance_surface(scene->instances[hit->instance], shape, ray, hit, surface);
    finish_frame(shape->bsdf, surface);
    surface->bsdf = shape->bsdf;
    if (shape->bsdf->attributes.position)
        surface->texture.position = surface->position;
    surface->shape = hit->shape;
    surface->primitive = hit->primitive;
    surface->emitter = shape->emitter;
}
