/* Stanford PLY: ascii and both binary forms; elements that a mesh has no use for are left out. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "scene/meshes/ply.h"

static const size_t type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

static void skip_ascii_space(aur_scanner *scanner) {
    for (aur_scan_blanks(scanner); scanner->at < scanner->end && aur_is_line_end(*scanner->at);
         aur_scan_blanks(scanner))
        aur_scan_line_end(scanner);
}

static double read_binary(const char *at, aur_ply_type type, bool big) {
    const size_t size = type_sizes[type];
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i)
        bits |= (uint64_t)(unsigned char)at[big ? size - 1 - i : i] << (8 * i);
    const uint32_t half = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case AUR_PLY_INT8:
        return (int8_t)bits;
    case AUR_PLY_INT16:
        return (int16_t)bits;
    case AUR_PLY_INT32:
        return (int32_t)bits;
    case AUR_PLY_FLOAT:
        memcpy(&single, &half, sizeof single);
        return (double)single;
    case AUR_PLY_DOUBLE:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default: /* the unsigned types */
        return (double)bits;
    }
}

static aur_result read_value(aur_ply *self, aur_ply_type type, const aur_ply_element *element, size_t index,
                             double *value) {
    aur_scanner *const scanner = &self->reader->scanner;
    if (self->format == AUR_PLY_ASCII) {
        skip_ascii_space(scanner);
        if (aur_scan_double(scanner, value))
            return AUR_OK;
    } else if ((size_t)(scanner->end - scanner->at) >= type_sizes[type]) {
        *value = read_binary(scanner->at, type, self->format == AUR_PLY_BIG);
        scanner->at += type_sizes[type];
        return AUR_OK;
    }
    if (scanner->at >= scanner->end || self->format != AUR_PLY_ASCII)
        return aur_mesh_reader_fail(self->reader, "the file ends in %s %zu of %zu", element->name, index,
                                    element->count);
    return aur_mesh_reader_fail(self->reader, "%s %zu: a number is expected", element->name, index);
}

static aur_result add_corner(aur_ply *self, size_t face, double value) {
    const size_t vertex_count = self->vertices->count;
    if (!(value >= 0.0) || !(value < (double)vertex_count) || value != floor(value))
        return aur_mesh_reader_fail(self->reader, "face %zu: index %.10g is no vertex: there are %zu", face,
                                    value, vertex_count);
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
        result = read_value(self, property->count_type, element, index, &value);
        if (result == AUR_OK && (!(value >= 0.0) || value > 4294967295.0 || value != floor(value)))
            return aur_mesh_reader_fail(self->reader, "%s %zu: a list cannot have %g values", element->name,
                                        index, value);
    }
    const size_t count = (size_t)value;
    const size_t line = self->format == AUR_PLY_ASCII ? self->reader->scanner.line : 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        result = read_value(self, property->type, element, index, &value);
        if (result == AUR_OK)
            result = take_value(self, element, property, index, value);
    }
    return result == AUR_OK && property->role == AUR_PLY_INDICES
               ? aur_mesh_reader_end_face(self->reader, line)
               : result;
}

static aur_result read_rows(aur_ply *self, const aur_ply_element *element) {
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

/* A count that lies is found out before memory is asked for: the fewest bytes of its rows must be there. */
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

/* Room for roles that vertices have, from `first` on. */
static aur_result make_room(aur_ply *self, aur_ply_role first, size_t width, size_t size, void *values) {
    void **const array = values;
    *array = calloc(width * self->vertices->count + 1, size);
    if (*array == NULL)
        return aur_fail_memory(self->reader->error);
    for (size_t p = 0; p < self->vertices->property_count; ++p) {
        aur_ply_property *const property = &self->vertices->properties[p];
        const size_t place = (size_t)property->role - first;
        if (place >= width)
            continue;
        property->stride = width;
        if (size == sizeof(double))
            property->doubles = (double *)*array + place;
        else
            property->values = (float *)*array + place;
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
