/* Stanford PLY: ascii and both binary forms; polygons become fans; properties that a mesh has no use for are
 * left out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "scene/shape.h"
#include "scene/shapes/text_scanner.h"

#define LARGEST_FILE ((size_t)1 << 35)

enum { MOST_ELEMENTS = 32, MOST_PROPERTIES = 64 };

typedef enum ply_type {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE
} ply_type;

static const size_t type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

typedef enum ply_role {
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_NX,
    PLY_NY,
    PLY_NZ,
    PLY_U,
    PLY_V,
    PLY_INDICES,
    PLY_LEFT_OUT,
    PLY_ROLE_COUNT
} ply_role;

typedef struct ply_property {
    bool list;
    ply_type count_type, type;
    ply_role role;
} ply_property;

typedef struct ply_element {
    char name[32];
    size_t count, property_count;
    ply_property properties[MOST_PROPERTIES];
} ply_element;

typedef enum ply_format { PLY_ASCII, PLY_LITTLE, PLY_BIG } ply_format;

typedef struct ply {
    aur_scanner scanner; /* ascii: at the next value; binary: `at` is the next byte */
    const char *file;
    aur_error *error;
    ply_format format;
    size_t element_count;
    ply_element elements[MOST_ELEMENTS];
    bool has[PLY_ROLE_COUNT];
    size_t index_count, index_capacity;
    uint32_t *indices;
} ply;

static aur_location here(const ply *self) {
    return (aur_location){self->file, self->format == PLY_ASCII ? self->scanner.line : 0, 0};
}

static aur_result fail_memory(const ply *self) {
    return aur_fail_memory_at(self->error, here(self));
}

/* --- the header */

static bool word_is(const char *word, size_t length, const char *text) {
    return strlen(text) == length && memcmp(word, text, length) == 0;
}

static bool find_type(const char *word, size_t length, ply_type *type) {
    static const struct {
        const char *name;
        ply_type type;
    } rows[] = {
        {"char", PLY_INT8},   {"int8", PLY_INT8},     {"uchar", PLY_UINT8},   {"uint8", PLY_UINT8},
        {"short", PLY_INT16}, {"int16", PLY_INT16},   {"ushort", PLY_UINT16}, {"uint16", PLY_UINT16},
        {"int", PLY_INT32},   {"int32", PLY_INT32},   {"uint", PLY_UINT32},   {"uint32", PLY_UINT32},
        {"float", PLY_FLOAT}, {"float32", PLY_FLOAT}, {"double", PLY_DOUBLE}, {"float64", PLY_DOUBLE}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (word_is(word, length, rows[i].name)) {
            *type = rows[i].type;
            return true;
        }
    }
    return false;
}

