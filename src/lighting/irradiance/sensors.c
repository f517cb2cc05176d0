#include "lighting/irradiance/sensors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "core/file.h"
#include "core/vector3d.h"
#include "pointset/files/points_file.h"

static const size_t FILE_LIMIT = (size_t)1 << 34;

static bool are_finite(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

aur_result aur_sensors_check(const aur_sensors_view *sensors, aur_result failure, aur_error *error) {
    for (size_t i = 0; i < sensors->count; ++i) {
        const double *const position = sensors->positions + 3 * i, *const normal = sensors->normals + 3 * i;
        if (!are_finite(position) || !are_finite(normal))
            return aur_fail_at(error, aur_sensor_location(sensors, i), failure,
                               "sensor %zu has a number that is not finite", i);
        if (!(fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]) > 0.0))
            return aur_fail_at(error, aur_sensor_location(sensors, i), failure,
                               "the normal of sensor %zu has length 0: it must say where the sensor looks",
                               i);
    }
    return AUR_OK;
}

static aur_result take(aur_matrix *matrix, const char *path, aur_sensors *sensors, aur_error *error) {
    const aur_location place = {.file = path};
    if (matrix->row_count == 0)
        return aur_fail_at(error, place, AUR_ERROR_FORMAT, "there are no sensors in it");
    if (matrix->column_count != 6)
        return aur_fail_at(
            error, (aur_location){.file = path, .line = matrix->lines != NULL ? matrix->lines[0] : 0},
            AUR_ERROR_FORMAT, "a sensor is six numbers, x y z nx ny nz, not %zu", matrix->column_count);
    if (matrix->header[0] != '\0' && strcmp(matrix->header, "x,y,z,nx,ny,nz") != 0)
        return aur_fail_at(error, place, AUR_ERROR_FORMAT,
                           "the columns of sensors are x,y,z,nx,ny,nz, not %s", matrix->header);
    const size_t count = matrix->row_count;
    size_t bytes;
    sensors->file = strdup(path);
    sensors->numbers = aur_size_product(count, 6 * sizeof(double), &bytes) ? malloc(bytes) : NULL;
    if (sensors->file == NULL || sensors->numbers == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i)
        for (size_t d = 0; d < 3; ++d) {
            sensors->numbers[3 * i + d] = matrix->values[6 * i + d];
            sensors->numbers[3 * (count + i) + d] = matrix->values[6 * i + 3 + d];
        }
    sensors->lines = matrix->lines;
    matrix->lines = NULL;
    sensors->view = (aur_sensors_view){.size = sizeof sensors->view,
                                       .count = count,
                                       .positions = sensors->numbers,
                                       .normals = sensors->numbers + 3 * count,
                                       .lines = sensors->lines,
                                       .file = sensors->file};
    return aur_sensors_check(&sensors->view, AUR_ERROR_FORMAT, error);
}

aur_result aur_sensors_read(const char *path, aur_sensors **sensors, aur_error *error) {
    *sensors = NULL;
    char *data = NULL;
    size_t size = 0;
    aur_result result = aur_file_read(path, FILE_LIMIT, &data, &size, error);
    if (result != AUR_OK)
        return result;
    aur_sensors *const made = calloc(1, sizeof *made);
    aur_matrix matrix = {0};
    if (made == NULL)
        result = aur_fail_memory(error);
    else if (aur_npy_recognize(data, size))
        result = aur_npy_parse(path, data, size, &matrix, error);
    else
        result = aur_csv_parse(path, data, size, &matrix, error);
    if (result == AUR_OK)
        result = take(&matrix, path, made, error);
    free(data);
    free(matrix.values);
    free(matrix.lines);
    if (result != AUR_OK) {
        aur_sensors_destroy(made);
        return result;
    }
    *sensors = made;
    return AUR_OK;
}

void aur_sensors_destroy(aur_sensors *sensors) {
    if (sensors == NULL)
        return;
    free(sensors->numbers);
    free(sensors->lines);
    free(sensors->file);
    free(sensors);
}

const aur_sensors_view *aur_sensors_look(const aur_sensors *sensors) {
    return &sensors->view;
}
