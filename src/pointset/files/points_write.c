/* Writing points: CSV, JSON, NPY and PLY. */
#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

#include <aureole/pointset.h>
#include <aureole/text.h>

#include "core/file.h"
#include "core/names.h"
#include "core/options.h"
#include "pointset/points.h"

static const char *const format_names[] = {"csv", "json", "npy", "ply"};
enum { FORMAT_COUNT = sizeof format_names / sizeof format_names[0], NAME_CAPACITY = 24 };

aur_result aur_points_format_from_name(const char *name, aur_points_format *format, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of(FORMAT_COUNT, format_names), "format of points",
                                               name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *format = (aur_points_format)index;
    return result;
}

const char *aur_points_format_name(aur_points_format format) {
    return (size_t)format < FORMAT_COUNT ? format_names[format] : NULL;
}

/* The name of a column: u,v on the square, x,y on the disk, x,y,z on the sphere, u1,u2,... on the cube,
 * w,x,y,z or m11,m12,... of rotations. */
static void column_name(const aur_points_view *points, size_t column, char name[NAME_CAPACITY]) {
    static const char letters[] = "xyz";
    if (points->domain == AUR_DOMAIN_CUBE)
        snprintf(name, NAME_CAPACITY, "u%zu", column + 1);
    else if (points->domain == AUR_DOMAIN_ROTATIONS && points->dimension == 9)
        snprintf(name, NAME_CAPACITY, "m%zu%zu", column / 3 + 1, column % 3 + 1);
    else if (points->domain == AUR_DOMAIN_ROTATIONS)
        snprintf(name, NAME_CAPACITY, "%c", "wxyz"[column % 4]);
    else
        snprintf(name, NAME_CAPACITY, "%c",
                 points->domain == AUR_DOMAIN_SQUARE ? (column == 0 ? 'u' : 'v') : letters[column % 3]);
}

static void write_csv(const aur_points_view *points, FILE *stream) {
    for (size_t d = 0; d < points->dimension; ++d) {
        char name[NAME_CAPACITY];
        column_name(points, d, name);
        fprintf(stream, "%s%s", d > 0 ? "," : "", name);
    }
    fputs(points->weights != NULL ? ",w\n" : "\n", stream);
    for (size_t i = 0; i < points->count; ++i) {
        for (size_t d = 0; d < points->dimension; ++d)
            aur_print(stream, "%s%.17g", d > 0 ? "," : "", aur_point_at(points, i)[d]);
        if (points->weights != NULL)
            aur_print(stream, ",%.17g", points->weights[i]);
        fputc('\n', stream);
    }
}

static void write_json(const aur_points_view *points, const aur_points_origin *origin, FILE *stream) {
    aur_json json = {.stream = stream};
    aur_json_open(&json, '{', true);
    if (origin != NULL && origin->set != NULL) {
        aur_json_name(&json, "set");
        aur_json_string(&json, origin->set);
        aur_json_name(&json, "n");
        aur_json_integer(&json, origin->count);
        aur_json_name(&json, "first");
        aur_json_integer(&json, origin->first);
        aur_json_name(&json, "scramble");
        aur_json_string(&json, aur_scramble_name(origin->scramble));
        aur_json_name(&json, "seed");
        aur_json_integer(&json, origin->seed);
    }
    aur_json_name(&json, "domain");
    aur_json_string(&json, aur_domain_name(points->domain));
    aur_json_name(&json, "dimension");
    aur_json_integer(&json, points->dimension);
    aur_json_name(&json, "points");
    aur_json_open(&json, '[', true);
    for (size_t i = 0; i < points->count; ++i) {
        aur_json_open(&json, '[', false);
        for (size_t d = 0; d < points->dimension; ++d)
            aur_json_number(&json, aur_point_at(points, i)[d]);
        aur_json_close(&json, ']');
    }
    aur_json_close(&json, ']');
    if (points->weights != NULL) {
        aur_json_name(&json, "weights");
        aur_json_open(&json, '[', true);
        for (size_t i = 0; i < points->count; ++i)
            aur_json_number(&json, points->weights[i]);
        aur_json_close(&json, ']');
    }
    aur_json_close(&json, '}');
}

