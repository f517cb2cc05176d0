/* Stanford PLY: ascii and both binary forms. Elements other than vertices and faces are ignored. */
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "render/scene/importers/meshes/ply.h"

static const size_t type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

static void skip_ascii_space(aur_scanner *scanner) {
    for (aur_scan_blanks(scanner); scanner->at < scanner->end && aur_is_line_end(*scanner->at);
         aur_scan_blanks(scanner))
        aur_scan_line_end(scanner);
}

static double read_binary(const char *at, aur_ply_type type, bool big) {
    char turned[8];
    const size_t size = type_sizes[type];
    if (big != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) && size > 1) {
        for (size_t i = 0; i < size; ++i)
            turned[i] = at[size - 1 - i];
        at = turned;
    }
    union {
        int8_t int8;
        uint8_t uint8;
        int16_t int16;
        uint16_t uint16;
        int32_t int32;
        uint32_t uint32;
        float single;
        double wide;
    } value;
    switch (type) {
    case AUR_PLY_INT8:
        return memcpy(&value.int8, at, 1), value.int8;
    case AUR_PLY_UINT8:
        return memcpy(&value.uint8, at, 1), value.uint8;
    case AUR_PLY_INT16:
        return memcpy(&value.int16, at, 2), value.int16;
    case AUR_PLY_UINT16:
        return memcpy(&value.uint16, at, 2), value.uint16;
    case AUR_PLY_INT32:
        return memcpy(&value.int32, at, 4), value.int32;
    case AUR_PLY_UINT32:
        return memcpy(&value.uint32, at, 4), value.uint32;
    case AUR_PLY_FLOAT:
        return memcpy(&value.single, at, 4), (double)value.single;
    default:
        return memcpy(&value.wide, at, 8), value.wide;
    }
}

/* False: the text is malformed or ends early. */
static inline bool next_binary(aur_ply *self, aur_ply_type type, double *value) {
    aur_scanner *const scanner = &self->reader->scanner;
    if (self->format == AUR_PLY_ASCII || (size_t)(scanner->end - scanner->at) < type_sizes[type])
        return false;
    *value = read_binary(scanner->at, type, self->format == AUR_PLY_BIG);
    scanner->at += type_sizes[type];
    return true;
}

static aur_result read_text(aur_ply *self, const aur_ply_element *element, size_t index, double *value) {
    aur_scanner *const scanner = &self->reader->scanner;
    if (self->format == AUR_PLY_ASCII) {
        skip_ascii_space(scanner);
        if (aur_scan_double(scanner, value))
            return AUR_OK;
    }
    if (scanner->at >= scanner->end || self->format != AUR_PLY_ASCII)
        return aur_mesh_reader_fail(self->reader, "the file ends in %s %zu of %zu", element->name, index,
                                    element->count);
    return aur_mesh_reader_fail(self->reader, "%s %zu: a number is expected", element->name, index);
}

static aur_result add_corner(aur_ply *self, size_t face, double value) {
    const size_t vertex_count = self->vertices->count;
    if (!(value >= 0.0) || !(value < (double)vertex_count) || value != (double)(uint32_t)value)
        return aur_mesh_reader_fail(self->reader, "face %zu: index %.10g is not a vertex: there are %zu",
                                    face, value, vertex_count);
    return aur_mesh_reader_add_corner(self->reader, (uint32_t)value);
}

static aur_result take_value(aur_ply *self, const aur_ply_element *element, const aur_ply_property *property,
                             size_t index, double value) {
    if (property->role == AUR_PLY_INDICES)
        return add_corner(self, index, value);
    if (property->doubles == NULL && property->values == NULL)
        return AUR_OK;
    if (!aur_mesh_is_usable(value))
        return aur_mesh_reader_fail(self->reader, "%s %zu is not finite, or beyond 1e30", element->name,
                                    index);
    if (property->doubles != NULL)
        property->doubles[property->stride * index] = value;
    else if (property->role == AUR_PLY_OTHER && property->type == AUR_PLY_UINT8)
        property->values[property->stride * index] = (float)(value / 255.0);
    else
        property->values[property->stride * index] = (float)value;
    return AUR_OK;
}

static aur_result read_values(aur_ply *self, const aur_ply_element *element, const aur_ply_property *property,
                              size_t index) {
    double value = 1.0;
    aur_result result = AUR_OK;
    if (property->list) {
        if (!next_binary(self, property->count_type, &value))
            result = read_text(self, element, index, &value);
        if (result == AUR_OK && (!(value >= 0.0) || value > 4294967295.0 || value != (double)(uint32_t)value))
            return aur_mesh_reader_fail(self->reader, "%s %zu: a list cannot have %g values", element->name,
                                        index, value);
    }
    const size_t count = (size_t)value;
    const size_t line = self->format == AUR_PLY_ASCII ? self->reader->scanner.line : 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        if (!next_binary(self, property->type, &value))
            result = read_text(self, element, index, &value);
        if (result == AUR_OK)
            result = take_value(self, element, property, index, value);
    }
    return result == AUR_OK && property->role == AUR_PLY_INDICES
               ? aur_mesh_reader_end_face(self->reader, line)
               : result;
}

static aur_result read_row(aur_ply *self, const aur_ply_element *element, size_t index) {
    aur_result result = AUR_OK;
    for (size_t p = 0; p < element->property_count && result == AUR_OK; ++p)
        result = read_values(self, element, &element->properties[p], index);
    return result;
}

/* --- fast path: the usual rows of large files, in native byte order */

static bool is_native(const aur_ply *self) {
    return self->format == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? AUR_PLY_BIG : AUR_PLY_LITTLE);
}

