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

aur_result aur_sensor_read_lens(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    static const char *const axes[] = {"x", "y", "diagonal", "smaller", "larger"};
    double fov = 0.0, offset_x = 0.0, offset_y = 0.0;
    size_t axis = AUR_FOV_X;
    aur_result result = aur_parameters_float(parameters, "fov", 1e-6, 180.0 - 1e-6, &fov, error);
    if (result == AUR_OK)
        result = aur_parameters_choice(parameters, "fov_axis", 5, axes, &axis, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "principal_point_offset_x", -1e3, 1e3, &offset_x, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "principal_point_offset_y", -1e3, 1e3, &offset_y, error);
    if (result != AUR_OK)
        return result;
    sensor->offset_x = (float)offset_x;
    sensor->offset_y = (float)offset_y;
    const aur_parameter *const focal = aur_parameters_find(parameters, "focal_length");
    if (fov > 0.0 && focal != NULL)
        return aur_fail_at(error, focal->location, AUR_ERROR_FORMAT,
                           "sensor '%s': give 'fov' or 'focal_length', not both", parameters->plugin);
    if (focal != NULL)
        return read_focal_length(parameters, focal, sensor, error);
    if (fov == 0.0)
        return read_focal_length(parameters, &(aur_parameter){.text = (char[]){"50mm"}}, sensor, error);
    sensor->axis = (aur_fov_axis)axis;
    sensor->tangent = (float)tan(0.5 * fov * AUR_PI / 180.0);
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
