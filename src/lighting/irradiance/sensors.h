/* Sensors: points with normals. */
#pragma once

#include <aureole-lighting/irradiance.h>

#include "points/base/error.h"

struct aur_sensors {
    aur_sensors_view view;
    double *numbers; /* positions, then normals */
    size_t *lines;
    char *file;
    uint32_t *triangles;
    double *corners;
};

/* The file and line of a sensor, for messages. */
static inline aur_location aur_sensor_location(const aur_sensors_view *sensors, size_t index) {
    return (aur_location){.file = sensors->file, .line = sensors->lines != NULL ? sensors->lines[index] : 0};
}

/* Allocates `count` sensors, and copies the file's name. Errors: MEMORY. */
aur_result aur_sensors_allocate(const char *path, size_t count, aur_sensors *sensors, aur_error *error);

/* Sensors on a mesh; `sensors` is empty. */
aur_result aur_sensors_take_mesh(const char *path, const aur_sensors_options *options, aur_sensors *sensors,
                                 aur_error *error);

/* Returns `failure`, with the location, for the first sensor with a number that is not finite or a normal of
 * length 0. */
aur_result aur_sensors_check(const aur_sensors_view *sensors, aur_result failure, aur_error *error);

/* --- warnings about sensors */

/* Sensors of one kind: the number, and the index of the first. */
typedef struct aur_sensor_oddity {
    size_t count, first;
} aur_sensor_oddity;

typedef struct aur_sensor_oddities {
    aur_sensor_oddity on_surfaces, doubtful, inside, unlit;
} aur_sensor_oddities;

static inline void aur_sensor_count(size_t sensor, aur_sensor_oddity *kind) {
    if (kind->count++ == 0)
        kind->first = sensor;
}

/* Counts a sensor; called in order. `dark` is the share of directions that hit the black back of a surface.
 */
static inline void aur_sensor_note(size_t sensor, bool on_surface, bool doubtful, double dark, double light,
                                   aur_sensor_oddities *odd) {
    if (on_surface)
        aur_sensor_count(sensor, &odd->on_surfaces);
    if (doubtful)
        aur_sensor_count(sensor, &odd->doubtful);
    if (dark > 0.5)
        aur_sensor_count(sensor, &odd->inside);
    else if (!(light > 0.0))
        aur_sensor_count(sensor, &odd->unlit);
}

/* Sends one warning for each kind found. */
void aur_sensors_warn(const aur_sensors_view *sensors, const aur_warnings *to,
                      const aur_sensor_oddities *odd);
