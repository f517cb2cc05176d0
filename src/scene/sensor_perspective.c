/* The pinhole camera. */
#include "scene/sensor.h"

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)lens;
    result->origin = (aur_vector){0.0f, 0.0f, 0.0f};
    result->direction = aur_sensor_direction(sensor, aspect, x, y);
}

const aur_sensor_descriptor aur_sensor_perspective = {"perspective", "a pinhole camera", aur_sensor_read_lens,
                                                      ray};
