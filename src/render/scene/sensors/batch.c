/* Several cameras, with their images side by side on one film. */
#include <string.h>

#include "render/scene/sensor.h"

/* The loader creates the nested cameras and passes them to this sensor. */
static aur_result create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    (void)sensor;
    size_t count = 0;
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, "sensor") != 0)
            continue;
        item->used = true;
        ++count;
    }
    return count > 0 ? AUR_OK
                     : aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs a <sensor> inside");
}

const aur_sensor_descriptor aur_sensor_batch = {
    .row = {.name = "batch",
            .summary = "the cameras inside, each with an equal part of the film's width",
            .source = "Mitsuba 3"},
    .create = create,
};
