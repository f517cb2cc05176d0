/* OFF of Geomview: vertices with colours, normals and texture coordinates, and polygons. Face colours are
 * ignored. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/text.h"
#include "render/scene/importers/meshes/mesh_reader.h"

typedef struct off {
    aur_mesh_reader *reader;
    bool normals, colors, textures, weights;
    size_t normal_capacity, color_capacity, uv_capacity, color_count;
    float *color_values;
    float largest; /* largest colour value: above 1, colours are bytes */
} off;

/* Skips line ends and comments. */
static void skip_to_word(aur_scanner *scanner) {
    while (scanner->at < scanner->end && aur_scan_line_done(scanner))
        aur_scan_next_line(scanner);
}

static aur_result read_count(off *self, const char *what, size_t *count) {
    aur_scanner *const scanner = &self->reader->scanner;
    int64_t number;
    skip_to_word(scanner);
    if (!aur_scan_integer(scanner, &number) || number < 0)
        return aur_mesh_reader_fail(self->reader, "expected %s", what);
    *count = (size_t)number;
    return AUR_OK;
}

/* "[ST][C][N][4]OFF". It may share a line with the counts, or be missing. */
static aur_result read_header(off *self) {
    aur_scanner *const scanner = &self->reader->scanner;
    skip_to_word(scanner);
    const char *c = scanner->at;
    self->textures = strncmp(c, "ST", 2) == 0;
    c += self->textures ? 2 : 0;
    self->colors = *c == 'C';
    c += self->colors;
    self->normals = *c == 'N';
    c += self->normals;
    self->weights = *c == '4';
    c += self->weights;
    if (*c == 'n' && strncmp(c, "nOFF", 4) == 0)
        return aur_mesh_reader_fail(self->reader, "OFF in more than three dimensions (nOFF) is not read");
    if (strncmp(c, "OFF", 3) == 0)
        scanner->at = c + 3;
    else if (!aur_is_digit(*scanner->at))
        return aur_mesh_reader_fail(self->reader, "the file must begin with OFF");
    else
        self->weights = false;
    aur_scan_blanks(scanner);
    if (strncmp(scanner->at, "BINARY", 6) == 0)
        return aur_mesh_reader_fail(self->reader, "binary OFF is not read");
    return AUR_OK;
}

static aur_result read_floats(off *self, size_t width, size_t *capacity, float **values) {
    const size_t first = width * (self->reader->data->vertex_count - 1);
    if (!aur_array_reserve(values, capacity, self->reader->data->vertex_count, width * sizeof **values))
        return aur_fail_memory(self->reader->error);
    for (size_t i = 0; i < width; ++i) {
        double value = 0.0;
        if (!aur_scan_double(&self->reader->scanner, &value) || !aur_mesh_is_usable(value))
            return aur_mesh_reader_fail(self->reader, "vertex %zu: a number is expected",
                                        self->reader->data->vertex_count - 1);
        (*values)[first + i] = (float)value;
    }
    return AUR_OK;
}

static aur_result read_vertex(off *self) {
    aur_mesh_reader *const reader = self->reader;
    aur_mesh_data *const data = reader->data;
    double point[4] = {0.0, 0.0, 0.0, 1.0};
    skip_to_word(&reader->scanner);
    for (size_t d = 0; d < (self->weights ? 4 : 3); ++d)
        if (!aur_scan_double(&reader->scanner, &point[d]))
            return aur_mesh_reader_fail(reader, "vertex %zu: a number is expected", data->vertex_count);
    for (size_t d = 0; d < 3 && self->weights; ++d)
        point[d] /= point[3];
    aur_result result = aur_mesh_reader_add_vertex(reader, point);
    if (result == AUR_OK && self->normals)
        result = read_floats(self, 3, &self->normal_capacity, &data->normals);
    if (result == AUR_OK && self->colors)
        result = read_floats(self, 3, &self->color_capacity, &self->color_values);
    for (size_t i = 0; i < 3 && result == AUR_OK && self->colors; ++i)
        self->largest = fmaxf(self->largest, self->color_values[3 * (data->vertex_count - 1) + i]);
    if (result == AUR_OK && self->textures) {
        /* The last two numbers of the line, as colours may include alpha. */
        const char *const start = reader->scanner.at;
        double ignored;
        size_t left = 0;
        while (!aur_scan_line_done(&reader->scanner) && aur_scan_double(&reader->scanner, &ignored))
            ++left;
        reader->scanner.at = start;
        while (left-- > 2)
            (void)aur_scan_double(&reader->scanner, &ignored);
        result = read_floats(self, 2, &self->uv_capacity, &data->uvs);
    }
    aur_scan_next_line(&reader->scanner);
    return result;
}

static aur_result read_face(off *self, size_t face) {
    aur_mesh_reader *const reader = self->reader;
    size_t count = 0;
    aur_result result = read_count(self, "the number of a face's corners", &count);
    const size_t line = reader->scanner.line;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        size_t vertex = 0;
        result = read_count(self, "a vertex of the face", &vertex);
        if (result == AUR_OK && vertex >= reader->data->vertex_count)
            result = aur_mesh_reader_fail(reader, "face %zu: index %zu is not a vertex: there are %zu", face,
                                          vertex, reader->data->vertex_count);
        if (result == AUR_OK)
            result = aur_mesh_reader_add_corner(reader, (uint32_t)vertex);
    }
    if (result == AUR_OK)
        result = aur_mesh_reader_end_face(reader, line);
    aur_scan_next_line(&reader->scanner); /* skip the colour */
    return result;
}

static aur_result put_colors(off *self) {
    aur_mesh_data *const data = self->reader->data;
    if (self->color_values == NULL)
        return AUR_OK;
    data->attributes = calloc(1, sizeof *data->attributes);
    if (data->attributes == NULL)
        return aur_fail_memory(self->reader->error);
    data->attribute_count = 1;
    *data->attributes =
        (aur_mesh_attribute){.name = "vertex_color", .width = 3, .values = self->color_values};
    for (size_t i = 0; i < 3 * data->vertex_count && self->largest > 1.0f; ++i)
        self->color_values[i] /= 255.0f;
    self->color_values = NULL;
    return AUR_OK;
}

aur_result aur_off_read(aur_mesh_reader *reader) {
    off self = {.reader = reader};
    size_t vertices = 0, faces = 0;
    aur_result result = read_header(&self);
    if (result == AUR_OK)
        result = read_count(&self, "the number of vertices", &vertices);
    if (result == AUR_OK)
        result = read_count(&self, "the number of faces", &faces);
    aur_scan_next_line(&reader->scanner); /* skip the number of edges */
    for (size_t i = 0; i < vertices && result == AUR_OK; ++i)
        result = read_vertex(&self);
    for (size_t i = 0; i < faces && result == AUR_OK; ++i)
        result = read_face(&self, i);
    if (result == AUR_OK)
        result = put_colors(&self);
    free(self.color_values);
    if (reader->source->without_normals) {
        free(reader->data->normals);
        reader->data->normals = NULL;
    }
    return result;
}
