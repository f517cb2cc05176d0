/* A disk of the sky, infinitely far: the sun, or any cap up to the whole sphere. */
#include <math.h>

#include "render/scene/emitter.h"
#include "render/scene/lights/sun_disk.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct sun_keys {
    double half_angle;
    aur_color irradiance, radiance;
    double illuminance;
    aur_sun_keys sun;
} sun_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(sun_keys, "half_angle", half_angle, 1e-2, 180.0, "0.2665",
                     "degrees from the centre of the disk to its edge; 90 is a hemisphere")},
    {AUR_KEY_OF_COLOR(sun_keys, "irradiance", irradiance, 1e30, "1",
                      "on a plane that faces the disk, RGB; for half angles up to 90")},
    {AUR_KEY_OF_REAL(sun_keys, "illuminance", illuminance, 0.0, 1e30, "by irradiance",
                     "the same in lux, divided by 179 lm/W"),
     .computed = true},
    {AUR_KEY_OF_COLOR(sun_keys, "radiance", radiance, 1e30, "by irradiance", "of the disk, RGB"),
     .computed = true},
    AUR_SUN_KEYS(sun_keys),
};

static aur_result read_radiance(const sun_keys *p, aur_parameters *parameters, aur_emitter *emitter,
                                aur_error *error) {
    const bool irradiance = aur_parameters_find(parameters, "irradiance") != NULL;
    const bool illuminance = aur_parameters_find(parameters, "illuminance") != NULL;
    const bool radiance = aur_parameters_find(parameters, "radiance") != NULL;
    if (p->irradiance.texture != NULL || p->radiance.texture != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "its colours cannot be textures; use an envmap");
    if ((int)irradiance + (int)illuminance + (int)radiance > 1)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "give one of 'irradiance', 'illuminance' and 'radiance'");
    if (!radiance && p->half_angle > 90.0)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "with a half angle of more than 90 give 'radiance'");
    const double sine = sin(p->half_angle * AUR_PI / 180.0);
    const float gray = (float)(p->illuminance / 179.0);
    const aur_vector facing = illuminance ? (aur_vector){gray, gray, gray} : p->irradiance.constant;
    emitter->radiance.constant =
        radiance ? p->radiance.constant : aur_vector_scale(facing, (float)(1.0 / (AUR_PI * sine * sine)));
    return AUR_OK;
}

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    aur_sun_disk *const self = emitter->data;
    sun_keys p = {.half_angle = 0.0};
    aur_sun_position position;
    aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_sun_position_read(&p.sun, parameters, &position, error);
    if (result == AUR_OK)
        result = aur_sun_position_need(&position, parameters, error);
    if (result == AUR_OK)
        result = read_radiance(&p, parameters, emitter, error);
    if (result != AUR_OK)
        return result;
    double center[3];
    for (int d = 0; d < 3; ++d)
        center[d] = position.sun[0] * position.east[d] + position.sun[1] * position.north[d] +
                    position.sun[2] * position.up[d];
    *self = aur_sun_disk_make(center, p.half_angle);
    emitter->extent = AUR_PI * aur_sun_disk_solid_angle(self);
    return AUR_OK;
}

static aur_vector radiance_from(const aur_emitter *emitter, aur_vector direction) {
    return aur_sun_disk_contains(emitter->data, direction) ? emitter->radiance.constant : (aur_vector){0};
}

static float pdf_from(const aur_emitter *emitter, aur_vector direction) {
    const aur_sun_disk *const self = emitter->data;
    return aur_sun_disk_contains(self, direction) ? (float)(1.0 / aur_sun_disk_solid_angle(self)) : 0.0f;
}

static aur_vector draw(const aur_emitter *emitter, float u, float v) {
    return aur_sun_disk_draw(emitter->data, u, v);
}

const aur_emitter_descriptor aur_emitter_sun = {
    .row = {.name = "sun",
            .summary = "a disk of the sky, by default the sun; adds to any other environment",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(aur_sun_disk),
    .is_far = true,
    .adds = true,
    .create = create,
    .sample = aur_environment_sample,
    .emit = aur_environment_emit,
    .draw = draw,
    .radiance_from = radiance_from,
    .pdf_from = pdf_from,
};