static bool has_floats(const aur_ply *self, const aur_ply_element *element) {
    bool all = is_native(self);
    for (size_t p = 0; p < element->property_count; ++p)
        all = all && !element->properties[p].list && element->properties[p].type == AUR_PLY_FLOAT &&
              element->properties[p].doubles != NULL;
    return all;
}

/* False: the row needs the general reader. */
static bool take_floats(aur_ply *self, const aur_ply_element *element, size_t index) {
    aur_scanner *const scanner = &self->reader->scanner;
    const size_t count = element->property_count;
    bool usable = (size_t)(scanner->end - scanner->at) >= count * sizeof(float);
    for (size_t p = 0; p < count && usable; ++p) {
        const aur_ply_property *const property = &element->properties[p];
        float value;
        memcpy(&value, scanner->at + p * sizeof value, sizeof value);
        usable = aur_mesh_is_usable((double)value);
        property->doubles[property->stride * index] = (double)value;
    }
    scanner->at += usable ? count * sizeof(float) : 0;
    return usable;
}

static bool has_short_lists(const aur_ply *self, const aur_ply_element *element) {
    const aur_ply_property *const list = &element->properties[0];
    return is_native(self) && element->property_count == 1 && list->role == AUR_PLY_INDICES &&
           list->count_type == AUR_PLY_UINT8 && (list->type == AUR_PLY_INT32 || list->type == AUR_PLY_UINT32);
}

static bool take_face(aur_ply *self, aur_result *result) {
    aur_scanner *const scanner = &self->reader->scanner;
    const size_t left = (size_t)(scanner->end - scanner->at);
    const size_t count = left > 0 ? (unsigned char)*scanner->at : 0;
    uint32_t corners[UINT8_MAX];
    bool usable = left > count * sizeof *corners;
    for (size_t i = 0; i < count && usable; ++i) {
        memcpy(&corners[i], scanner->at + 1 + i * sizeof *corners, sizeof *corners);
        usable = corners[i] < self->vertices->count && corners[i] <= INT32_MAX;
    }
    if (!usable)
        return false;
    scanner->at += 1 + count * sizeof *corners;
    *result = aur_mesh_reader_add_corners(self->reader, count, corners);
    if (*result == AUR_OK)
        *result = aur_mesh_reader_end_face(self->reader, 0);
    return true;
}

static aur_result read_rows(aur_ply *self, const aur_ply_element *element) {
    /* Without properties rows have no bytes, whatever the count. */
    if (element->property_count == 0)
        return AUR_OK;
    const bool floats = has_floats(self, element), lists = has_short_lists(self, element);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < element->count && result == AUR_OK; ++i)
        if (!(floats && take_floats(self, element, i)) && !(lists && take_face(self, &result)))
            result = read_row(self, element, i);
    return result;
}

/* --- entry point */

/* Rejects false counts before allocating: the file must have the minimum bytes for all rows. */
static aur_result check_count(const aur_ply *self, const aur_ply_element *element) {
    size_t least = self->format == AUR_PLY_ASCII;
    for (size_t p = 0; p < element->property_count && self->format != AUR_PLY_ASCII; ++p)
        least += type_sizes[element->properties[p].list ? element->properties[p].count_type
                                                        : element->properties[p].type];
    const size_t left = (size_t)(self->reader->scanner.end - self->reader->scanner.at);
    if (element->count <= left / least)
        return AUR_OK;
    return aur_mesh_reader_fail(self->reader, "%zu rows of '%s' cannot be in %zu bytes", element->count,
                                element->name, left);
}

/* Allocates arrays for the vertex roles from `first` on. */
static aur_result make_room(aur_ply *self, aur_ply_role first, size_t width, size_t size, void *values) {
    void **const array = values;
    *array = calloc(width * self->vertices->count + 1, size);
    if (*array == NULL)
        return aur_fail_memory(self->reader->error);
    for (size_t p = 0; p < self->vertices->property_count; ++p) {
        aur_ply_property *const property = &self->vertices->properties[p];
        const size_t column = (size_t)property->role - first;
        if (column >= width)
            continue;
        property->stride = width;
        if (size == sizeof(double))
            property->doubles = (double *)*array + column;
        else
            property->values = (float *)*array + column;
    }
    return AUR_OK;
}

static aur_result read_body(aur_ply *self) {
    aur_mesh_data *const data = self->reader->data;
    if (self->vertices->count >= AUR_MESH_NO_INDEX - 1)
        return aur_mesh_reader_fail(self->reader, "more than 2^32 - 2 vertices");
    aur_result result = check_count(self, self->vertices);
    if (result == AUR_OK)
        result = check_count(self, self->faces);
    data->vertex_count = self->vertices->count;
    if (result == AUR_OK)
        result = make_room(self, AUR_PLY_X, 3, sizeof(double), &data->points);
    if (result == AUR_OK && self->has[AUR_PLY_NX] && self->has[AUR_PLY_NY] && self->has[AUR_PLY_NZ] &&
        !self->reader->source->without_normals)
        result = make_room(self, AUR_PLY_NX, 3, sizeof(float), &data->normals);
    if (result == AUR_OK && self->has[AUR_PLY_U] && self->has[AUR_PLY_V])
        result = make_room(self, AUR_PLY_U, 2, sizeof(float), &data->uvs);
    if (result == AUR_OK)
        result = aur_ply_find_attributes(self);
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i)
        result = read_rows(self, &self->elements[i]);
    return result;
}

aur_result aur_ply_read(aur_mesh_reader *reader) {
    aur_ply *const self = calloc(1, sizeof *self);
    if (self == NULL)
        return aur_fail_memory(reader->error);
    self->reader = reader;
    aur_result result = aur_ply_read_header(self);
    if (self->format != AUR_PLY_ASCII)
        reader->scanner.line = 0;
    if (result == AUR_OK)
        result = read_body(self);
    free(self);
    return result;
}
