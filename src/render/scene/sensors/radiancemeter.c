/* The radiance along one ray, the same in every pixel. */
#include "points/base/vector3d.h"
#include "render/scene/sensor.h"

typedef struct radiancemeter_keys {
    double origin[3], direction[3];
} radiancemeter_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_VECTOR(radiancemeter_keys, "origin", origin, -AUR_REACH, AUR_REACH, "by to_world",
                       "position, with direction, instead of to_world"),
     .computed = true},
    {AUR_KEY_OF_VECTOR(radiancemeter_keys, "direction", direction, -AUR_REACH, AUR_REACH, "by to_world",
                       "viewing direction"),
     .computed = true},
};

static aur_result create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    radiancemeter_keys p = {{0.0}, {0.0}};
    const aur_result result = aur_keys_read(sizeof keys / sizeof keys[0], keys, parameters, &p, error);
    const bool origin = aur_parameters_find(parameters, "origin") != NULL;
    const bool direction = aur_parameters_find(parameters, "direction") != NULL;
    if (result != AUR_OK || (!origin && !direction))
        return result;
    if (!origin || !direction || aur_parameters_find(parameters, "to_world") != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "give 'origin' with 'direction', or 'to_world'");
    if (aur_normalize3(p.direction) < 1.0 / AUR_REACH)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "'direction' must not be 0 0 0");
    double x[3], y[3];
    aur_frame3(p.direction, x, y);
    for (size_t i = 0; i < 3; ++i) {
        sensor->to_world[4 * i] = (float)x[i];
        sensor->to_world[4 * i + 1] = (float)y[i];
        sensor->to_world[4 * i + 2] = (float)p.direction[i];
        sensor->position[i] = p.origin[i];
    }
    return AUR_OK;
}

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)sensor, (void)aspect, (void)x, (void)y, (void)lens;
    result->direction = (aur_vector){0.0f, 0.0f, 1.0f};
}

const aur_sensor_descriptor aur_sensor_radiancemeter = {
    .row = {.name = "radiancemeter",
            .summary = "the radiance along one ray",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .ray = ray,
};