static ply_role find_role(const char *word, size_t length) {
    static const struct {
        const char *name;
        ply_role role;
    } rows[] = {{"x", PLY_X},
                {"y", PLY_Y},
                {"z", PLY_Z},
                {"nx", PLY_NX},
                {"ny", PLY_NY},
                {"nz", PLY_NZ},
                {"u", PLY_U},
                {"v", PLY_V},
                {"s", PLY_U},
                {"t", PLY_V},
                {"texture_u", PLY_U},
                {"texture_v", PLY_V},
                {"vertex_indices", PLY_INDICES},
                {"vertex_index", PLY_INDICES}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        if (word_is(word, length, rows[i].name))
            return rows[i].role;
    return PLY_LEFT_OUT;
}

static aur_result fail_header(const ply *self, const char *what) {
    return aur_fail_at(self->error, (aur_location){self->file, self->scanner.line, 0}, AUR_ERROR_FORMAT,
                       "PLY header: %s", what);
}

static aur_result read_format(ply *self) {
    const char *word;
    size_t length = aur_scan_word(&self->scanner, &word);
    if (word_is(word, length, "ascii"))
        self->format = PLY_ASCII;
    else if (word_is(word, length, "binary_little_endian"))
        self->format = PLY_LITTLE;
    else if (word_is(word, length, "binary_big_endian"))
        self->format = PLY_BIG;
    else
        return fail_header(self, "the format must be ascii, binary_little_endian or binary_big_endian");
    length = aur_scan_word(&self->scanner, &word);
    return word_is(word, length, "1.0") ? AUR_OK : fail_header(self, "the version must be 1.0");
}

static aur_result read_element(ply *self) {
    if (self->element_count == MOST_ELEMENTS)
        return fail_header(self, "too many elements");
    ply_element *const element = &self->elements[self->element_count];
    const char *word;
    const size_t length = aur_scan_word(&self->scanner, &word);
    int64_t count;
    if (length == 0 || length >= sizeof element->name || !aur_scan_integer(&self->scanner, &count) ||
        count < 0 || !aur_scan_line_done(&self->scanner))
        return fail_header(self, "an element needs a name and a count");
    memcpy(element->name, word, length);
    element->count = (size_t)count;
    ++self->element_count;
    return AUR_OK;
}

static aur_result read_property(ply *self) {
    if (self->element_count == 0)
        return fail_header(self, "a property before any element");
    ply_element *const element = &self->elements[self->element_count - 1];
    if (element->property_count == MOST_PROPERTIES)
        return fail_header(self, "too many properties");
    ply_property *const property = &element->properties[element->property_count++];
    const char *word;
    size_t length = aur_scan_word(&self->scanner, &word);
    if (word_is(word, length, "list")) {
        property->list = true;
        length = aur_scan_word(&self->scanner, &word);
        if (!find_type(word, length, &property->count_type) || property->count_type >= PLY_FLOAT)
            return fail_header(self, "the count of a list needs a whole type such as uchar");
        length = aur_scan_word(&self->scanner, &word);
    }
    if (!find_type(word, length, &property->type))
        return fail_header(self, "a property needs a type such as float, int or uchar");
    length = aur_scan_word(&self->scanner, &word);
    if (length == 0)
        return fail_header(self, "a property needs a name");
    const bool vertex = strcmp(element->name, "vertex") == 0, face = strcmp(element->name, "face") == 0;
    const ply_role role = find_role(word, length);
    property->role = PLY_LEFT_OUT;
    if ((vertex && !property->list && role < PLY_INDICES) ||
        (face && property->list && role == PLY_INDICES && property->type < PLY_FLOAT)) {
        property->role = role;
        self->has[role] = true;
    }
    return AUR_OK;
}

static aur_result read_header(ply *self) {
    const char *word;
    size_t length = aur_scan_word(&self->scanner, &word);
    if (!word_is(word, length, "ply"))
        return fail_header(self, "the file must begin with 'ply'");
    bool has_format = false;
    for (;;) {
        aur_scan_next_line(&self->scanner);
        if (self->scanner.at >= self->scanner.end)
            return fail_header(self, "'end_header' is missing");
        length = aur_scan_word(&self->scanner, &word);
        aur_result result = AUR_OK;
        if (word_is(word, length, "end_header"))
            break;
        if (word_is(word, length, "format"))
            result = read_format(self), has_format = true;
        else if (word_is(word, length, "element"))
            result = read_element(self);
        else if (word_is(word, length, "property"))
            result = read_property(self);
        else if (length > 0 && !word_is(word, length, "comment") && !word_is(word, length, "obj_info"))
            result =
                fail_header(self, "a line must begin with format, element, property, comment or end_header");
        if (result != AUR_OK)
            return result;
    }
    if (!has_format)
        return fail_header(self, "the format is missing");
    if (!self->has[PLY_X] || !self->has[PLY_Y] || !self->has[PLY_Z])
        return fail_header(self, "element vertex needs the properties x, y and z");
    if (!self->has[PLY_INDICES])
        return fail_header(self, "element face needs the list vertex_indices");
    aur_scan_next_line(&self->scanner);
    return AUR_OK;
}

/* --- values */

static void skip_ascii_space(ply *self) {
    while (self->scanner.at < self->scanner.end) {
        aur_scan_blanks(&self->scanner);
        if (*self->scanner.at != '\n')
            return;
        ++self->scanner.at;
        ++self->scanner.line;
    }
}

static double read_binary(const char *at, ply_type type, bool big) {
    unsigned char bytes[8] = {0};
    const size_t size = type_sizes[type];
    for (size_t i = 0; i < size; ++i)
        bytes[i] = (unsigned char)at[big ? size - 1 - i : i];
    uint64_t bits = 0;
    for (size_t i = 0; i < 8; ++i)
        bits |= (uint64_t)bytes[i] << (8 * i);
    float single;
    double wide;
    const uint32_t half = (uint32_t)bits;
    switch (type) {
    case PLY_INT8:
        return (int8_t)bits;
    case PLY_UINT8:
    case PLY_UINT16:
    case PLY_UINT32:
        return (double)bits;
    case PLY_INT16:
        return (int16_t)bits;
    case PLY_INT32:
        return (int32_t)bits;
    case PLY_FLOAT:
        memcpy(&single, &half, sizeof single);
        return (double)single;
    case PLY_DOUBLE:
        break;
    }
    memcpy(&wide, &bits, sizeof wide);
    return wide;
}

static aur_result read_value(ply *self, ply_type type, const ply_element *element, size_t index,
                             double *value) {
    if (self->format == PLY_ASCII) {
        skip_ascii_space(self);
        if (aur_scan_double(&self->scanner, value))
            return AUR_OK;
    } else if ((size_t)(self->scanner.end - self->scanner.at) >= type_sizes[type]) {
        *value = read_binary(self->scanner.at, type, self->format == PLY_BIG);
        self->scanner.at += type_sizes[type];
        return AUR_OK;
    }
    if (self->scanner.at >= self->scanner.end || self->format != PLY_ASCII)
        return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "the file ends in %s %zu of %zu",
                           element->name, index, element->count);
    return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "%s %zu: a number is expected",
                       element->name, index);
}

