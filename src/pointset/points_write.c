/* Writing points: CSV, JSON, NPY and PLY. */
#include <inttypes.h>
#include <string.h>

#include <aureole/pointset.h>

#include "core/error.h"
#include "core/file.h"

static const char *const format_names[] = {"csv", "json", "npy", "ply"};
enum { FORMAT_COUNT = sizeof format_names / sizeof format_names[0], NAME_CAPACITY = 24 };

aur_result aur_points_format_from_name(const char *name, aur_points_format *format, aur_error *error) {
    for (size_t i = 0; i < FORMAT_COUNT; ++i) {
        if (strcmp(format_names[i], name) == 0) {
            *format = (aur_points_format)i;
            return AUR_OK;
        }
    }
    return aur_fail(error, AUR_ERROR_NAME, "unknown format '%s'; points are written as csv, json, npy or ply",
                    name);
}

const char *aur_points_format_name(aur_points_format format) {
    return (size_t)format < FORMAT_COUNT ? format_names[format] : NULL;
}

/* The name of a column: u,v on the square, x,y on the disk, x,y,z on the sphere, u1,u2,... on the cube. */
static void column_name(const aur_points *points, size_t column, char name[NAME_CAPACITY]) {
    static const char letters[] = "xyz";
    if (points->domain == AUR_DOMAIN_CUBE)
        snprintf(name, NAME_CAPACITY, "u%zu", column + 1);
    else
        snprintf(name, NAME_CAPACITY, "%c",
                 points->domain == AUR_DOMAIN_SQUARE ? (column == 0 ? 'u' : 'v') : letters[column % 3]);
}

static void write_csv(const aur_points *points, FILE *stream) {
    for (size_t d = 0; d < points->dimension; ++d) {
        char name[NAME_CAPACITY];
        column_name(points, d, name);
        fprintf(stream, "%s%s", d > 0 ? "," : "", name);
    }
    fputs(points->weights != NULL ? ",w\n" : "\n", stream);
    for (size_t i = 0; i < points->count; ++i) {
        for (size_t d = 0; d < points->dimension; ++d)
            fprintf(stream, "%s%.17g", d > 0 ? "," : "", points->coordinates[i * points->dimension + d]);
        if (points->weights != NULL)
            fprintf(stream, ",%.17g", points->weights[i]);
        fputc('\n', stream);
    }
}

static void write_json_string(const char *text, FILE *stream) {
    fputc('"', stream);
    for (const char *c = text; *c != '\0'; ++c) {
        if (*c == '"' || *c == '\\')
            fprintf(stream, "\\%c", *c);
        else if ((unsigned char)*c < 0x20)
            fprintf(stream, "\\u%04x", (unsigned)(unsigned char)*c);
        else
            fputc(*c, stream);
    }
    fputc('"', stream);
}

static void write_json(const aur_points *points, const aur_points_origin *origin, FILE *stream) {
    fputs("{", stream);
    if (origin != NULL && origin->set != NULL) {
        fputs("\"set\": ", stream);
        write_json_string(origin->set, stream);
        fprintf(stream, ", \"n\": %" PRIu64 ", \"first\": %" PRIu64, origin->size, origin->first);
        fprintf(stream, ", \"scramble\": \"%s\", \"seed\": %" PRIu64 ", ",
                aur_scramble_name(origin->scramble), origin->seed);
    }
    fprintf(stream, "\"domain\": \"%s\", \"dimension\": %zu,\n\"points\": [", aur_domain_name(points->domain),
            points->dimension);
    for (size_t i = 0; i < points->count; ++i) {
        fputs(i > 0 ? ",\n[" : "\n[", stream);
        for (size_t d = 0; d < points->dimension; ++d)
            fprintf(stream, "%s%.17g", d > 0 ? ", " : "", points->coordinates[i * points->dimension + d]);
        fputc(']', stream);
    }
    fputs("\n]", stream);
    if (points->weights != NULL) {
        fputs(",\n\"weights\": [", stream);
        for (size_t i = 0; i < points->count; ++i)
            fprintf(stream, "%s%.17g", i > 0 ? ",\n" : "\n", points->weights[i]);
        fputs("\n]", stream);
    }
    fputs("}\n", stream);
}

static void write_binary_rows(const aur_points *points, size_t padding, FILE *stream) {
    const double zero = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        fwrite(points->coordinates + i * points->dimension, sizeof(double), points->dimension, stream);
        for (size_t d = 0; d < padding; ++d)
            fwrite(&zero, sizeof zero, 1, stream);
        if (points->weights != NULL)
            fwrite(points->weights + i, sizeof(double), 1, stream);
    }
}

/* NumPy's format, version 1.0: an array of float64 with a row a point, whose last column is the weight where
 * there are weights. */
static void write_npy(const aur_points *points, FILE *stream) {
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
static aur_result write_ply(const aur_points *points, const aur_points_origin *origin, FILE *stream,
                            aur_error *error) {
    if (points->dimension > 3)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a ply file has three coordinates, and these points have %zu: use csv, json or npy",
                        points->dimension);
    fputs("ply\nformat binary_little_endian 1.0\n", stream);
    if (origin != NULL && origin->set != NULL) {
        write_ply_comment("set", origin->set, stream);
        fprintf(stream, "comment n %" PRIu64 "\n", origin->size);
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

aur_result aur_points_write(const char *path, aur_points_format format, const aur_points *points,
                            const aur_points_origin *origin, aur_error *error) {
    if (aur_points_format_name(format) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown format %d", (int)format);
    if (aur_domain_name(points->domain) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown domain %d", (int)points->domain);
    aur_file_writer writer;
    aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    if (format == AUR_POINTS_CSV)
        write_csv(points, writer.stream);
    else if (format == AUR_POINTS_JSON)
        write_json(points, origin, writer.stream);
    else if (format == AUR_POINTS_NPY)
        write_npy(points, writer.stream);
    else
        result = write_ply(points, origin, writer.stream, error);
    if (result != AUR_OK) {
        aur_file_abandon(&writer);
        return result;
    }
    return aur_file_commit(&writer, error);
}
