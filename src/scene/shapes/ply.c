/* Stanford PLY: ascii and both binary forms; polygons become fans; properties that a mesh has no use for are
 * left out. */
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "scene/shapes/mesh_file.h"

enum { MOST_ELEMENTS = 32, MOST_PROPERTIES = 64 };

typedef enum ply_type {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE,
    PLY_TYPE_COUNT
} ply_type;

static const size_t type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

/* Each type has two names. */
static const char *const type_names[] = {"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                         "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                         "float",  "float32", "double", "float64"};

/* What a property is for: those of vertices come first, then those of faces. */
typedef enum ply_role {
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_NX,
    PLY_NY,
    PLY_NZ,
    PLY_U,
    PLY_V,
    PLY_RED,
    PLY_GREEN,
    PLY_BLUE,
    PLY_FACE_RED,
    PLY_FACE_GREEN,
    PLY_FACE_BLUE,
    PLY_INDICES,
    PLY_LEFT_OUT,
    PLY_ROLE_COUNT
} ply_role;

static const struct {
    const char *name;
    ply_role role;
} roles[] = {{"x", PLY_X},
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
             {"r", PLY_RED},
             {"g", PLY_GREEN},
             {"b", PLY_BLUE},
             {"red", PLY_RED},
             {"green", PLY_GREEN},
             {"blue", PLY_BLUE},
             {"r", PLY_FACE_RED},
             {"g", PLY_FACE_GREEN},
             {"b", PLY_FACE_BLUE},
             {"red", PLY_FACE_RED},
             {"green", PLY_FACE_GREEN},
             {"blue", PLY_FACE_BLUE},
             {"vertex_indices", PLY_INDICES},
             {"vertex_index", PLY_INDICES}};

typedef struct ply_property {
    bool list;
    ply_type count_type, type;
    ply_role role;
    float *values; /* the value of vertex i goes to values[stride * i]; NULL: it is left out */
    size_t stride;
} ply_property;

typedef struct ply_element {
    char name[32];
    size_t count, property_count;
    ply_property properties[MOST_PROPERTIES];
} ply_element;

typedef enum ply_format { PLY_ASCII, PLY_LITTLE, PLY_BIG } ply_format;

typedef struct ply {
    aur_mesh_file *file; /* ascii: at the next value; binary: `at` is the next byte */
    ply_format format;
    size_t element_count;
    ply_element elements[MOST_ELEMENTS];
    const ply_element *vertices; /* the first element of that name, or NULL */
    bool has[PLY_ROLE_COUNT];
    size_t index_count, index_capacity;
    uint32_t *indices;
    /* Where faces have colours: those, 3 a face, and the face of each triangle. */
    float *colors;
    size_t face_count, face_capacity;
    uint32_t *faces;
} ply;

/* --- the header */

static bool find_type(aur_word word, ply_type *type) {
    *type = (ply_type)(aur_word_find(word, 2 * PLY_TYPE_COUNT, type_names) / 2);
    return *type < PLY_TYPE_COUNT;
}

static aur_result fail_header(const ply *self, const char *what) {
    return aur_mesh_file_fail(self->file, "PLY header: %s", what);
}

static aur_result read_format(ply *self) {
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const size_t format = aur_word_find(aur_scan_word(&self->file->scanner), 3, formats);
    if (format == 3)
        return fail_header(self, "the format must be ascii, binary_little_endian or binary_big_endian");
    self->format = (ply_format)format;
    return aur_word_is(aur_scan_word(&self->file->scanner), "1.0")
               ? AUR_OK
               : fail_header(self, "the version must be 1.0");
}

static aur_result read_element(ply *self) {
    if (self->element_count == MOST_ELEMENTS)
        return fail_header(self, "too many elements");
    ply_element *const element = &self->elements[self->element_count++];
    aur_scanner *const scanner = &self->file->scanner;
    const aur_word word = aur_scan_word(scanner);
    int64_t count;
    if (word.length == 0 || word.length >= sizeof element->name || !aur_scan_integer(scanner, &count) ||
        count < 0 || !aur_scan_line_done(scanner))
        return fail_header(self, "an element needs a name and a count");
    memcpy(element->name, word.text, word.length);
    element->count = (size_t)count;
    if (self->vertices == NULL && aur_word_is(word, "vertex"))
        self->vertices = element;
    return AUR_OK;
}

