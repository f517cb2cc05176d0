#include "scene/shapes/mesh_file.h"

#include <stdarg.h>
#include <stdlib.h>

#include "core/file.h"
#include "core/text.h"

#define LARGEST_FILE ((size_t)1 << 35)

aur_result aur_mesh_file_fail(const aur_mesh_file *file, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(file->error, (aur_location){file->path, file->scanner.line, 0}, AUR_ERROR_FORMAT, "%s",
                       text);
}

static aur_result read_data(const char *path, size_t size, const char *data, const aur_mesh_file_keys *keys,
                            aur_shape *shape, aur_error *error) {
    aur_mesh_file file = {.scanner = {data, data + size, 0},
                          .path = path,
                          .face_normals = keys->face_normals,
                          .flip_v = keys->flip_v,
                          .shape_index = keys->shape_index,
                          .error = error};
    aur_result result = shape->descriptor->read_file(&file, &shape->mesh);
    file.scanner.line = 0;
    if (result == AUR_OK && shape->mesh.triangle_count == 0)
        result = aur_mesh_file_fail(&file, "no face in this file");
    if (result == AUR_OK)
        result = aur_mesh_check(&shape->mesh, (aur_location){.file = path}, error);
    return result;
}

static aur_result read_file(const char *path, const aur_mesh_file_keys *keys, aur_shape *shape,
                            aur_error *error) {
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, LARGEST_FILE, &data, &size, error);
    if (result != AUR_OK)
        return result;
    result = read_data(path, size, data, keys, shape, error);
    free(data);
    return result;
}

aur_result aur_mesh_file_create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    aur_parameters *const parameters = input->parameters;
    aur_mesh_file_keys keys = {.filename = NULL};
    char *path = NULL;
    aur_result result = aur_row_read(&shape->descriptor->row, parameters, &keys, error);
    if (result == AUR_OK && keys.filename == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "%s '%s' needs the string 'filename'", parameters->kind, parameters->plugin);
    if (result != AUR_OK)
        return result;
    const aur_model_file *const part = aur_model_find_file(&input->document->model_files, keys.filename);
    if (part != NULL)
        result = read_data(part->name, part->size, part->data, &keys, shape, error);
    else
        result = aur_xml_find_asset(input->document, aur_parameters_find(parameters, "filename")->location,
                                    keys.filename, &path, error);
    if (result == AUR_OK && part == NULL)
        result = read_file(path, &keys, shape, error);
    free(path);
    if (result != AUR_OK)
        return result;
    aur_shape_place(input, shape);
    if (shape->descriptor->smooths && !keys.face_normals && shape->mesh.normals == NULL)
        result = aur_mesh_smooth(&shape->mesh, parameters->location, error);
    aur_mesh_drop_flat_normals(&shape->mesh);
    return result;
}