/* NPY and PLY files say that their numbers are little-endian, whatever the machine is. */
static void write_doubles(const double *values, size_t count, FILE *stream) {
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) {
        fwrite(values, sizeof *values, count, stream);
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        bits = __builtin_bswap64(bits);
        fwrite(&bits, sizeof bits, 1, stream);
    }
}

/* Each point's coordinates, `padding` zeros, and its weight where there are weights. */
static void write_binary_rows(const aur_points_view *points, size_t padding, FILE *stream) {
    static const double zeros[3] = {0.0};
    for (size_t i = 0; i < points->count; ++i) {
        write_doubles(aur_point_at(points, i), points->dimension, stream);
        write_doubles(zeros, padding, stream);
        if (points->weights != NULL)
            write_doubles(points->weights + i, 1, stream);
    }
}

/* NumPy's format, version 1.0: an array of float64 with a row a point, whose last column is the weight where
 * there are weights. */
static void write_npy(const aur_points_view *points, FILE *stream) {
    char header[118];
    const size_t columns = points->dimension + (points->weights != NULL);
    const int length =
        snprintf(header, sizeof header, "{'descr': '<f8', 'fortran_order': False, 'shape': (%zu, %zu), }",
                 points->count, columns);
    memset(header + length, ' ', sizeof header - (size_t)length);
    header[sizeof header - 1] = '\n';
    fwrite("\x93NUMPY\x01\x00", 1, 8, stream);
    fputc((int)(sizeof header), stream);
    fputc(0, stream);
    fwrite(header, 1, sizeof header, stream);
    write_binary_rows(points, 0, stream);
}

/* A comment is one line whatever the text holds. */
static void write_ply_comment(const char *name, const char *text, FILE *stream) {
    fprintf(stream, "comment %s ", name);
    for (const char *c = text; *c != '\0'; ++c)
        fputc((unsigned char)*c < 0x20 ? ' ' : *c, stream);
    fputc('\n', stream);
}

/* Binary little-endian vertices x,y,z (0 where there is no such coordinate), with a property `quality` for
 * the weight, which is where mesh viewers look for a scalar. */
static aur_result write_ply(const aur_points_view *points, const aur_points_origin *origin, FILE *stream,
                            aur_error *error) {
    if (points->dimension > 3)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a ply file has three coordinates, and these points have %zu: use csv, json or npy",
                        points->dimension);
    fputs("ply\nformat binary_little_endian 1.0\n", stream);
    if (origin != NULL && origin->set != NULL) {
        write_ply_comment("set", origin->set, stream);
        fprintf(stream, "comment n %" PRIu64 "\n", origin->count);
        write_ply_comment("scramble", aur_scramble_name(origin->scramble), stream);
        fprintf(stream, "comment seed %" PRIu64 "\n", origin->seed);
    }
    write_ply_comment("domain", aur_domain_name(points->domain), stream);
    fprintf(stream, "element vertex %zu\n", points->count);
    fputs("property double x\nproperty double y\nproperty double z\n", stream);
    if (points->weights != NULL)
        fputs("property double quality\n", stream);
    fputs("end_header\n", stream);
    write_binary_rows(points, 3 - points->dimension, stream);
    return AUR_OK;
}

aur_result aur_points_write(const char *path, aur_points_format format, const aur_points_view *given,
                            const aur_points_origin *origin, aur_error *error) {
    if (aur_points_format_name(format) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown format %d", (int)format);
    aur_points_origin own = aur_points_origin_default();
    aur_file_writer writer;
    aur_points_view view;
    const aur_points_view *const points = &view;
    aur_result result = aur_points_view_read(given, &view, error);
    if (result == AUR_OK)
        result = aur_options_read(origin, sizeof own, sizeof own, &own, "aur_points_origin", error);
    if (result == AUR_OK)
        result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    const aur_points_origin *const known = origin != NULL ? &own : NULL;
    if (format == AUR_POINTS_CSV)
        write_csv(points, writer.stream);
    else if (format == AUR_POINTS_JSON)
        write_json(points, known, writer.stream);
    else if (format == AUR_POINTS_NPY)
        write_npy(points, writer.stream);
    else
        result = write_ply(points, known, writer.stream, error);
    if (result != AUR_OK) {
        aur_file_abandon(&writer);
        return result;
    }
    return aur_file_commit(&writer, error);
}
