#include "lighting/daylight/coefficients.h"

#include <aureole/text.h>
#include <string.h>

#include "points/base/file.h"

static bool is_npy(const char *path) {
    const char *const dot = strrchr(path, '.');
    return dot != NULL && strcmp(dot, ".npy") == 0;
}

aur_result aur_daylight_series_check(const char *path, aur_error *error) {
    const char *const dot = strrchr(path, '.');
    return is_npy(path) || (dot != NULL && strcmp(dot, ".csv") == 0)
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_NAME,
                          "the series of hours goes to a file that ends in .npy or .csv, not to '%s'", path);
}

void aur_daylight_npy_head(const char *shape, FILE *stream) {
    char header[128];
    const int length =
        aur_format(header, sizeof header, "{'descr': '%sf8', 'fortran_order': False, 'shape': (%s), }",
                   __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "<" : ">", shape);
    fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, stream);
    fprintf(stream, "%s%*s\n", header, 0x76 - 1 - length, "");
}

static void write_npy(size_t sensors, size_t hours, const double *values, FILE *stream) {
    char shape[64];
    aur_format(shape, sizeof shape, "%zu, 2, %zu", sensors, hours);
    aur_daylight_npy_head(shape, stream);
    fwrite(values, sizeof *values, 2 * sensors * hours, stream);
}

static void write_csv(const aur_weather_view *weather, size_t sensors, const double *values, FILE *stream) {
    fputs("sensor,month,day,hour,lux,lux_error\n", stream);
    for (size_t i = 0; i < sensors; ++i)
        for (size_t h = 0; h < weather->count; ++h) {
            const aur_weather_hour *const hour = &weather->hours[h];
            const double *const row = values + 2 * i * weather->count;
            aur_print(stream, "%zu,%d,%d,%d,%.9g,%.6g\n", i, hour->month, hour->day, hour->hour, row[h],
                      row[weather->count + h]);
        }
}

aur_result aur_daylight_series_write(const char *path, const aur_weather_view *weather, size_t sensors,
                                     const double *values, aur_error *error) {
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    if (is_npy(path))
        write_npy(sensors, weather->count, values, writer.stream);
    else
        write_csv(weather, sensors, values, writer.stream);
    return aur_file_commit(&writer, error);
}
