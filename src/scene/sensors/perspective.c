/* The pinhole camera, and one with a lens. */
#include "material/sampling.h"
#include "scene/sensor.h"

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)lens;
    result->origin = (aur_vector){0.0f, 0.0f, 0.0f};
    result->direction = aur_sensor_direction(sensor, aur_sensor_half_width(sensor, aspect), aspect, x, y);
}

static const aur_key lens_keys[] = {AUR_LENS_KEYS};

static aur_result create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    aur_lens_keys p = {.fov = 0.0};
    const aur_result result = aur_row_read(&sensor->descriptor->row, parameters, &p, error);
    return result == AUR_OK ? aur_sensor_set_lens(parameters, &p, sensor, error) : result;
}

const aur_sensor_descriptor aur_sensor_perspective = {
    .row = {.name = "perspective", .summary = "a pinhole camera", .source = "", AUR_ROW_KEYS(lens_keys)},
    .create = create,
    .ray = ray,
    .is_pinhole = true,
};

typedef struct thinlens_keys {
    aur_lens_keys lens;
    double aperture_radius, focus_distance;
} thinlens_keys;

static const aur_key thinlens_table[] = {
    AUR_LENS_KEYS,
    {AUR_KEY_OF_REAL(thinlens_keys, "aperture_radius", aperture_radius, 0.0, AUR_REACH, NULL,
                     "of the lens, scene units; must be given")},
    {AUR_KEY_OF_REAL(thinlens_keys, "focus_distance", focus_distance, 1.0 / AUR_REACH, AUR_REACH, NULL,
                     "of the plane that is sharp, scene units; must be given")},
};

static aur_result create_thinlens(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    thinlens_keys p = {.aperture_radius = -1.0, .focus_distance = -1.0};
    aur_result result = aur_row_read(&sensor->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_sensor_set_lens(parameters, &p.lens, sensor, error);
    if (result == AUR_OK && (p.aperture_radius < 0.0 || p.focus_distance < 0.0))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "sensor 'thinlens' needs 'aperture_radius' and 'focus_distance'");
    sensor->aperture_radius = (float)p.aperture_radius;
    sensor->focus_distance = (float)p.focus_distance;
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
    .row = {.name = "thinlens",
            .summary = "a camera with an aperture and a plane of focus",
            .source = "",
            AUR_ROW_KEYS(thinlens_table)},
    .create = create_thinlens,
    .ray = thinlens_ray,
};