/* The number of values in a list. */
static aur_result read_count(ply *self, const ply_property *property, const ply_element *element,
                             size_t index, size_t *count) {
    double value;
    const aur_result result = read_value(self, property->count_type, element, index, &value);
    if (result != AUR_OK)
        return result;
    if (!(value >= 0.0) || value > 1e6 || value != floor(value))
        return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "%s %zu: a list cannot have %g values",
                           element->name, index, value);
    *count = (size_t)value;
    return AUR_OK;
}

static aur_result skip_property(ply *self, const ply_property *property, const ply_element *element,
                                size_t index) {
    size_t count = 1;
    aur_result result = AUR_OK;
    if (property->list)
        result = read_count(self, property, element, index, &count);
    double value;
    for (size_t i = 0; result == AUR_OK && i < count; ++i)
        result = read_value(self, property->type, element, index, &value);
    return result;
}

static aur_result read_vertices(ply *self, const ply_element *element, aur_mesh *mesh) {
    for (size_t i = 0; i < element->count; ++i) {
        for (size_t p = 0; p < element->property_count; ++p) {
            const ply_property *const property = &element->properties[p];
            double value = 0.0;
            const aur_result result = property->list ? skip_property(self, property, element, i)
                                                     : read_value(self, property->type, element, i, &value);
            if (result != AUR_OK)
                return result;
            if (property->role == PLY_LEFT_OUT)
                continue;
            if (!(fabs(value) <= 1e30))
                return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                                   "vertex %zu is not finite, or beyond 1e30", i);
            if (property->role <= PLY_Z)
                mesh->positions[3 * i + property->role] = (float)value;
            else if (property->role <= PLY_NZ && mesh->normals != NULL)
                mesh->normals[3 * i + (property->role - PLY_NX)] = (float)value;
            else if (property->role >= PLY_U && mesh->uvs != NULL)
                mesh->uvs[2 * i + (property->role - PLY_U)] = (float)value;
        }
    }
    return AUR_OK;
}

static aur_result add_triangle(ply *self, const uint32_t index[3]) {
    if (self->index_count + 3 > self->index_capacity) {
        const size_t capacity = self->index_capacity == 0 ? 3072 : 2 * self->index_capacity;
        uint32_t *const larger = realloc(self->indices, capacity * sizeof *larger);
        if (larger == NULL)
            return fail_memory(self);
        self->indices = larger;
        self->index_capacity = capacity;
    }
    memcpy(&self->indices[self->index_count], index, 3 * sizeof *index);
    self->index_count += 3;
    return AUR_OK;
}

static aur_result read_polygon(ply *self, const ply_property *property, const ply_element *element,
                               size_t face, size_t vertex_count) {
    size_t count;
    aur_result result = read_count(self, property, element, face, &count);
    uint32_t corner[3] = {0, 0, 0};
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        double value;
        result = read_value(self, property->type, element, face, &value);
        if (result != AUR_OK)
            return result;
        if (!(value >= 0.0) || !(value < (double)vertex_count) || value != floor(value))
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                               "face %zu: index %.10g is no vertex: there are %zu", face, value,
                               vertex_count);
        corner[i == 0 ? 0 : 2] = (uint32_t)value;
        if (i >= 2)
            result = add_triangle(self, corner);
        corner[1] = corner[2];
    }
    if (result == AUR_OK && count < 3)
        return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "face %zu has %zu corners", face,
                           count);
    return result;
}

