/* Parallel rays; the film spans [-1, 1] from right to left in local coordinates. */
#include "render/scene/sensor.h"

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)sensor;
    (void)lens;
    result->origin = (aur_vector){1.0f - 2.0f * x, (1.0f - 2.0f * y) / aspect, 0.0f};
    result->direction = (aur_vector){0.0f, 0.0f, 1.0f};
}

const aur_sensor_descriptor aur_sensor_orthographic = {
    .row = {.name = "orthographic", .summary = "parallel rays along +z"},
    .ray = ray,
};
