/* Lights without extent: point, spot and directional. */
#include <stdlib.h>

#include "render/scene/emitter.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct point_light {
    double world_position[3]; /* world coordinates */
    aur_vector position;      /* relative to the scene's origin */
    aur_frame frame;          /* z is the axis of a spot, or the direction of directional light */
    /* Radians: intensity falls from full at the beam width to zero at the cutoff. For a point light both
     * exceed pi. */
    float cutoff, beam;
    float cosine_cutoff;
    aur_color image; /* texture of a spot: a factor across its cone */
    aur_transform to_local;
} point_light;

typedef struct point_keys {
    aur_color color, image;
    aur_transform to_world;
    double position[3], direction[3];
    double cutoff, beam; /* degrees; beam -1: default */
} point_keys;

static const aur_key point_table[] = {
    {AUR_KEY_OF_COLOR(point_keys, "intensity", color, 1e30, "1", "power per steradian, RGB")},
    {AUR_KEY_OF_VECTOR(point_keys, "position", position, -AUR_REACH, AUR_REACH, "0 0 0", "where it is")},
    {AUR_KEY_OF_TRANSFORM(point_keys, "to_world", to_world, "applied to the position")},
};

static const aur_key spot_table[] = {
    {AUR_KEY_OF_COLOR(point_keys, "intensity", color, 1e30, "1", "power per steradian along the axis, RGB")},
    {AUR_KEY_OF_COLOR(point_keys, "texture", image, 1e30, NULL, "texture projected across the cone")},
    {AUR_KEY_OF_REAL(point_keys, "cutoff_angle", cutoff, 1e-3, 180.0, "20", "no light beyond, degrees")},
    {AUR_KEY_OF_REAL(point_keys, "beam_width", beam, 0.0, 180.0, "3/4 of cutoff_angle",
                     "full light within, degrees; at most cutoff_angle"),
     .computed = true},
    {AUR_KEY_OF_TRANSFORM(point_keys, "to_world", to_world, "from a spot at the origin along +z")},
};

static const aur_key directional_table[] = {
    {AUR_KEY_OF_COLOR(point_keys, "irradiance", color, 1e30, "1", "on a plane across the light, RGB")},
    {AUR_KEY_OF_VECTOR(point_keys, "direction", direction, -AUR_REACH, AUR_REACH, "+z by to_world",
                       "direction of the light"),
     .computed = true},
    {AUR_KEY_OF_TRANSFORM(point_keys, "to_world", to_world, "instead of direction: from light along +z")},
};

static aur_vector to_vector(const double v[3]) {
    return (aur_vector){(float)v[0], (float)v[1], (float)v[2]};
}

/* Reads the parameters, and sets the light's position and orientation. */
static aur_result read_keys(aur_parameters *parameters, aur_emitter *emitter, point_keys *p,
                            aur_error *error) {
    const aur_row *const row = &emitter->descriptor->row;
    *p = (point_keys){.beam = -1.0};
    point_light *const self = emitter->data;
    aur_result result = aur_colors_read(row, parameters, p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p->to_world, &self->to_local, error);
    if (result == AUR_OK && p->color.texture != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED, "'%s' cannot be a texture",
                                   row->keys[0].name);
    if (result != AUR_OK)
        return result;
    const bool aimed = aur_parameters_find(parameters, "direction") != NULL;
    if (aimed && aur_parameters_find(parameters, "to_world") != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "give 'direction' or 'to_world', not both");
    const aur_vector way = aimed ? to_vector(p->direction)
                                 : aur_transform_direction_f(&p->to_world, (aur_vector){0.0f, 0.0f, 1.0f});
    if (emitter->descriptor->is_far && !(aur_vector_length(way) > (float)(1.0 / AUR_REACH)))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "'direction' must not be 0 0 0 or nearly 0");
    aur_transform_point(&p->to_world, p->position, self->world_position);
    self->frame = aur_frame_about(aur_vector_normalize(way));
    emitter->radiance = p->color;
    return AUR_OK;
}

/* --- point and spot */

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    (void)error;
    point_light *const self = emitter->data;
    self->position = aur_internal_point(emitter->scene->origin, self->world_position);
    return AUR_OK;
}

static aur_result create_point(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    point_keys p;
    const aur_result result = read_keys(parameters, emitter, &p, error);
    if (result != AUR_OK)
        return result;
    const aur_transform world_position = aur_transform_translate(p.position[0], p.position[1], p.position[2]);
    const aur_transform both = aur_transform_multiply(&p.to_world, &world_position);
    if (!aur_transform_is_within_reach(&both))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it must be within %g of the origin",
                                   AUR_REACH);
    ((point_light *)emitter->data)->beam = 4.0f;
    emitter->extent = 4.0 * AUR_PI;
    return AUR_OK;
}

static aur_result create_spot(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    point_keys p;
    const aur_result result = read_keys(parameters, emitter, &p, error);
    if (result != AUR_OK)
        return result;
    const double cutoff = p.cutoff, beam = p.beam < 0.0 ? 0.75 * cutoff : p.beam;
    if (beam > cutoff)
        return aur_fail_at(error, aur_parameters_find(parameters, "beam_width")->location, AUR_ERROR_FORMAT,
                           "emitter 'spot': 'beam_width' must be at most the cutoff_angle %g, not %g", cutoff,
                           beam);
    point_light *const self = emitter->data;
    self->cutoff = (float)(cutoff * AUR_PI / 180.0);
    self->image = p.image;
    if (p.image.texture != NULL && cutoff >= 90.0)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "a 'texture' needs a 'cutoff_angle' below 90 degrees");
    self->beam = (float)(beam * AUR_PI / 180.0);
    self->cosine_cutoff = cosf(self->cutoff);
    const double mean = 0.5 * (cos((double)self->beam) + (double)self->cosine_cutoff);
    emitter->extent = 2.0 * AUR_PI * (1.0 - mean);
    return AUR_OK;
}

