/* Flat surfaces that emit along their normals only: beams with the cross section of the shape, invisible to
 * cameras. */
#include <stdlib.h>

#include "render/scene/emitter.h"
#include "render/scene/scene_data.h"

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(aur_emitter, "radiance", radiance, 1e30, "1", "irradiance across the beam, RGB")},
};

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    return aur_colors_read(&emitter->descriptor->row, parameters, emitter, error);
}

/* The parallelogram between two edges, or the ellipse with two half axes. */
typedef struct beam {
    const aur_shape *shape;
    aur_vector origin, normal;
    float rounding;      /* of points on the shape (aur_shape_point) */
    aur_vector along[2]; /* dual basis: products with a vector from `origin` are coordinates */
} beam;

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    const aur_shape *const shape = emitter->scene->shapes[emitter->shape];
    const bool round = shape->ellipse;
    if (!round && !shape->parallelogram)
        return aur_fail_at(error, emitter->location, AUR_ERROR_UNSUPPORTED,
                           "emitter 'directionalarea': a shape '%s' cannot be one, only a rectangle or a "
                           "disk that lies on no other shape",
                           shape->descriptor->row.name);
    if (!(shape->area > 0.0))
        return aur_fail_at(error, emitter->location, AUR_ERROR_FORMAT,
                           "emitter 'directionalarea': its shape has no area, so it gives no light");
    beam *const self = emitter->data;
    self->shape = shape;
    self->origin = round ? shape->center : aur_mesh_position(&shape->mesh, 0);
    const aur_vector x =
        round ? shape->axis[0] : aur_vector_subtract(aur_mesh_position(&shape->mesh, 1), self->origin);
    const aur_vector y =
        round ? shape->axis[1] : aur_vector_subtract(aur_mesh_position(&shape->mesh, 3), self->origin);
    const aur_vector across = aur_vector_cross(x, y);
    const float scale = 1.0f / aur_vector_dot(across, across);
    self->along[0] = aur_vector_scale(aur_vector_cross(y, across), scale);
    self->along[1] = aur_vector_scale(aur_vector_cross(across, x), scale);
    const aur_shape_point on = aur_shape_sample(shape, NULL, (const float[3]){0.0f, 1.0f, 0.0f});
    self->normal = on.normal;
    self->rounding = on.rounding;
    emitter->extent = shape->area;
    return AUR_OK;
}

/* Whether the point lies on the shape, and its texture coordinates. */
static bool find_point(const aur_shape *shape, float x, float y, aur_bsdf_point *texture) {
    *texture = (aur_bsdf_point){.u = x, .v = y};
    if (shape->parallelogram)
        return x >= 0.0f && x <= 1.0f && y >= 0.0f && y <= 1.0f;
    *texture = (aur_bsdf_point){.u = hypotf(x, y), .v = aur_shape_azimuth(x, y)};
    return texture->u >= shape->inner && texture->u <= 1.0f;
}

/* The point of the shape whose beam passes through the reference, if any. */
static bool sample(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const beam *const self = emitter->data;
    const aur_vector way = aur_vector_subtract(query->reference.position, self->origin);
    aur_bsdf_point texture;
    drawn->distance = aur_vector_dot(way, self->normal);
    if (!(drawn->distance > 0.0f) || !find_point(self->shape, aur_vector_dot(way, self->along[0]),
                                                 aur_vector_dot(way, self->along[1]), &texture))
        return false;
    drawn->direction = aur_vector_scale(self->normal, -1.0f);
    /* The distance is a sum of three products, and the normal's length is rounded: 6 roundings. */
    drawn->position = aur_surface_target(
        query->reference.position,
        aur_vector_add_scaled(query->reference.position, drawn->distance, drawn->direction), self->normal,
        self->rounding + 3.6e-7f * aur_vector_dot_absolute(way, self->normal));
    drawn->normal = self->normal;
    drawn->radiance = aur_color_at(&emitter->radiance, texture);
    drawn->pdf = 1.0f;
    drawn->delta = true;
    return true;
}

static bool emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const aur_shape *const shape = ((const beam *)emitter->data)->shape;
    const aur_shape_point point = aur_shape_sample(shape, NULL, u);
    const aur_surface surface = {
        .position = point.position, .geometric_normal = point.normal, .offset = point.offset};
    *ray = aur_surface_ray(&surface, point.normal);
    *power = aur_vector_scale(aur_color_at(&emitter->radiance, point.texture), (float)shape->area);
    return true;
}

const aur_emitter_descriptor aur_emitter_directionalarea = {
    .row = {.name = "directionalarea",
            .summary = "a rectangle or disk that shines along its normal only",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(beam),
    .needs_shape = true,
    .create = create,
    .prepare = prepare,
    .sample = sample,
    .emit = emit,
};
