/* Writing points: CSV, JSON, NPY and PLY. */
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <aureole/pointset.h>
#include <aureole/text.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/names.h"
#include "points/pointset/points.h"

static const char *const format_names[] = {"csv", "json", "npy", "ply"};
enum { FORMAT_COUNT = sizeof format_names / sizeof format_names[0], MOST_DIGITS = 17 };

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

void aur_points_column_name(const aur_points_view *points, size_t column,
                            char name[AUR_COLUMN_NAME_CAPACITY]) {
    static const char letters[] = "xyz";
    if (points->domain == AUR_DOMAIN_CUBE)
        snprintf(name, AUR_COLUMN_NAME_CAPACITY, "u%zu", column + 1);
    else if (points->domain == AUR_DOMAIN_ROTATIONS && points->dimension == 9)
        snprintf(name, AUR_COLUMN_NAME_CAPACITY, "m%zu%zu", column / 3 + 1, column % 3 + 1);
    else if (points->domain == AUR_DOMAIN_ROTATIONS)
        snprintf(name, AUR_COLUMN_NAME_CAPACITY, "%c", "wxyz"[column % 4]);
    else
        snprintf(name, AUR_COLUMN_NAME_CAPACITY, "%c",
                 points->domain == AUR_DOMAIN_SQUARE ? (column == 0 ? 'u' : 'v') : letters[column % 3]);
}

void aur_points_write_header(const aur_points_view *points, size_t weights, FILE *stream) {
    for (size_t d = 0; d < points->dimension; ++d) {
        char name[AUR_COLUMN_NAME_CAPACITY];
        aur_points_column_name(points, d, name);
        fprintf(stream, "%s%s", d > 0 ? "," : "", name);
    }
    const char *const name = points->domain == AUR_DOMAIN_ROTATIONS ? "weight" : "w"; /* w is a coordinate */
    for (size_t k = 0; k < weights; ++k)
        fprintf(stream, k == 0 ? ",%s" : ",%s%zu", name, k + 1);
    if (aur_points_are_above(points))
        fprintf(stream, "# domain: %s", aur_domain_name(points->domain));
    fputc('\n', stream);
}