/* The texture factor of a spot in a direction from it. */
static aur_vector image_at(const point_light *self, aur_vector direction) {
    if (self->image.texture == NULL)
        return (aur_vector){1.0f, 1.0f, 1.0f};
    const aur_vector local = aur_transform_direction_f(&self->to_local, direction);
    const float width = 2.0f * local.z * tanf(self->cutoff);
    return aur_color_at(&self->image,
                        (aur_bsdf_point){.u = 0.5f + local.x / width, .v = 0.5f + local.y / width});
}

/* Full within the beam width, then linear in the angle to 0 at the cutoff. */
static float falloff(const point_light *self, float cosine) {
    if (self->beam > AUR_PI_F)
        return 1.0f;
    if (!(cosine > self->cosine_cutoff))
        return 0.0f;
    const float angle = acosf(fminf(cosine, 1.0f));
    return angle <= self->beam ? 1.0f : fmaxf((self->cutoff - angle) / (self->cutoff - self->beam), 0.0f);
}

static void find_bounds(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds) {
    (void)part;
    const point_light *const self = emitter->data;
    const bool all_sides = self->beam > AUR_PI_F;
    *bounds = (aur_light_bounds){.spread = all_sides ? AUR_PI : fmin((double)self->cutoff, AUR_PI),
                                 .power = emitter->power};
    aur_vector_to_doubles(self->position, bounds->lower);
    aur_vector_to_doubles(self->position, bounds->upper);
    aur_vector_to_doubles(self->frame.z, bounds->axis);
}

/* radiance / pdf is the intensity over the squared distance. */
static bool sample_point(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const point_light *const self = emitter->data;
    const aur_vector way = aur_vector_subtract(self->position, query->reference.position);
    const float squared = aur_vector_dot(way, way);
    if (!(squared > 0.0f))
        return false;
    drawn->distance = sqrtf(squared);
    drawn->direction = aur_vector_scale(way, 1.0f / drawn->distance);
    drawn->normal = aur_vector_scale(drawn->direction, -1.0f);
    drawn->position = aur_point_target(query->reference.position, self->position, drawn->normal);
    const float share = falloff(self, -aur_vector_dot(drawn->direction, self->frame.z));
    drawn->radiance = aur_vector_scale(aur_vector_scale(emitter->radiance.constant, 1.0f / squared), share);
    if (self->image.texture != NULL && share > 0.0f)
        drawn->radiance =
            aur_vector_multiply(drawn->radiance, image_at(self, aur_vector_scale(drawn->direction, -1.0f)));
    drawn->pdf = 1.0f;
    drawn->delta = true;
    return share > 0.0f;
}

static bool emit_point(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const point_light *const self = emitter->data;
    *ray = (aur_ray){self->position, 0.0f, aur_sample_sphere(u[3], u[4]), INFINITY};
    *power = aur_vector_scale(emitter->radiance.constant, 4.0f * AUR_PI_F);
    return true;
}

static bool emit_spot(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const point_light *const self = emitter->data;
    const float cap = 1.0f - self->cosine_cutoff;
    const float cosine = 1.0f - u[3] * cap;
    *ray = (aur_ray){self->position, 0.0f, aur_frame_to_world(&self->frame, aur_direction_at(cosine, u[4])),
                     INFINITY};
    *power = aur_vector_scale(emitter->radiance.constant, falloff(self, cosine) * 2.0f * AUR_PI_F * cap);
    *power = aur_vector_multiply(*power, image_at(self, ray->direction));
    return true;
}

const aur_emitter_descriptor aur_emitter_point = {
    .row = {.name = "point", .summary = "a point that shines evenly", AUR_ROW_KEYS(point_table)},
    .size = sizeof(point_light),
    .create = create_point,
    .prepare = prepare,
    .bounds = find_bounds,
    .sample = sample_point,
    .emit = emit_point,
};

const aur_emitter_descriptor aur_emitter_spot = {
    .row = {.name = "spot", .summary = "a point that shines in a cone about +z", AUR_ROW_KEYS(spot_table)},
    .size = sizeof(point_light),
    .create = create_spot,
    .prepare = prepare,
    .bounds = find_bounds,
    .sample = sample_point,
    .emit = emit_spot,
};

/* --- directional */

static aur_result create_directional(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    point_keys p;
    emitter->extent = AUR_PI;
    return read_keys(parameters, emitter, &p, error);
}

static aur_vector towards_light(const aur_emitter *emitter) {
    return aur_vector_scale(((const point_light *)emitter->data)->frame.z, -1.0f);
}

static bool sample_directional(const aur_emitter *emitter, const aur_light_query *query,
                               aur_light_sample *drawn) {
    aur_sample_far(emitter->scene, query->reference.position, towards_light(emitter), drawn);
    drawn->radiance = emitter->radiance.constant;
    drawn->pdf = 1.0f;
    drawn->delta = true;
    return true;
}

static bool emit_directional(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const float radius = emitter->scene->radius;
    *ray = aur_emit_far(emitter->scene, towards_light(emitter), u[1], u[2]);
    *power = aur_vector_scale(emitter->radiance.constant, AUR_PI_F * radius * radius);
    return true;
}

const aur_emitter_descriptor aur_emitter_directional = {
    .row = {.name = "directional",
            .summary = "parallel light along +z or `direction`",
            AUR_ROW_KEYS(directional_table)},
    .size = sizeof(point_light),
    .is_far = true,
    .create = create_directional,
    .sample = sample_directional,
    .emit = emit_directional,
};