static aur_result read_faces(ply *self, const ply_element *element, size_t vertex_count) {
    for (size_t i = 0; i < element->count; ++i) {
        for (size_t p = 0; p < element->property_count; ++p) {
            const ply_property *const property = &element->properties[p];
            const aur_result result = property->role == PLY_INDICES
                                          ? read_polygon(self, property, element, i, vertex_count)
                                          : skip_property(self, property, element, i);
            if (result != AUR_OK)
                return result;
        }
    }
    return AUR_OK;
}

/* --- the whole */

static const ply_element *find_element(const ply *self, const char *name) {
    for (size_t i = 0; i < self->element_count; ++i)
        if (strcmp(self->elements[i].name, name) == 0)
            return &self->elements[i];
    return NULL;
}

static aur_result read_body(ply *self, unsigned parts, aur_mesh *mesh) {
    const ply_element *const vertices = find_element(self, "vertex");
    /* A count that lies is found out before memory is asked for. */
    const size_t left = (size_t)(self->scanner.end - self->scanner.at);
    if (vertices->count > left)
        return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "%zu vertices cannot be in %zu bytes",
                           vertices->count, left);
    aur_result result = aur_mesh_allocate(mesh, vertices->count, 0, parts, here(self), self->error);
    bool seen = false;
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i) {
        const ply_element *const element = &self->elements[i];
        if (element->property_count == 0)
            continue; /* no bytes, however many there are said to be */
        if (element == vertices) {
            result = read_vertices(self, element, mesh);
            seen = true;
        } else if (strcmp(element->name, "face") == 0) {
            if (!seen)
                return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                                   "faces stand before the vertices");
            result = read_faces(self, element, vertices->count);
        } else {
            for (size_t k = 0; result == AUR_OK && k < element->count; ++k)
                for (size_t p = 0; result == AUR_OK && p < element->property_count; ++p)
                    result = skip_property(self, &element->properties[p], element, k);
        }
    }
    if (result != AUR_OK)
        return result;
    if (self->index_count == 0)
        return aur_fail_at(self->error, (aur_location){.file = self->file}, AUR_ERROR_FORMAT,
                           "no face in this file");
    free(mesh->indices);
    mesh->indices = self->indices;
    mesh->triangle_count = self->index_count / 3;
    self->indices = NULL;
    return AUR_OK;
}

static aur_result read_file(const char *path, bool face_normals, aur_mesh *mesh, aur_error *error) {
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, LARGEST_FILE, &data, &size, error);
    if (result != AUR_OK)
        return result;
    ply *const self = calloc(1, sizeof *self);
    if (self == NULL) {
        free(data);
        return aur_fail_memory(error);
    }
    *self = (ply){.scanner = {data, data + size, 1}, .file = path, .error = error};
    result = read_header(self);
    const unsigned normals = self->has[PLY_NX] && self->has[PLY_NY] && self->has[PLY_NZ] && !face_normals;
    const unsigned uvs = self->has[PLY_U] && self->has[PLY_V];
    if (result == AUR_OK)
        result = read_body(self, (normals ? AUR_MESH_NORMALS : 0u) | (uvs ? AUR_MESH_UVS : 0u), mesh);
    free(self->indices);
    free(self);
    free(data);
    return result;
}

typedef struct ply_keys {
    const char *filename;
    bool face_normals;
} ply_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(ply_keys, "filename", filename, NULL, "the file, beside the scene; must be given")},
    {AUR_KEY_OF_BOOLEAN(ply_keys, "face_normals", face_normals, "false",
                        "flat triangles, whatever normals the file has")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    ply_keys p = {.filename = NULL};
    char *path = NULL;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_filename(input, p.filename, &path, error);
    if (result == AUR_OK)
        result = read_file(path, p.face_normals, &shape->mesh, error);
    free(path);
    if (result != AUR_OK)
        return result;
    const bool smooth = !p.face_normals && shape->mesh.normals == NULL;
    aur_shape_place(input, shape);
    return smooth ? aur_mesh_smooth(&shape->mesh, input->parameters->location, error) : AUR_OK;
}

const aur_shape_descriptor aur_shape_ply = {.row = {.name = "ply",
                                                    .summary = "a Stanford PLY file, ascii or binary",
                                                    .source = "",
                                                    AUR_ROW_KEYS(keys)},
                                            .create = create};