static aur_result read_property(ply *self) {
    if (self->element_count == 0)
        return fail_header(self, "a property before any element");
    ply_element *const element = &self->elements[self->element_count - 1];
    if (element->property_count == MOST_PROPERTIES)
        return fail_header(self, "too many properties");
    ply_property *const property = &element->properties[element->property_count++];
    aur_scanner *const scanner = &self->file->scanner;
    aur_word word = aur_scan_word(scanner);
    property->list = aur_word_is(word, "list");
    if (property->list) {
        if (!find_type(aur_scan_word(scanner), &property->count_type) || property->count_type >= PLY_FLOAT)
            return fail_header(self, "the count of a list needs a whole type such as uchar");
        word = aur_scan_word(scanner);
    }
    if (!find_type(word, &property->type))
        return fail_header(self, "a property needs a type such as float, int or uchar");
    word = aur_scan_word(scanner);
    if (word.length == 0)
        return fail_header(self, "a property needs a name");
    property->role = PLY_LEFT_OUT;
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; ++i) {
        const bool of_face = roles[i].role >= PLY_FACE_RED;
        const bool fits =
            (roles[i].role == PLY_INDICES ? property->list && property->type < PLY_FLOAT : !property->list) &&
            (of_face ? strcmp(element->name, "face") == 0 : element == self->vertices);
        if (fits && aur_word_is(word, roles[i].name))
            property->role = roles[i].role;
    }
    self->has[property->role] = true;
    return AUR_OK;
}

static aur_result read_header(ply *self) {
    aur_scanner *const scanner = &self->file->scanner;
    if (!aur_word_is(aur_scan_word(scanner), "ply"))
        return fail_header(self, "the file must begin with 'ply'");
    bool has_format = false;
    for (bool done = false; !done;) {
        static const char *const words[] = {"end_header", "format",   "element", "property",
                                            "comment",    "obj_info", ""};
        aur_scan_next_line(scanner);
        if (scanner->at >= scanner->end)
            return fail_header(self, "'end_header' is missing");
        const size_t which = aur_word_find(aur_scan_word(scanner), sizeof words / sizeof words[0], words);
        done = which == 0;
        has_format = has_format || which == 1;
        const aur_result result = which == 1   ? read_format(self)
                                  : which == 2 ? read_element(self)
                                  : which == 3 ? read_property(self)
                                  : which < 7
                                      ? AUR_OK
                                      : fail_header(self, "a line must begin with format, element, property, "
                                                          "comment or end_header");
        if (result != AUR_OK)
            return result;
    }
    if (!has_format)
        return fail_header(self, "the format is missing");
    if (!self->has[PLY_X] || !self->has[PLY_Y] || !self->has[PLY_Z])
        return fail_header(self, "element vertex needs the properties x, y and z");
    if (!self->has[PLY_INDICES])
        return fail_header(self, "element face needs the list vertex_indices");
    aur_scan_next_line(scanner);
    return AUR_OK;
}

/* --- values */

static void skip_ascii_space(aur_scanner *scanner) {
    for (aur_scan_blanks(scanner); scanner->at < scanner->end && *scanner->at == '\n';
         aur_scan_blanks(scanner)) {
        ++scanner->at;
        ++scanner->line;
    }
}

static double read_binary(const char *at, ply_type type, bool big) {
    const size_t size = type_sizes[type];
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i)
        bits |= (uint64_t)(unsigned char)at[big ? size - 1 - i : i] << (8 * i);
    const uint32_t half = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case PLY_INT8:
        return (int8_t)bits;
    case PLY_INT16:
        return (int16_t)bits;
    case PLY_INT32:
        return (int32_t)bits;
    case PLY_FLOAT:
        memcpy(&single, &half, sizeof single);
        return (double)single;
    case PLY_DOUBLE:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default: /* the unsigned types */
        return (double)bits;
    }
}

