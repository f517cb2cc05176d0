#include "lighting/irradiance/sensors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* Larger coordinates have squared distances that overflow floats, and Embree aborts. */
static const double FARTHEST = 1e18;

static bool are_finite(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

aur_result aur_sensors_check(const aur_sensors_view *sensors, aur_result failure, aur_error *error) {
    for (size_t i = 0; i < sensors->count; ++i) {
        const double *const position = sensors->positions + 3 * i, *const normal = sensors->normals + 3 * i;
        if (!are_finite(position) || !are_finite(normal))
            return aur_fail_at(error, aur_sensor_location(sensors, i), failure,
                               "sensor %zu has a number that is not finite", i);
        if (fmax(fmax(fabs(position[0]), fabs(position[1])), fabs(position[2])) > FARTHEST)
            return aur_fail_at(error, aur_sensor_location(sensors, i), failure,
                               "sensor %zu is too far away: a coordinate is beyond %g", i, FARTHEST);
        if (!(fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]) > 0.0))
            return aur_fail_at(
                error, aur_sensor_location(sensors, i), failure,
                "the normal of sensor %zu has length 0: expected the direction that the sensor faces", i);
    }
    return AUR_OK;
}

aur_result aur_sensors_allocate(const char *path, size_t count, aur_sensors *sensors, aur_error *error) {
    size_t bytes;
    sensors->file = strdup(path);
    sensors->numbers = aur_size_product(count, 6 * sizeof(double), &bytes) ? malloc(bytes) : NULL;
    if (sensors->file == NULL || sensors->numbers == NULL)
        return aur_fail_memory(error);
    sensors->view = (aur_sensors_view){.size = sizeof sensors->view,
                                       .count = count,
                                       .positions = sensors->numbers,
                                       .normals = sensors->numbers + 3 * count,
                                       .file = sensors->file};
    return AUR_OK;
}

void aur_sensors_destroy(aur_sensors *sensors) {
    if (sensors == NULL)
        return;
    free(sensors->numbers);
    free(sensors->lines);
    free(sensors->file);
    free(sensors->triangles);
    free(sensors->corners);
    free(sensors);
}

const aur_sensors_view *aur_sensors_get_view(const aur_sensors *sensors) {
    return &sensors->view;
}

void aur_sensors_warn(const aur_sensors_view *sensors, const aur_warnings *to,
                      const aur_sensor_oddities *odd) {
    const aur_sensor_oddity *const on_surfaces = &odd->on_surfaces, *const inside = &odd->inside;
    if (on_surfaces->count > 0 && sensors->file != NULL)
        aur_warn_at(to, aur_sensor_location(sensors, on_surfaces->first),
                    "%zu of %zu sensors lie on surfaces (the first is sensor %zu): they are moved just above",
                    on_surfaces->count, sensors->count, on_surfaces->first);
    if (odd->doubtful.count > 0)
        aur_warn_at(to, aur_sensor_location(sensors, odd->doubtful.first),
                    "%zu of %zu sensors lie where surfaces are closer than the rounding of coordinates (the "
                    "first is sensor %zu): their light may be that above a cover or below it",
                    odd->doubtful.count, sensors->count, odd->doubtful.first);
    if (inside->count > 0)
        aur_warn_at(to, aur_sensor_location(sensors, inside->first),
                    "%zu of %zu sensors see mostly the black backs of surfaces (the first is sensor %zu): "
                    "they are inside an object or face into one",
                    inside->count, sensors->count, inside->first);
    if (odd->unlit.count > 0)
        aur_warn_at(to, aur_sensor_location(sensors, odd->unlit.first),
                    "%zu of %zu sensors see no light at all (the first is sensor %zu)", odd->unlit.count,
                    sensors->count, odd->unlit.first);
}
