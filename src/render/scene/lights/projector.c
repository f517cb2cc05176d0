/* An image projected from a point, with the geometry of a pinhole camera. */
#include <stdlib.h>

#include "render/scene/emitter.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct projector {
    aur_transform to_world, to_local; /* relative to the scene's origin, when prepared */
    aur_frame frame;                  /* unit axes; x is the left of the image */
    aur_vector position;
    float half_width, half_height; /* area of the image at z = 1 */
    float scale;
} projector;

typedef struct projector_keys {
    aur_color irradiance;
    aur_transform to_world;
    double fov, scale;
    aur_fov_axis axis;
} projector_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(projector_keys, "irradiance", irradiance, 1e30, "1",
                      "projected texture: radiance at distance 1 along the axis, over pi")},
    {AUR_KEY_OF_REAL(projector_keys, "scale", scale, 0.0, 1e30, "1", "factor of it")},
    {AUR_KEY_OF_REAL(projector_keys, "fov", fov, 1e-3, 180.0 - 1e-3, "of 50mm", "field of view, degrees"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(projector_keys, "fov_axis", axis, "x", "axis of the image that fov spans", "x", "y",
                       "diagonal", "smaller", "larger")},
    {AUR_KEY_OF_TRANSFORM(projector_keys, "to_world", to_world, "from a projector at the origin along +z")},
};

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    projector_keys p = {.fov = 0.0};
    projector *const self = emitter->data;
    aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p.to_world, &self->to_local, error);
    if (result != AUR_OK)
        return result;
    const aur_texture *const image = p.irradiance.texture;
    const float aspect = image != NULL && image->aspect > 0.0f ? image->aspect : 1.0f;
    /* Default: a 50 mm lens on 35 mm film, for the diagonal of 36 mm by 24 mm. */
    const aur_sensor lens =
        p.fov > 0.0 ? (aur_sensor){.axis = p.axis, .tangent = (float)tan(0.5 * p.fov * AUR_PI / 180.0)}
                    : (aur_sensor){.axis = AUR_FOV_DIAGONAL,
                                   .tangent = (float)(sqrt(36.0 * 36.0 + 24.0 * 24.0) / 100.0)};
    self->half_width = aur_sensor_half_width(&lens, aspect);
    self->half_height = self->half_width / aspect;
    self->to_world = p.to_world;
    aur_vector axis[3];
    for (size_t i = 0; i < 3; ++i)
        axis[i] = aur_vector_normalize(aur_transform_direction_f(
            &p.to_world, (aur_vector){i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f}));
    self->frame = (aur_frame){.x = axis[0], .y = axis[1], .z = axis[2]};
    self->scale = (float)p.scale * AUR_PI_F;
    emitter->radiance = p.irradiance;
    emitter->extent = (double)(self->scale * 4.0f * self->half_width * self->half_height);
    return AUR_OK;
}

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    (void)error;
    projector *const self = emitter->data;
    aur_transform_move(&self->to_world, emitter->scene->origin);
    aur_transform_inverse(&self->to_world, &self->to_local);
    self->position = aur_transform_point_f(&self->to_world, (aur_vector){0.0f, 0.0f, 0.0f});
    return AUR_OK;
}

static void find_bounds(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds) {
    (void)part;
    const projector *const self = emitter->data;
    *bounds = (aur_light_bounds){.spread = atan(hypot((double)self->half_width, (double)self->half_height)),
                                 .power = emitter->power};
    aur_vector_to_doubles(self->position, bounds->lower);
    aur_vector_to_doubles(self->position, bounds->upper);
    aur_vector_to_doubles(self->frame.z, bounds->axis);
}

/* radiance / pdf is the irradiance on a surface that faces the projector: the image's value over depth
 * squared and the cosine to the axis. This lights a plane perpendicular to the axis evenly. */
static bool sample(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const projector *const self = emitter->data;
    const aur_vector way = aur_vector_subtract(self->position, query->reference.position);
    const float squared = aur_vector_dot(way, way);
    const aur_vector local = aur_transform_point_f(&self->to_local, query->reference.position);
    if (!(squared > 0.0f) || !(local.z > 0.0f))
        return false;
    const aur_bsdf_point at = {.u = 0.5f - 0.5f * local.x / (local.z * self->half_width),
                               .v = 0.5f - 0.5f * local.y / (local.z * self->half_height)};
    if (!(at.u >= 0.0f && at.u <= 1.0f && at.v >= 0.0f && at.v <= 1.0f))
        return false;
    drawn->distance = sqrtf(squared);
    drawn->direction = aur_vector_scale(way, 1.0f / drawn->distance);
    drawn->position = aur_point_target(query->reference.position, self->position,
                                       aur_vector_scale(drawn->direction, -1.0f));
    drawn->normal = self->frame.z;
    const float cosine = -aur_vector_dot(drawn->direction, self->frame.z);
    drawn->radiance =
        aur_vector_scale(aur_color_at(&emitter->radiance, at), self->scale / (local.z * local.z * cosine));
    drawn->pdf = 1.0f;
    drawn->delta = true;
    return cosine > 0.0f;
}

static bool emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const projector *const self = emitter->data;
    const aur_vector local = {(1.0f - 2.0f * u[3]) * self->half_width,
                              (1.0f - 2.0f * u[4]) * self->half_height, 1.0f};
    *ray = (aur_ray){self->position, 0.0f, aur_vector_normalize(aur_frame_to_world(&self->frame, local)),
                     INFINITY};
    *power = aur_vector_scale(aur_color_at(&emitter->radiance, (aur_bsdf_point){.u = u[3], .v = u[4]}),
                              (float)emitter->extent);
    return true;
}

const aur_emitter_descriptor aur_emitter_projector = {
    .row = {.name = "projector", .summary = "projects an image into the scene", AUR_ROW_KEYS(keys)},
    .size = sizeof(projector),
    .create = create,
    .prepare = prepare,
    .bounds = find_bounds,
    .sample = sample,
    .emit = emit,
};