static aur_result read_value(ply *self, ply_type type, const ply_element *element, size_t index,
                             double *value) {
    aur_scanner *const scanner = &self->file->scanner;
    if (self->format == PLY_ASCII) {
        skip_ascii_space(scanner);
        if (aur_scan_double(scanner, value))
            return AUR_OK;
    } else if ((size_t)(scanner->end - scanner->at) >= type_sizes[type]) {
        *value = read_binary(scanner->at, type, self->format == PLY_BIG);
        scanner->at += type_sizes[type];
        return AUR_OK;
    }
    if (scanner->at >= scanner->end || self->format != PLY_ASCII)
        return aur_mesh_file_fail(self->file, "the file ends in %s %zu of %zu", element->name, index,
                                  element->count);
    return aur_mesh_file_fail(self->file, "%s %zu: a number is expected", element->name, index);
}

/* A corner of a polygon; from the third on, each makes a triangle with the first and the one before. */
static aur_result add_corner(ply *self, size_t face, size_t corner, double value) {
    const size_t vertex_count = self->vertices->count;
    if (!(value >= 0.0) || !(value < (double)vertex_count) || value != floor(value))
        return aur_mesh_file_fail(self->file, "face %zu: index %.10g is no vertex: there are %zu", face,
                                  value, vertex_count);
    if (!aur_array_reserve(&self->indices, &self->index_capacity, self->index_count + 3,
                           sizeof *self->indices))
        return aur_fail_memory(self->file->error);
    uint32_t *const end = &self->indices[self->index_count];
    if (corner >= 3) {
        end[0] = end[-3];
        end[1] = end[-1];
        self->index_count += 2;
    }
    self->indices[self->index_count++] = (uint32_t)value;
    if (self->colors == NULL || corner < 2)
        return AUR_OK;
    if (!aur_array_reserve(&self->faces, &self->face_capacity, self->face_count + 1, sizeof *self->faces))
        return aur_fail_memory(self->file->error);
    self->faces[self->face_count++] = (uint32_t)face;
    return AUR_OK;
}

static aur_result take_value(ply *self, const ply_property *property, size_t index, size_t place,
                             double value) {
    if (property->role == PLY_INDICES)
        return add_corner(self, index, place, value);
    if (property->values == NULL)
        return AUR_OK;
    if (!(fabs(value) <= 1e30))
        return aur_mesh_file_fail(self->file, "%s %zu is not finite, or beyond 1e30",
                                  property->role < PLY_FACE_RED ? "vertex" : "face", index);
    const bool of_255 = property->type == PLY_UINT8 && property->role >= PLY_RED;
    property->values[property->stride * index] = (float)(of_255 ? value / 255.0 : value);
    return AUR_OK;
}

static aur_result read_values(ply *self, const ply_element *element, const ply_property *property,
                              size_t index) {
    double value = 1.0;
    aur_result result = AUR_OK;
    if (property->list) {
        result = read_value(self, property->count_type, element, index, &value);
        if (result == AUR_OK && (!(value >= 0.0) || value > 1e6 || value != floor(value)))
            return aur_mesh_file_fail(self->file, "%s %zu: a list cannot have %g values", element->name,
                                      index, value);
        if (result == AUR_OK && property->role == PLY_INDICES && value < 3.0)
            return aur_mesh_file_fail(self->file, "face %zu has %g corners", index, value);
    }
    const size_t count = (size_t)value;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        result = read_value(self, property->type, element, index, &value);
        if (result == AUR_OK)
            result = take_value(self, property, index, i, value);
    }
    return result;
}

static aur_result read_rows(ply *self, const ply_element *element) {
    /* Without properties there are no bytes, however many rows there are said to be. */
    for (size_t i = 0; element->property_count > 0 && i < element->count; ++i) {
        for (size_t p = 0; p < element->property_count; ++p) {
            const aur_result result = read_values(self, element, &element->properties[p], i);
            if (result != AUR_OK)
                return result;
        }
    }
    return AUR_OK;
}

/* --- the whole */

