/* Meshes in file formats of other programs. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/shapes/mesh_file.h"

/* Expands per-face values to the triangles of the faces. */
static bool spread_over_triangles(const aur_mesh_data *data, aur_mesh_attribute *attribute) {
    float *const values = malloc((attribute->width * data->triangle_count + 1) * sizeof *values);
    for (size_t i = 0; values != NULL && i < data->triangle_count; ++i)
        memcpy(&values[attribute->width * i], &attribute->values[attribute->width * aur_mesh_face(data, i)],
               attribute->width * sizeof *values);
    free(attribute->values);
    attribute->values = values;
    return values != NULL;
}

static aur_result take_data(const aur_mesh_file *file, aur_mesh_data *data, aur_shape *shape) {
    aur_mesh *const mesh = &shape->mesh;
    for (size_t i = 0; i < data->attribute_count; ++i)
        if (data->attributes[i].of_faces && !spread_over_triangles(data, &data->attributes[i]))
            return aur_fail_memory(file->error);
    const aur_result result = aur_mesh_allocate(mesh, data->vertex_count, 0, AUR_MESH_POSITIONS_ONLY,
                                                (aur_location){.file = file->path}, file->error);
    if (result != AUR_OK)
        return result;
    free(mesh->points);
    mesh->points = data->points;
    data->points = NULL;
    aur_mesh_take_indices(mesh, 3 * data->triangle_count, &data->indices);
    mesh->normals = data->normals;
    mesh->uvs = data->uvs;
    for (size_t i = 0; file->flip_v && mesh->uvs != NULL && i < mesh->vertex_count; ++i)
        mesh->uvs[2 * i + 1] = 1.0f - mesh->uvs[2 * i + 1];
    shape->attribute_count = data->attribute_count;
    shape->attributes = data->attributes;
    shape->flaws = data->flaws;
    data->normals = data->uvs = NULL;
    data->attributes = NULL;
    data->attribute_count = 0;
    shape->file = strdup(file->path);
    return shape->file != NULL ? AUR_OK : aur_fail_memory(file->error);
}

static aur_result read_format(aur_mesh_file *file, aur_mesh_format format, aur_shape *shape) {
    const aur_mesh_source source = {.path = file->path,
                                    .format = format,
                                    .size = (size_t)(file->scanner.end - file->scanner.at),
                                    .data = file->scanner.at,
                                    .without_normals = file->face_normals};
    aur_mesh_data data;
    aur_result result = aur_mesh_read(&source, &data, file->error);
    if (result == AUR_OK && data.face_count == 0)
        result = aur_mesh_file_fail(file, "no face in this file");
    if (result == AUR_OK)
        result = take_data(file, &data, shape);
    aur_mesh_data_release(&data);
    return result;
}

static aur_result read_obj(aur_mesh_file *file, aur_shape *shape) {
    return read_format(file, AUR_MESH_OBJ, shape);
}

static aur_result read_ply(aur_mesh_file *file, aur_shape *shape) {
    return read_format(file, AUR_MESH_PLY, shape);
}

static aur_result read_stl(aur_mesh_file *file, aur_shape *shape) {
    file->face_normals = true; /* flat shading, as STL facets have */
    return read_format(file, AUR_MESH_STL, shape);
}

static aur_result read_off(aur_mesh_file *file, aur_shape *shape) {
    return read_format(file, AUR_MESH_OFF, shape);
}

static const aur_key keys[] = {AUR_MESH_FILE_KEYS};

static const aur_key obj_keys[] = {
    AUR_MESH_FILE_KEYS,
    {AUR_KEY_OF_BOOLEAN(aur_mesh_file_keys, "flip_tex_coords", flip_v, "true",
                        "flip v of the texture coordinates")},
};

const aur_shape_descriptor aur_shape_obj = {
    .row = {.name = "obj", .summary = "a Wavefront OBJ file", AUR_ROW_KEYS(obj_keys)},
    .create = aur_mesh_file_create,
    .read_file = read_obj};

const aur_shape_descriptor aur_shape_ply = {
    .row = {.name = "ply", .summary = "a Stanford PLY file, ascii or binary", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_ply};

const aur_shape_descriptor aur_shape_stl = {
    .row = {.name = "stl", .summary = "an STL file, ascii or binary, of flat triangles", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_stl};

const aur_shape_descriptor aur_shape_off = {
    .row = {.name = "off", .summary = "an OFF file of Geomview", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_off};
