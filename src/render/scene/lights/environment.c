/* Light from infinitely far: code shared by all environments, and the constant environment. */
#include "render/scene/emitter.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

void aur_sample_far(const aur_scene *scene, aur_vector reference, aur_vector direction,
                    aur_light_sample *drawn) {
    const aur_vector way = aur_vector_subtract(scene->center, reference);
    drawn->direction = direction;
    drawn->distance = aur_vector_length(way) + 2.0f * scene->radius;
    drawn->position = aur_vector_add_scaled(reference, drawn->distance, direction);
    drawn->normal = aur_vector_scale(direction, -1.0f);
}

aur_ray aur_emit_far(const aur_scene *scene, aur_vector direction, float u, float v) {
    const aur_frame frame = aur_frame_about(direction);
    float x, y;
    aur_sample_disk(u, v, &x, &y);
    aur_vector origin = aur_vector_add_scaled(scene->center, scene->radius, direction);
    origin = aur_vector_add_scaled(origin, scene->radius * x, frame.x);
    origin = aur_vector_add_scaled(origin, scene->radius * y, frame.y);
    return (aur_ray){origin, 0.0f, aur_vector_scale(direction, -1.0f), INFINITY};
}

bool aur_environment_sample(const aur_emitter *emitter, const aur_light_query *query,
                            aur_light_sample *drawn) {
    const aur_vector direction = emitter->descriptor->draw(emitter, query->u[1], query->u[2]);
    if (aur_vector_dot(query->reference.normal, direction) < 0.0f)
        return false;
    aur_sample_far(emitter->scene, query->reference.position, direction, drawn);
    /* Evaluates radiance and pdf from the direction, as for rays that reach the environment: rounding cannot
     * make sampling and evaluation differ. */
    drawn->radiance = aur_emitter_light_from(emitter, direction, &drawn->pdf);
    return drawn->pdf > 0.0f;
}

bool aur_environment_emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const aur_vector direction = emitter->descriptor->draw(emitter, u[1], u[2]);
    const float pdf = emitter->descriptor->pdf_from(emitter, direction), radius = emitter->scene->radius;
    if (!(pdf > 0.0f))
        return false;
    *ray = aur_emit_far(emitter->scene, direction, u[3], u[4]);
    *power = aur_vector_scale(emitter->descriptor->radiance_from(emitter, direction),
                              AUR_PI_F * radius * radius / pdf);
    return true;
}

/* --- constant */

static const aur_key constant_keys[] = {
    {AUR_KEY_OF_COLOR(aur_emitter, "radiance", radiance, 1e30, "1", "radiance from everywhere, RGB")},
};

static aur_result create_constant(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    const aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, emitter, error);
    if (result == AUR_OK && emitter->radiance.texture != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "'radiance' cannot be a texture; use an envmap");
    emitter->extent = 4.0 * AUR_PI * AUR_PI;
    return result;
}

static aur_vector constant_from(const aur_emitter *emitter, aur_vector direction) {
    (void)direction;
    return emitter->radiance.constant;
}

static float constant_pdf(const aur_emitter *emitter, aur_vector direction) {
    (void)emitter;
    (void)direction;
    return 0.25f / AUR_PI_F;
}

static bool sample_constant(const aur_emitter *emitter, const aur_light_query *query,
                            aur_light_sample *drawn) {
    aur_sample_far(emitter->scene, query->reference.position, aur_sample_sphere(query->u[1], query->u[2]),
                   drawn);
    drawn->radiance = emitter->radiance.constant;
    drawn->pdf = 0.25f / AUR_PI_F;
    return true;
}

static bool emit_constant(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const float radius = emitter->scene->radius;
    *ray = aur_emit_far(emitter->scene, aur_sample_sphere(u[1], u[2]), u[3], u[4]);
    *power = aur_vector_scale(emitter->radiance.constant, 4.0f * AUR_PI_F * AUR_PI_F * radius * radius);
    return true;
}

const aur_emitter_descriptor aur_emitter_constant = {
    .row = {.name = "constant", .summary = "the same radiance from everywhere", AUR_ROW_KEYS(constant_keys)},
    .is_far = true,
    .create = create_constant,
    .sample = sample_constant,
    .emit = emit_constant,
    .radiance_from = constant_from,
    .pdf_from = constant_pdf,
};
