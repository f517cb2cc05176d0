/* Every camera by name. One new camera is one new file and one line here. */
#include <string.h>

#include "scene/sensor.h"

extern const aur_sensor_descriptor aur_sensor_perspective;
extern const aur_sensor_descriptor aur_sensor_thinlens;
extern const aur_sensor_descriptor aur_sensor_orthographic;

static const aur_sensor_descriptor *const table[] = {
    &aur_sensor_perspective,
    &aur_sensor_thinlens,
    &aur_sensor_orthographic,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

const aur_sensor_descriptor *aur_sensor_descriptor_at(size_t index) {
    return index < TABLE_SIZE ? table[index] : NULL;
}

static aur_result read_common(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    aur_transform to_world, to_local;
    double near_clip = 1e-2, far_clip = 1e4;
    aur_result result = aur_parameters_to_world(parameters, &to_world, &to_local, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "near_clip", 0.0, 1e30, &near_clip, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "far_clip", 0.0, INFINITY, &far_clip, error);
    if (result != AUR_OK)
        return result;
    if (!(near_clip < far_clip))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "sensor '%s': near_clip (%g) must be less than far_clip (%g)", parameters->plugin,
                           near_clip, far_clip);
    for (size_t i = 0; i < 12; ++i)
        sensor->to_world[i] = (float)to_world.m[i];
    sensor->near_clip = (float)near_clip;
    sensor->far_clip = (float)far_clip;
    return AUR_OK;
}

aur_result aur_sensor_create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    *sensor = (aur_sensor){0};
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0)
            sensor->descriptor = table[i];
    }
    if (sensor->descriptor == NULL)
        return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
    aur_result result = read_common(parameters, sensor, error);
    if (result == AUR_OK)
        result = sensor->descriptor->create(parameters, sensor, error);
    return result != AUR_OK ? result : aur_parameters_finish(parameters, error);
}
