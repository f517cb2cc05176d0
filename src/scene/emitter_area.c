/* Surfaces that emit the same radiance in all directions of the side that their normal shows. */
#include <stdlib.h>

#include "material/sampling.h"
#include "scene/distribution.h"
#include "scene/emitter.h"
#include "scene/scene_data.h"

typedef struct point_on_light {
    aur_vector position, normal;
    aur_bsdf_point texture;
} point_on_light;

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    emitter->radiance.constant = (aur_vector){1.0f, 1.0f, 1.0f};
    return aur_parameters_color(parameters, "radiance", 1e30, &emitter->radiance, error);
}

static const aur_shape *shape_of(const aur_scene *scene, const aur_emitter *emitter) {
    return scene->shapes[emitter->shape];
}

static aur_result prepare(const aur_scene *scene, aur_emitter *emitter, aur_error *error) {
    const aur_shape *const shape = shape_of(scene, emitter);
    if (!(shape->area > 0.0))
        return aur_fail_at(error, emitter->location, AUR_ERROR_FORMAT,
                           "emitter 'area': its shape has no area, so it gives no light");
    emitter->power = AUR_PI * shape->area * (double)aur_luminance(aur_color_mean(&emitter->radiance));
    if (shape->parallelogram)
        return AUR_OK;
    const size_t count = shape->mesh.triangle_count;
    double *const areas = malloc(count * sizeof *areas);
    aur_distribution *const triangles = calloc(1, sizeof *triangles);
    emitter->data = triangles;
    if (areas == NULL || triangles == NULL) {
        free(areas);
        return aur_fail_at(error, emitter->location, AUR_ERROR_MEMORY, "out of memory");
    }
    for (size_t i = 0; i < count; ++i)
        areas[i] = aur_mesh_triangle_area(&shape->mesh, i);
    const aur_result result = aur_distribution_create(triangles, count, areas, error);
    free(areas);
    return result;
}

static void release(aur_emitter *emitter) {
    aur_distribution_release(emitter->data);
    free(emitter->data);
}

static aur_bsdf_point texture_at(const aur_mesh *mesh, size_t triangle, float b1, float b2) {
    if (mesh->uvs == NULL)
        return (aur_bsdf_point){b1, b2};
    const uint32_t *const index = &mesh->indices[3 * triangle];
    const float weight[3] = {1.0f - b1 - b2, b1, b2};
    aur_bsdf_point point = {0.0f, 0.0f};
    for (size_t i = 0; i < 3; ++i) {
        point.u += weight[i] * mesh->uvs[2 * (size_t)index[i]];
        point.v += weight[i] * mesh->uvs[2 * (size_t)index[i] + 1];
    }
    return point;
}

static point_on_light draw_point(const aur_scene *scene, const aur_emitter *emitter, const float u[3]) {
    const aur_mesh *const mesh = &shape_of(scene, emitter)->mesh;
    float choice = u[0];
    const size_t triangle = emitter->data != NULL ? aur_distribution_choose(emitter->data, &choice) : 0;
    aur_vector corner[3];
    aur_mesh_corners(mesh, triangle, corner);
    point_on_light point;
    point.normal = aur_vector_normalize(aur_vector_cross(aur_vector_subtract(corner[1], corner[0]),
                                                         aur_vector_subtract(corner[2], corner[0])));
    if (shape_of(scene, emitter)->parallelogram) {
        const aur_vector origin = aur_mesh_position(mesh, 0);
        point.position =
            aur_vector_add_scaled(origin, u[1], aur_vector_subtract(aur_mesh_position(mesh, 1), origin));
        point.position = aur_vector_add_scaled(point.position, u[2],
                                               aur_vector_subtract(aur_mesh_position(mesh, 3), origin));
        point.texture = (aur_bsdf_point){u[1], u[2]};
        return point;
    }
    const float root = sqrtf(u[1]);
    const float b1 = root * (1.0f - u[2]);
    const float b2 = root * u[2];
    point.position = aur_vector_scale(corner[0], 1.0f - b1 - b2);
    point.position = aur_vector_add_scaled(point.position, b1, corner[1]);
    point.position = aur_vector_add_scaled(point.position, b2, corner[2]);
    point.texture = texture_at(mesh, triangle, b1, b2);
    return point;
}

static bool sample(const aur_scene *scene, const aur_emitter *emitter, aur_vector reference, const float u[3],
                   aur_light_sample *drawn) {
    const point_on_light point = draw_point(scene, emitter, u);
    const aur_vector way = aur_vector_subtract(point.position, reference);
    const float squared = aur_vector_dot(way, way);
    drawn->distance = sqrtf(squared);
    drawn->direction = aur_vector_scale(way, 1.0f / drawn->distance);
    const float cosine = -aur_vector_dot(drawn->direction, point.normal);
    if (!(cosine > 0.0f) || !(squared > 0.0f))
        return false;
    drawn->position = point.position;
    drawn->normal = point.normal;
    drawn->radiance = aur_color_at(&emitter->radiance, point.texture);
    drawn->pdf = squared / (cosine * (float)shape_of(scene, emitter)->area);
    return isfinite(drawn->pdf);
}

static bool emit(const aur_scene *scene, const aur_emitter *emitter, const float u[5], aur_ray *ray,
                 aur_vector *power) {
    const point_on_light point = draw_point(scene, emitter, u);
    const aur_frame frame = aur_frame_about(point.normal);
    const aur_surface surface = {.position = point.position, .geometric_normal = point.normal};
    *ray = aur_surface_ray(&surface, aur_frame_to_world(&frame, aur_sample_cosine(u[3], u[4])));
    *power = aur_vector_scale(aur_color_at(&emitter->radiance, point.texture),
                              AUR_PI_F * (float)shape_of(scene, emitter)->area);
    return true;
}

const aur_emitter_descriptor aur_emitter_area = {
    .name = "area",
    .summary = "a shape that emits from the side of its normal",
    .needs_shape = true,
    .create = create,
    .prepare = prepare,
    .sample = sample,
    .emit = emit,
    .release = release,
};
