/* Stanford PLY: ascii and both binary forms; polygons become fans; properties that a mesh has no use for are
 * left out. */
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "scene/shapes/ply.h"

static const size_t type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

static void skip_ascii_space(aur_scanner *scanner) {
    for (aur_scan_blanks(scanner); scanner->at < scanner->end && *scanner->at == '\n';
         aur_scan_blanks(scanner)) {
        ++scanner->at;
        ++scanner->line;
    }
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
    aur_scanner *const scanner = &self->file->scanner;
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
        return aur_mesh_file_fail(self->file, "the file ends in %s %zu of %zu", element->name, index,
                                  element->count);
    return aur_mesh_file_fail(self->file, "%s %zu: a number is expected", element->name, index);
}

/* A corner of a polygon; from the third on, each makes a triangle with the first and the one before. */
static aur_result add_corner(aur_ply *self, size_t face, size_t corner, double value) {
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

static aur_result take_value(aur_ply *self, const aur_ply_property *property, size_t index, size_t place,
                             double value) {
    if (property->role == AUR_PLY_INDICES)
        return add_corner(self, index, place, value);
    if (property->values == NULL && property->doubles == NULL)
        return AUR_OK;
    if (!(fabs(value) <= 1e30))
        return aur_mesh_file_fail(self->file, "%s %zu is not finite, or beyond 1e30",
                                  property->role < AUR_PLY_FACE_RED ? "vertex" : "face", index);
    const bool of_255 = property->type == AUR_PLY_UINT8 && property->role >= AUR_PLY_RED;
    if (property->doubles != NULL)
        property->doubles[property->stride * index] = value;
    else
        property->values[property->stride * index] = (float)(of_255 ? value / 255.0 : value);
    return AUR_OK;
}

static aur_result read_values(aur_ply *self, const aur_ply_element *element, const aur_ply_property *property,
                              size_t index) {
    double value = 1.0;
    aur_result result = AUR_OK;
    if (property->list) {
        result = read_value(self, property->count_type, element, index, &value);
        if (result == AUR_OK && (!(value >= 0.0) || value > 1e6 || value != floor(value)))
            return aur_mesh_file_fail(self->file, "%s %zu: a list cannot have %g values", element->name,
                                      index, value);
        if (result == AUR_OK && property->role == AUR_PLY_INDICES && value < 3.0)
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

/* Where the properties of an element go. */
static void set_targets(const aur_ply *self, aur_ply_element *element, const aur_mesh *mesh) {
    const struct {
        float *values;
        aur_ply_role first;
        size_t stride;
    } targets[] = {{mesh->normals, AUR_PLY_NX, 3},
                   {mesh->uvs, AUR_PLY_U, 2},
                   {mesh->vertex_colors, AUR_PLY_RED, 3},
                   {self->colors, AUR_PLY_FACE_RED, 3}};
    for (size_t p = 0; p < element->property_count; ++p) {
        aur_ply_property *const property = &element->properties[p];
        const size_t axis = (size_t)property->role - AUR_PLY_X;
        property->values = NULL;
        property->doubles = axis < 3 ? mesh->points + axis : NULL;
        property->stride = 3;
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
static bool has_all(const aur_ply *self, aur_ply_role first) {
    return self->has[first] && self->has[first + 1] && self->has[first + 2];
}

/* Room for the colours of faces, in the end those of triangles. */
static aur_result prepare_face_colors(aur_ply *self, size_t left) {
    size_t count = 0;
    for (size_t i = 0; i < self->element_count; ++i)
        if (strcmp(self->elements[i].name, "face") == 0 && self->elements[i].count > count)
            count = self->elements[i].count;
    if (count > left)
        return aur_mesh_file_fail(self->file, "%zu faces cannot be in %zu bytes", count, left);
    self->colors = calloc(3 * count + 1, sizeof *self->colors);
    return self->colors != NULL ? AUR_OK : aur_fail_memory(self->file->error);
}

static aur_result color_triangles(const aur_ply *self, aur_mesh *mesh) {
    mesh->face_colors = malloc((3 * mesh->triangle_count + 1) * sizeof *mesh->face_colors);
    if (mesh->face_colors == NULL)
        return aur_fail_memory(self->file->error);
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        memcpy(&mesh->face_colors[3 * i], &self->colors[3 * (size_t)self->faces[i]],
               3 * sizeof *self->colors);
    return AUR_OK;
}

static aur_result read_body(aur_ply *self, aur_mesh *mesh) {
    aur_mesh_file *const file = self->file;
    /* A count that lies is found out before memory is asked for. */
    const size_t left = (size_t)(file->scanner.end - file->scanner.at);
    if (self->vertices->count > left)
        return aur_mesh_file_fail(file, "%zu vertices cannot be in %zu bytes", self->vertices->count, left);
    const unsigned parts = (has_all(self, AUR_PLY_NX) && !file->face_normals ? AUR_MESH_NORMALS : 0u) |
                           (self->has[AUR_PLY_U] && self->has[AUR_PLY_V] ? AUR_MESH_UVS : 0u) |
                           (has_all(self, AUR_PLY_RED) ? AUR_MESH_VERTEX_COLORS : 0u);
    aur_result result = aur_mesh_allocate(mesh, self->vertices->count, 0, parts,
                                          (aur_location){.file = file->path}, file->error);
    if (result == AUR_OK && has_all(self, AUR_PLY_FACE_RED))
        result = prepare_face_colors(self, left);
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i)
        set_targets(self, &self->elements[i], mesh);
    for (size_t i = 0; result == AUR_OK && i < self->element_count; ++i)
        result = read_rows(self, &self->elements[i]);
    return result;
}

static aur_result read_file(aur_mesh_file *file, aur_mesh *mesh) {
    aur_ply *const self = calloc(1, sizeof *self);
    if (self == NULL)
        return aur_fail_memory(file->error);
    self->file = file;
    file->scanner.line = 1;
    aur_result result = aur_ply_read_header(self);
    if (self->format != AUR_PLY_ASCII)
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
    .read_file = read_file};