/* Where the properties of an element go. */
static void set_targets(const ply *self, ply_element *element, const aur_mesh *mesh) {
    const struct {
        float *values;
        ply_role first;
        size_t stride;
    } targets[] = {{mesh->positions, PLY_X, 3},
                   {mesh->normals, PLY_NX, 3},
                   {mesh->uvs, PLY_U, 2},
                   {mesh->vertex_colors, PLY_RED, 3},
                   {self->colors, PLY_FACE_RED, 3}};
    for (size_t p = 0; p < element->property_count; ++p) {
        ply_property *const property = &element->properties[p];
        property->values = NULL;
        for (size_t i = 0; i < sizeof targets / sizeof targets[0]; ++i) {
            const size_t place = (size_t)property->role - (size_t)targets[i].first;
            if (targets[i].values == NULL || place >= targets[i].stride)
                continue;
            property->values = targets[i].values + place;
            property->stride = targets[i].stride;
        }
    }
}

/* Whether three roles are all there. */
static bool has_all(const ply *self, ply_role first) {
    return self->has[first] && self->has[first + 1] && self->has[first + 2];
}

/* Room for the colours of faces, in the end those of triangles. */
static aur_result prepare_face_colors(ply *self, size_t left) {
    size_t count = 0;
    for (size_t i = 0; i < self->element_count; ++i)
        if (strcmp(self->elements[i].name, "face") == 0 && self->elements[i].count > count)
            count = self->elements[i].count;
    if (count > left)
        return aur_mesh_file_fail(self->file, "%zu faces cannot be in %zu bytes", count, left);
    self->colors = calloc(3 * count + 1, sizeof *self->colors);
    return self->colors != NULL ? AUR_OK : aur_fail_memory(self->file->error);
}

static aur_result color_triangles(const ply *self, aur_mesh *mesh) {
    mesh->face_colors = malloc((3 * mesh->triangle_count + 1) * sizeof *mesh->face_colors);
    if (mesh->face_colors == NULL)
        return aur_fail_memory(self->file->error);
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        memcpy(&mesh->face_colors[3 * i], &self->colors[3 * (size_t)self->faces[i]],
               3 * sizeof *self->colors);
    return AUR_OK;
}

static aur_result read_body(ply *self, aur_mesh *mesh) {
    aur_mesh_file *const file = self->file;
    /* A count that lies is found out before memory is asked for. */
    const size_t left = (size_t)(file->scanner.end - file->scanner.at);
    if (self->vertices->count > left)
        return aur_mesh_file_fail(file, "%zu vertices cannot be in %zu bytes", self->vertices->count, left);
    const unsigned parts = (has_all(self, PLY_NX) && !file->face_normals ? AUR_MESH_NORMALS : 0u) |
                           (self->has[PLY_U] && self->has[PLY_V] ? AUR_MESH_UVS : 0u) |
                           (has_all(self, PLY_RED) ? AUR_MESH_VERTEX_COLORS : 0u);
    aur_result result = aur_mesh_allocate(mesh, self->vertices->count, 0, parts,
                                          (aur_location){.file = file->path}, file->error);
    if (result == AUR_OK && has_all(self, PLY_FACE_RED))
        result = prepare_face_colors(self, left);
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i)
        set_targets(self, &self->elements[i], mesh);
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i)
        result = read_rows(self, &self->elements[i]);
    return result;
}

static aur_result read_file(aur_mesh_file *file, aur_mesh *mesh) {
    ply *const self = calloc(1, sizeof *self);
    if (self == NULL)
        return aur_fail_memory(file->error);
    self->file = file;
    file->scanner.line = 1;
    aur_result result = read_header(self);
    if (self->format != PLY_ASCII)
        file->scanner.line = 0;
    if (result == AUR_OK)
        result = read_body(self, mesh);
    if (result == AUR_OK)
        aur_mesh_take_indices(mesh, self->index_count, &self->indices);
    if (result == AUR_OK && self->colors != NULL)
        result = color_triangles(self, mesh);
    free(self->colors);
    free(self->faces);
    free(self->indices);
    free(self);
    return result;
}

static const aur_key keys[] = {AUR_MESH_FILE_KEYS};

const aur_shape_descriptor aur_shape_ply = {
    .row = {.name = "ply", .summary = "a Stanford PLY file, ascii or binary", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_file,
    .smooths = true};