static void write_csv(const aur_points_view *points, const aur_points_write_options *options, FILE *stream) {
    const int digits = options->digits != 0 ? (int)options->digits : MOST_DIGITS;
    if (!options->no_header)
        aur_points_write_header(points, points->weights != NULL, stream);
    for (size_t i = 0; i < points->count; ++i) {
        for (size_t d = 0; d < points->dimension; ++d)
            aur_print(stream, "%s%.*g", d > 0 ? "," : "", digits, aur_point_at(points, i)[d]);
        if (points->weights != NULL)
            aur_print(stream, ",%.*g", digits, points->weights[i]);
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

/* NPY and PLY files are little-endian on every machine. */
static void write_little(size_t bytes, const void *value, FILE *stream) {
    unsigned char bytes_of[sizeof(double)];
    memcpy(bytes_of, value, bytes);
    for (size_t i = 0; i < bytes / 2 && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__; ++i) {
        const unsigned char other = bytes_of[i];
        bytes_of[i] = bytes_of[bytes - 1 - i];
        bytes_of[bytes - 1 - i] = other;
    }
    fwrite(bytes_of, bytes, 1, stream);
}

/* `cut`: truncate, so that numbers in [0, 1) stay below 1. */
static void write_numbers(const double *values, size_t count, bool single, bool cut, FILE *stream) {
    for (size_t i = 0; i < count && !single; ++i)
        write_little(sizeof values[i], &values[i], stream);
    for (size_t i = 0; i < count && single; ++i) {
        float value = (float)values[i];
        if (cut && (double)value > values[i])
            value = nextafterf(value, 0.0f);
        write_little(sizeof value, &value, stream);
    }
}

/* Each point's coordinates, `padding` zeros, and its weight, if any. */
static void write_binary_rows(const aur_points_view *points, size_t padding, bool single, FILE *stream) {
    static const double zeros[3] = {0.0};
    const bool cut = points->domain == AUR_DOMAIN_SQUARE || points->domain == AUR_DOMAIN_CUBE;
    for (size_t i = 0; i < points->count; ++i) {
        write_numbers(aur_point_at(points, i), points->dimension, single, cut, stream);
        write_numbers(zeros, padding, single, false, stream);
        if (points->weights != NULL)
            write_numbers(points->weights + i, 1, single, false, stream);
    }
}

/* NumPy's format, version 1.0, whose header is a Python literal and may end in a comment: an array of float64
 * (or float32) with one row per point; the last column is the weight, if any. */
static void write_npy(const aur_points_view *points, bool single, FILE *stream) {
    char header[118];
    const size_t columns = points->dimension + (points->weights != NULL);
    /* Hidden samples of a GGX lobe are below the hemisphere. */
    const bool below = points->domain == AUR_DOMAIN_HEMISPHERE && !aur_points_are_above(points);
    const aur_domain domain = below ? AUR_DOMAIN_SPHERE : points->domain;
    const int length = snprintf(
        header, sizeof header,
        "{'descr': '<f%c', 'fortran_order': False, 'shape': (%zu, %zu), } # domain: %s%s", single ? '4' : '8',
        points->count, columns, aur_domain_name(domain), points->weights != NULL ? "; weights" : "");
    memset(header + length, ' ', sizeof header - (size_t)length);
    header[sizeof header - 1] = '\n';
    fwrite("\x93NUMPY\x01\x00", 1, 8, stream);
    fputc((int)(sizeof header), stream);
    fputc(0, stream);
    fwrite(header, 1, sizeof header, stream);
    write_binary_rows(points, 0, single, stream);
}

/* A comment is one line whatever the text holds. */
static void write_ply_comment(const char *name, const char *text, FILE *stream) {
    fprintf(stream, "comment %s ", name);
    for (const char *c = text; *c != '\0'; ++c)
        fputc((unsigned char)*c < 0x20 ? ' ' : *c, stream);
    fputc('\n', stream);
}

/* Binary little-endian vertices x,y,z (0 where there is no such coordinate), with a property `quality` for
 * the weight, which mesh viewers show as a scalar. */
static aur_result write_ply(const aur_points_view *points, const aur_points_origin *origin, bool single,
                            FILE *stream, aur_error *error) {
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
    static const char *const names[] = {"x", "y", "z", "quality"};
    for (size_t i = 0; i < (points->weights != NULL ? 4 : 3); ++i)
        fprintf(stream, "property %s %s\n", single ? "float" : "double", names[i]);
    fputs("end_header\n", stream);
    write_binary_rows(points, 3 - points->dimension, single, stream);
    return AUR_OK;
}

static aur_result check_options(aur_points_format format, const aur_points_write_options *options,
                                aur_error *error) {
    const char *const name = aur_points_format_name(format);
    if (options->digits > MOST_DIGITS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%u digits: must be at most %d", options->digits,
                        MOST_DIGITS);
    if (format != AUR_POINTS_CSV && (options->digits != 0 || options->no_header))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "%s: is for csv, not for %s",
                        options->no_header ? "no header" : "a number of digits", name);
    if (options->single && format != AUR_POINTS_NPY && format != AUR_POINTS_PLY)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "32-bit floats: are for npy and ply, not for %s", name);
    return AUR_OK;
}

aur_result aur_points_write(const char *path, aur_points_format format, const aur_points_view *given,
                            const aur_points_write_options *given_options, aur_error *error) {
    if (aur_points_format_name(format) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown format %d", (int)format);
    aur_points_write_options options = {.size = sizeof options};
    aur_points_write_options_init(&options, NULL);
    aur_points_origin copy = {.size = sizeof copy};
    aur_points_origin_init(&copy, NULL);
    aur_file_writer writer;
    aur_points_view view;
    const aur_points_view *const points = &view;
    aur_result result = aur_points_view_read(given, &view, error);
    if (result == AUR_OK)
        result = aur_options_read(given_options, sizeof options, &options, "aur_points_write_options", error);
    if (result == AUR_OK)
        result = check_options(format, &options, error);
    if (result == AUR_OK)
        result = aur_options_read(options.origin, sizeof copy, &copy, "aur_points_origin", error);
    if (result == AUR_OK)
        result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    const aur_points_origin *const given_origin = options.origin != NULL ? &copy : NULL;
    if (format == AUR_POINTS_CSV)
        write_csv(points, &options, writer.stream);
    else if (format == AUR_POINTS_JSON)
        write_json(points, given_origin, writer.stream);
    else if (format == AUR_POINTS_NPY)
        write_npy(points, options.single, writer.stream);
    else
        result = write_ply(points, given_origin, options.single, writer.stream, error);
    if (result != AUR_OK) {
        aur_file_abandon(&writer);
        return result;
    }
    return aur_file_commit(&writer, error);
}

aur_result aur_points_origin_init(aur_points_origin *origin, aur_error *error) {
    static const aur_points_origin defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, origin, "aur_points_origin", error);
}

aur_result aur_points_write_options_init(aur_points_write_options *options, aur_error *error) {
    static const aur_points_write_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_points_write_options", error);
}
