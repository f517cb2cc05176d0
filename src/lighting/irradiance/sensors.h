/* Sensors: points that look in directions. */
#pragma once

#include <aureole/irradiance.h>

#include "core/error.h"

struct aur_sensors {
    aur_sensors_view view;
    double *numbers; /* positions, then normals */
    size_t *lines;
    char *file;
};

/* The place of a sensor, for messages. */
static inline aur_location aur_sensor_location(const aur_sensors_view *sensors, size_t index) {
    return (aur_location){.file = sensors->file, .line = sensors->lines != NULL ? sensors->lines[index] : 0};
}

/* `failure`, with the place, for the first sensor with a number that is not finite or a normal of length 0.
 */
aur_result aur_sensors_check(const aur_sensors_view *sensors, aur_result failure, aur_error *error);
