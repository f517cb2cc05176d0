/* Reads sensors from files. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/irradiance/sensors.h"
#include "points/base/error.h"
#include "points/base/file.h"
#include "points/pointset/files/points_file.h"
#include "render/scene/importers/meshes/mesh_data.h"

static const size_t FILE_LIMIT = (size_t)1 << 34;

static aur_result take(aur_matrix *matrix, const char *path, aur_sensors *sensors, aur_error *error) {
    const aur_location surface_point = {.file = path};
    if (matrix->row_count == 0)
        return aur_fail_at(error, surface_point, AUR_ERROR_FORMAT, "there are no sensors in it");
    if (matrix->column_count != 6)
        return aur_fail_at(
            error, (aur_location){.file = path, .line = matrix->lines != NULL ? matrix->lines[0] : 0},
            AUR_ERROR_FORMAT, "a sensor is six numbers, x y z nx ny nz, not %zu", matrix->column_count);
    if (matrix->header[0] != '\0' && strcmp(matrix->header, "x,y,z,nx,ny,nz") != 0)
        return aur_fail_at(error, surface_point, AUR_ERROR_FORMAT,
                           "the columns of sensors are x,y,z,nx,ny,nz, not %s", matrix->header);
    const size_t count = matrix->row_count;
    const aur_result result = aur_sensors_allocate(path, count, sensors, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < count; ++i)
        for (size_t d = 0; d < 3; ++d) {
            sensors->numbers[3 * i + d] = matrix->values[6 * i + d];
            sensors->numbers[3 * (count + i) + d] = matrix->values[6 * i + 3 + d];
        }
    sensors->view.lines = sensors->lines = matrix->lines;
    matrix->lines = NULL;
    return AUR_OK;
}

static aur_result read_table(const char *path, aur_sensors *sensors, aur_error *error) {
    char *data = NULL;
    size_t size = 0;
    aur_result result = aur_file_read(path, FILE_LIMIT, &data, &size, error);
    if (result != AUR_OK)
        return result;
    aur_matrix matrix = {0};
    result = aur_npy_recognize(data, size) ? aur_npy_parse(path, data, size, &matrix, error)
                                           : aur_csv_parse(path, data, size, &matrix, error);
    if (result == AUR_OK)
        result = take(&matrix, path, sensors, error);
    free(data);
    free(matrix.values);
    free(matrix.lines);
    return result;
}

static void lift(double distance, aur_sensors *sensors) {
    const size_t count = sensors->view.count;
    for (size_t i = 0; i < count; ++i) {
        double *const position = sensors->numbers + 3 * i;
        const double *const normal = sensors->numbers + 3 * (count + i);
        const double length = hypot(hypot(normal[0], normal[1]), normal[2]);
        for (size_t d = 0; d < 3; ++d)
            position[d] += distance * (normal[d] / length);
    }
}

aur_result aur_sensors_read(const char *path, const aur_sensors_options *given, aur_sensors **sensors,
                            aur_error *error) {
    *sensors = NULL;
    aur_sensors_options options = {.size = sizeof options};
    aur_sensors_options_init(&options, NULL);
    aur_result result = aur_options_read(given, sizeof options, &options, "aur_sensors_options", error);
    if (result == AUR_OK && !isfinite(options.lift))
        result =
            aur_fail(error, AUR_ERROR_ARGUMENT, "the lift of sensors must be finite, not %g", options.lift);
    if (result != AUR_OK)
        return result;
    aur_sensors *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    result = aur_mesh_format_of_name(path) < AUR_MESH_FORMAT_COUNT
                 ? aur_sensors_take_mesh(path, &options, created, error)
                 : read_table(path, created, error);
    if (result == AUR_OK)
        result = aur_sensors_check(&created->view, AUR_ERROR_FORMAT, error);
    if (result != AUR_OK) {
        aur_sensors_destroy(created);
        return result;
    }
    if (options.lift != 0.0)
        lift(options.lift, created);
    *sensors = created;
    return AUR_OK;
}

aur_result aur_sensors_options_init(aur_sensors_options *options, aur_error *error) {
    static const aur_sensors_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_sensors_options", error);
}
