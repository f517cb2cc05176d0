#include "scene/sensor.h"

#include <stdlib.h>
#include <string.h>

#include "core/text.h"

/* "50mm" on 35 mm film, whose diagonal is that of 36 mm by 24 mm. */
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

aur_result aur_sensor_set_lens(const aur_parameters *parameters, const aur_lens_keys *keys,
                               aur_sensor *sensor, aur_error *error) {
    const aur_parameter *const focal = keys->focal_length;
    sensor->offset_x = (float)keys->offset_x;
    sensor->offset_y = (float)keys->offset_y;
    if (keys->fov > 0.0 && focal != NULL)
        return aur_fail_at(error, focal->location, AUR_ERROR_FORMAT,
                           "sensor '%s': give 'fov' or 'focal_length', not both", parameters->plugin);
    if (keys->fov == 0.0)
        return read_focal_length(
            parameters, focal != NULL ? focal : &(aur_parameter){.text = (char[]){"50mm"}}, sensor, error);
    sensor->axis = keys->fov_axis;
    sensor->tangent = (float)tan(0.5 * keys->fov * AUR_PI / 180.0);
    return AUR_OK;
}

float aur_sensor_half_width(const aur_sensor *sensor, float aspect) {
    switch (sensor->axis) {
    case AUR_FOV_X:
        break;
    case AUR_FOV_Y:
        return sensor->tangent * aspect;
    case AUR_FOV_DIAGONAL:
        return sensor->tangent * aspect / sqrtf(1.0f + aspect * aspect);
    case AUR_FOV_SMALLER:
        return aspect > 1.0f ? sensor->tangent * aspect : sensor->tangent;
    case AUR_FOV_LARGER:
        return aspect > 1.0f ? sensor->tangent : sensor->tangent * aspect;
    }
    return sensor->tangent;
}
