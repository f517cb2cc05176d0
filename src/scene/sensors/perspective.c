/* The pinhole camera, and one with a lens. */
#include "material/sampling.h"
#include "scene/sensor.h"

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)lens;
    result->origin = (aur_vector){0.0f, 0.0f, 0.0f};
    result->direction = aur_sensor_direction(sensor, aur_sensor_half_width(sensor, aspect), aspect, x, y);
}

const aur_sensor_descriptor aur_sensor_perspective = {
    .name = "perspective",
    .summary = "a pinhole camera",
    .create = aur_sensor_read_lens,
    .ray = ray,
    .is_pinhole = true,
};

static aur_result create_thinlens(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    double radius = -1.0, distance = -1.0;
    aur_result result = aur_sensor_read_lens(parameters, sensor, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "aperture_radius", 0.0, AUR_REACH, &radius, error);
    if (result == AUR_OK)
        result =
            aur_parameters_float(parameters, "focus_distance", 1.0 / AUR_REACH, AUR_REACH, &distance, error);
    if (result == AUR_OK && (radius < 0.0 || distance < 0.0))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "sensor 'thinlens' needs 'aperture_radius' and 'focus_distance'");
    sensor->aperture_radius = (float)radius;
    sensor->focus_distance = (float)distance;
    return result;
}

/* All rays of a film point meet in the plane of focus. */
static void thinlens_ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                         aur_ray *result) {
    const aur_vector focus =
        aur_vector_scale(aur_sensor_direction(sensor, aur_sensor_half_width(sensor, aspect), aspect, x, y),
                         sensor->focus_distance);
    aur_vector origin = {0.0f, 0.0f, 0.0f};
    aur_sample_disk(lens[0], lens[1], &origin.x, &origin.y);
    result->origin = aur_vector_scale(origin, sensor->aperture_radius);
    result->direction = aur_vector_subtract(focus, result->origin);
}

const aur_sensor_descriptor aur_sensor_thinlens = {
    .name = "thinlens",
    .summary = "a camera with an aperture and a plane of focus",
    .create = create_thinlens,
    .ray = thinlens_ray,
};
