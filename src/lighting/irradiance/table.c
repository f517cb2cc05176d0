#include "lighting/irradiance/table.h"

#include <aureole/pointset.h>
#include <aureole/text.h>
#include <math.h>
#include <string.h>

#include "points/base/file.h"
#include "render/image/format.h"

static double value_of(const aur_sensor_table *o, size_t sensor, size_t column) {
    return o->values[o->width * sensor + column];
}

static void write_csv(const aur_sensor_table *o, FILE *stream) {
    for (size_t k = 0; k < o->width; ++k)
        fprintf(stream, "%s%s", k > 0 ? "," : "", o->columns[k].name);
    fputc('\n', stream);
    for (size_t i = 0; i < o->sensors->count; ++i)
        for (size_t k = 0; k < o->width; ++k)
            aur_print(stream, o->columns[k].rough ? "%.6g%c" : "%.17g%c", value_of(o, i, k),
                      k + 1 < o->width ? ',' : '\n');
}

/* As rtrace -h -I: three numbers per line. */
static void write_rtrace(const aur_sensor_table *o, FILE *stream) {
    for (size_t i = 0; i < o->sensors->count; ++i) {
        for (size_t c = 0; c < 3; ++c)
            aur_print(stream, "%e\t", value_of(o, i, o->color + (o->colors > 1 ? c : 0)));
        fputc('\n', stream);
    }
}

static void write_json(const aur_sensor_table *o, FILE *stream) {
    aur_json json = {.stream = stream};
    aur_json_open(&json, '[', true);
    for (size_t i = 0; i < o->sensors->count; ++i) {
        aur_json_open(&json, '{', false);
        for (size_t k = 0; k < o->width; ++k) {
            aur_json_name(&json, o->columns[k].name);
            aur_json_number(&json, value_of(o, i, k));
        }
        aur_json_close(&json, '}');
    }
    aur_json_close(&json, ']');
}

/* The sensor's colour, scaled so that the largest channel of all sensors is 1. */
static void color_of(const aur_sensor_table *o, size_t i, double largest, unsigned char color[3]) {
    for (size_t c = 0; c < 3; ++c) {
        const double value = value_of(o, i, o->color + (o->colors > 1 ? c : 0));
        color[c] = (unsigned char)(255.0 * aur_srgb_encode(value / largest) + 0.5);
    }
}

static double largest_value(const aur_sensor_table *o) {
    double largest = 0.0;
    for (size_t i = 0; i < o->sensors->count; ++i)
        for (size_t c = 0; c < o->colors; ++c)
            largest = fmax(largest, value_of(o, i, o->color + c));
    return largest > 0.0 ? largest : 1.0;
}

/* Each sensor is a vertex, or three: the corners of its face. */
static void write_ply(const aur_sensor_table *o, FILE *stream) {
    const aur_sensors_view *const sensors = o->sensors;
    const size_t copies = sensors->corners != NULL ? 3 : 1;
    const size_t faces = sensors->corners != NULL ? sensors->count : sensors->triangle_count;
    fprintf(stream, "ply\nformat %s 1.0\nelement vertex %zu\n",
            __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "binary_little_endian" : "binary_big_endian",
            copies * sensors->count);
    for (size_t k = 0; k < o->width; ++k)
        fprintf(stream, "property double %s\n", o->columns[k].name);
    fputs("property uchar red\nproperty uchar green\nproperty uchar blue\n", stream);
    if (faces > 0)
        fprintf(stream, "element face %zu\nproperty list uchar uint vertex_indices\n", faces);
    fputs("end_header\n", stream);
    const double largest = largest_value(o);
    for (size_t i = 0; i < copies * sensors->count; ++i) {
        unsigned char color[3];
        for (size_t k = 0; k < o->width; ++k) {
            const bool at_corner = copies == 3 && k < 3;
            const double value = at_corner ? sensors->corners[3 * i + k] : value_of(o, i / copies, k);
            fwrite(&value, sizeof value, 1, stream);
        }
        color_of(o, i / copies, largest, color);
        fwrite(color, sizeof color, 1, stream);
    }
    for (size_t i = 0; i < faces; ++i) {
        uint32_t corners[3];
        for (size_t k = 0; k < 3; ++k)
            corners[k] = copies == 3 ? (uint32_t)(3 * i + k) : sensors->triangles[3 * i + k];
        fputc(3, stream);
        fwrite(corners, sizeof corners, 1, stream);
    }
}

/* As an NPY array without column names. */
static aur_result write_npy(const aur_sensor_table *o, const char *path, aur_error *error) {
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_CUBE, o->sensors->count, o->width, o->values);
    return aur_points_write(path, AUR_POINTS_NPY, &view, NULL, error);
}

aur_result aur_sensor_table_write(const char *path, const char *format, const aur_sensor_table *table,
                                  aur_error *error) {
    static const struct {
        const char *name;
        void (*write)(const aur_sensor_table *table, FILE *stream);
    } formats[] = {{"csv", write_csv}, {"json", write_json}, {"ply", write_ply}, {"rtrace", write_rtrace}};
    if (strcmp(format, "npy") == 0)
        return write_npy(table, path, error);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i) {
        if (strcmp(format, formats[i].name) != 0)
            continue;
        aur_file_writer writer;
        const aur_result opened = aur_file_open(path, &writer, error);
        if (opened != AUR_OK)
            return opened;
        formats[i].write(table, writer.stream);
        return aur_file_commit(&writer, error);
    }
    return aur_fail(error, AUR_ERROR_NAME, "unknown format '%s': expected csv, json, npy, ply or rtrace",
                    format);
}
