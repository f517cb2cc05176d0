/* Results of sensors as files. */
#include <aureole/irradiance.h>
#include <aureole/pointset.h>
#include <aureole/text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/options.h"
#include "image/tone.h"

enum { MOST_COLUMNS = 64, NAME_CAPACITY = 48 };

typedef enum content { POSITION, NORMAL, VALUE, ERROR, HALF_WIDTH, DIRECTIONS } content;

typedef struct column {
    char name[NAME_CAPACITY];
    content content;
    size_t part, channel; /* of a value; the channel is the axis of a position or normal */
} column;

typedef struct columns {
    size_t count;
    column items[MOST_COLUMNS];
} columns;

static void add(columns *all, content what, size_t part, size_t channel, const char *name,
                const char *ending) {
    static const char *const parts[] = {"", "direct_", "sky_", "reflected_"};
    column *const new = &all->items[all->count++];
    *new = (column){.content = what, .part = part, .channel = channel};
    aur_format(new->name, sizeof new->name, "%s%s%s", parts[part], name, ending);
}

static void choose(const aur_irradiance_columns *wanted, columns *all) {
    static const char *const axes[] = {"x", "y", "z"}, *const normals[] = {"nx", "ny", "nz"};
    const char *const channels[] = {"r", "g", "b", wanted->unit != NULL ? wanted->unit : "luminance"};
    const size_t first = wanted->luminance ? 3 : 0, end = wanted->luminance ? 4 : 3;
    all->count = 0;
    for (size_t d = 0; d < 3; ++d)
        add(all, POSITION, 0, d, axes[d], "");
    for (size_t d = 0; d < 3 && wanted->normals; ++d)
        add(all, NORMAL, 0, d, normals[d], "");
    for (size_t part = 0; part < (wanted->parts ? AUR_IRRADIANCE_PARTS : 1); ++part) {
        for (size_t c = first; c < end; ++c)
            add(all, VALUE, part, c, channels[c], "");
        for (size_t c = first; c < end && !wanted->no_errors; ++c)
            add(all, ERROR, part, c, channels[c], "_error");
        for (size_t c = first; c < end && wanted->intervals && part == 0; ++c)
            add(all, HALF_WIDTH, part, c, channels[c], "_half_width");
    }
    if (wanted->directions)
        add(all, DIRECTIONS, 0, 0, "directions", "");
}

static double cell(const column *wanted, const aur_sensors_view *sensors, size_t i,
                   const aur_irradiance *result) {
    switch (wanted->content) {
    case POSITION:
        return sensors->positions[3 * i + wanted->channel];
    case NORMAL:
        return sensors->normals[3 * i + wanted->channel];
    case VALUE:
        return result->value[wanted->part][wanted->channel];
    case ERROR:
        return result->error[wanted->part][wanted->channel];
    case HALF_WIDTH:
        return result->half_width[wanted->channel];
    case DIRECTIONS:
        break;
    }
    return (double)result->directions;
}

/* What is to be written. */
typedef struct output {
    columns columns;
    bool luminance; /* colours show it */
    const aur_sensors_view *sensors;
    const aur_irradiance *results;
} output;

static double value_of(const output *o, size_t i, size_t k) {
    return cell(&o->columns.items[k], o->sensors, i, &o->results[i]);
}

static void write_csv(const output *o, FILE *stream) {
    const columns *const all = &o->columns;
    for (size_t k = 0; k < all->count; ++k)
        fprintf(stream, "%s%s", k > 0 ? "," : "", all->items[k].name);
    fputc('\n', stream);
    for (size_t i = 0; i < o->sensors->count; ++i)
        for (size_t k = 0; k < all->count; ++k) {
            const content what = all->items[k].content;
            aur_print(stream, what == ERROR || what == HALF_WIDTH ? "%.6g%c" : "%.17g%c", value_of(o, i, k),
                      k + 1 < all->count ? ',' : '\n');
        }
}

