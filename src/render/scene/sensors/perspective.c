/* The pinhole camera and the thin-lens camera. */
#include <string.h>

#include "points/base/text.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/sensor.h"

typedef struct lens_keys {
    double fov; /* degrees; 0: default */
    aur_fov_axis fov_axis;
    double offset_x, offset_y;
    const aur_parameter *focal_length;
    double aperture_radius, focus_distance; /* -1: default */
} lens_keys;

#define LENS_KEYS                                                                                            \
    {AUR_KEY_OF_REAL(lens_keys, "fov", fov, 1e-6, 180.0 - 1e-6, "by focal_length",                           \
                     "field of view, degrees"),                                                              \
     .computed = true},                                                                                      \
        {AUR_KEY_OF_CHOICE(lens_keys, "fov_axis", fov_axis, "x", "axis of the image that fov refers to",     \
                           "x", "y", "diagonal", "smaller", "larger")},                                      \
        {AUR_KEY_OF_REAL(lens_keys, "principal_point_offset_x", offset_x, -1e3, 1e3, "0",                    \
                         "horizontal shift, in image widths")},                                              \
        {AUR_KEY_OF_REAL(lens_keys, "principal_point_offset_y", offset_y, -1e3, 1e3, "0",                    \
                         "vertical shift, in image heights")},                                               \
    {                                                                                                        \
        AUR_KEY_OF_ITEM(lens_keys, "focal_length", focal_length, "50mm", "instead of fov, on 35 mm film",    \
                        "millimetres")                                                                       \
    }

static const aur_key pinhole_table[] = {LENS_KEYS};

static const aur_key thinlens_table[] = {
    LENS_KEYS,
    {AUR_KEY_OF_REAL(lens_keys, "aperture_radius", aperture_radius, 0.0, AUR_REACH, NULL,
                     "of the lens, scene units; must be given")},
    {AUR_KEY_OF_REAL(lens_keys, "focus_distance", focus_distance, 1.0 / AUR_REACH, AUR_REACH, NULL,
                     "of the plane that is sharp, scene units; must be given")},
};

/* "50mm" on 35 mm film, for the diagonal of 36 mm by 24 mm. */
static aur_result read_focal_length(const aur_parameters *parameters, const aur_parameter *item,
                                    aur_sensor *sensor, aur_error *error) {
    double length = 0.0;
    const char *const end =
        item->text != NULL ? aur_read_double(aur_skip_spaces(item->text), AUR_NUMBER_FINITE, &length) : NULL;
    if (end == NULL || !(length > 0.0) || (*end != '\0' && strcmp(end, "mm") != 0))
        return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                           "sensor '%s': 'focal_length' must be millimetres such as 50mm",
                           parameters->plugin);
    sensor->axis = AUR_FOV_DIAGONAL;
    sensor->tangent = (float)(sqrt(36.0 * 36.0 + 24.0 * 24.0) / (2.0 * length));
    return AUR_OK;
}

static aur_result read_lens(aur_parameters *parameters, aur_sensor *sensor, lens_keys *p, aur_error *error) {
    *p = (lens_keys){.aperture_radius = -1.0, .focus_distance = -1.0};
    const aur_result result = aur_row_read(&sensor->descriptor->row, parameters, p, error);
    if (result != AUR_OK)
        return result;
    const aur_parameter *const focal = p->focal_length;
    sensor->offset_x = (float)p->offset_x;
    sensor->offset_y = (float)p->offset_y;
    if (p->fov > 0.0 && focal != NULL)
        return aur_fail_at(error, focal->location, AUR_ERROR_FORMAT,
                           "sensor '%s': give 'fov' or 'focal_length', not both", parameters->plugin);
    if (p->fov == 0.0)
        return read_focal_length(
            parameters, focal != NULL ? focal : &(aur_parameter){.text = (char[]){"50mm"}}, sensor, error);
    sensor->axis = p->fov_axis;
    sensor->tangent = (float)tan(0.5 * p->fov * AUR_PI / 180.0);
    return AUR_OK;
}

/* --- perspective */

static aur_result create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    lens_keys p;
    return read_lens(parameters, sensor, &p, error);
}

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)lens;
    result->direction = aur_sensor_direction(sensor, aur_sensor_half_width(sensor, aspect), aspect, x, y);
}

const aur_sensor_descriptor aur_sensor_perspective = {
    .row = {.name = "perspective", .summary = "a pinhole camera", AUR_ROW_KEYS(pinhole_table)},
    .create = create,
    .ray = ray,
    .is_pinhole = true,
};

/* --- thinlens */

static aur_result create_thinlens(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    lens_keys p;
    const aur_result result = read_lens(parameters, sensor, &p, error);
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
            AUR_ROW_KEYS(thinlens_table)},
    .create = create_thinlens,
    .ray = thinlens_ray,
};
