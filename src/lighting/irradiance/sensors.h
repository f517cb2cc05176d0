/* Sensors: points that look in directions. */
#pragma once

#include <aureole/irradiance.h>

#include "core/error.h"

struct aur_sensors {
    aur_sensors_view view;
    double *numbers; /* positions, then normals */
    size_t *lines;
    char *file;
    uint32_t *triangles;
    double *corners;
};

/* The place of a sensor, for messages. */
static inline aur_location aur_sensor_location(const aur_sensors_view *sensors, size_t index) {
    return (aur_location){.file = sensors->file, .line = sensors->lines != NULL ? sensors->lines[index] : 0};
}

/* Room for `count` sensors, and the file's name. Errors: MEMORY. */
aur_result aur_sensors_allocate(const char *path, size_t count, aur_sensors *sensors, aur_error *error);

/* Sensors on a mesh; `sensors` is empty. */
aur_result aur_sensors_take_mesh(const char *path, const aur_sensors_options *options, aur_sensors *sensors,
                                 aur_error *error);

/* `failure`, with the place, for the first sensor with a number that is not finite or a normal of length 0.
 */
aur_result aur_sensors_check(const aur_sensors_view *sensors, aur_result failure, aur_error *error);
