/* Surfaces that emit the same radiance in all directions of the side that their normal shows. */
#include <stdlib.h>

#include "material/sampling.h"
#include "scene/distribution.h"
#include "scene/emitter.h"
#include "scene/scene_data.h"

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
    if (shape->parallelogram || shape->curved != NULL)
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

static bool sample(const aur_scene *scene, const aur_emitter *emitter, aur_vector reference, const float u[3],
                   aur_light_sample *drawn) {
    const aur_shape *const shape = shape_of(scene, emitter);
    aur_shape_point point;
    drawn->pdf = 0.0f;
    if (shape->curved == NULL || shape->curved->sample_seen == NULL ||
        !shape->curved->sample_seen(shape, reference, u[1], u[2], &point, &drawn->pdf))
        point = aur_shape_sample(shape, emitter->data, u);
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
    if (drawn->pdf == 0.0f)
        drawn->pdf = squared / (cosine * (float)shape->area);
    return isfinite(drawn->pdf);
}

static bool emit(const aur_scene *scene, const aur_emitter *emitter, const float u[5], aur_ray *ray,
                 aur_vector *power) {
    const aur_shape_point point = aur_shape_sample(shape_of(scene, emitter), emitter->data, u);
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