static void write_json(const output *o, FILE *stream) {
    aur_json json = {.stream = stream};
    aur_json_open(&json, '[', true);
    for (size_t i = 0; i < o->sensors->count; ++i) {
        aur_json_open(&json, '{', false);
        for (size_t k = 0; k < o->columns.count; ++k) {
            aur_json_name(&json, o->columns.items[k].name);
            aur_json_number(&json, value_of(o, i, k));
        }
        aur_json_close(&json, '}');
    }
    aur_json_close(&json, ']');
}

/* The sensor's colour, with the largest of all channels as 1. */
static void color_of(const output *o, size_t i, double largest, unsigned char color[3]) {
    const double *const total = o->results[i].value[AUR_IRRADIANCE_TOTAL];
    for (size_t c = 0; c < 3; ++c)
        color[c] = (unsigned char)(255.0 * aur_srgb_encode(total[o->luminance ? 3 : c] / largest) + 0.5);
}

static double largest_value(const output *o) {
    double largest = 0.0;
    for (size_t i = 0; i < o->sensors->count; ++i)
        for (size_t c = o->luminance ? 3 : 0; c < (o->luminance ? 4 : 3); ++c)
            largest = fmax(largest, o->results[i].value[AUR_IRRADIANCE_TOTAL][c]);
    return largest > 0.0 ? largest : 1.0;
}

/* Each sensor is a vertex, or three, the corners of its face. */
static void write_ply(const output *o, FILE *stream) {
    const aur_sensors_view *const sensors = o->sensors;
    const size_t copies = sensors->corners != NULL ? 3 : 1;
    const size_t faces = sensors->corners != NULL ? sensors->count : sensors->triangle_count;
    fprintf(stream, "ply\nformat %s 1.0\nelement vertex %zu\n",
            __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "binary_little_endian" : "binary_big_endian",
            copies * sensors->count);
    for (size_t k = 0; k < o->columns.count; ++k)
        fprintf(stream, "property double %s\n", o->columns.items[k].name);
    fputs("property uchar red\nproperty uchar green\nproperty uchar blue\n", stream);
    if (faces > 0)
        fprintf(stream, "element face %zu\nproperty list uchar uint vertex_indices\n", faces);
    fputs("end_header\n", stream);
    const double largest = largest_value(o);
    for (size_t i = 0; i < copies * sensors->count; ++i) {
        unsigned char color[3];
        for (size_t k = 0; k < o->columns.count; ++k) {
            const bool at_corner = copies == 3 && o->columns.items[k].content == POSITION;
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

/* As points of a cube, which NPY knows no other names for. */
static aur_result write_npy(const output *o, const char *path, aur_error *error) {
    const size_t count = o->sensors->count, width = o->columns.count;
    double *const values = malloc(count * width * sizeof *values);
    if (values == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count * width; ++i)
        values[i] = value_of(o, i / width, i % width);
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_CUBE, count, width, values);
    const aur_result result = aur_points_write(path, AUR_POINTS_NPY, &view, NULL, error);
    free(values);
    return result;
}

aur_result aur_irradiance_write(const char *path, const char *format, const aur_irradiance_columns *wanted,
                                const aur_sensors_view *sensors, size_t result_size,
                                const aur_irradiance *results, aur_error *error) {
    static const struct {
        const char *name;
        void (*write)(const output *o, FILE *stream);
    } formats[] = {{"csv", write_csv}, {"json", write_json}, {"ply", write_ply}};
    aur_irradiance_columns own = {.size = sizeof own};
    const aur_result result =
        aur_options_read(wanted, sizeof own, sizeof own, &own, "aur_irradiance_columns", error);
    if (result != AUR_OK)
        return result;
    if (result_size != sizeof *results)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                        sizeof *results, result_size);
    output o = {.luminance = own.luminance, .sensors = sensors, .results = results};
    choose(&own, &o.columns);
    if (strcmp(format, "npy") == 0)
        return write_npy(&o, path, error);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i) {
        if (strcmp(format, formats[i].name) != 0)
            continue;
        aur_file_writer writer;
        const aur_result opened = aur_file_open(path, &writer, error);
        if (opened != AUR_OK)
            return opened;
        formats[i].write(&o, writer.stream);
        return aur_file_commit(&writer, error);
    }
    return aur_fail(error, AUR_ERROR_NAME, "no format '%s': csv, json, npy and ply are known", format);
}
