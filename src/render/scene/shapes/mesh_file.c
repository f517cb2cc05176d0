#include "render/scene/shapes/mesh_file.h"

#include <stdarg.h>
#include <stdlib.h>

#include "points/base/file.h"
#include "points/base/text.h"

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

static aur_result read_mesh(const aur_shape_file *bytes, aur_mesh_file_keys *keys, aur_shape *shape,
                            aur_error *error) {
    aur_mesh_file file = {.scanner = {bytes->data, bytes->data + bytes->size, 0},
                          .path = bytes->path,
                          .face_normals = keys->face_normals,
                          .flip_v = keys->flip_v,
                          .shape_index = keys->shape_index,
                          .error = error};
    aur_result result = shape->descriptor->read_file(&file, shape);
    file.scanner.line = 0;
    keys->face_normals = file.face_normals;
    if (result == AUR_OK && shape->mesh.triangle_count == 0)
        result = aur_mesh_file_fail(&file, "no face in this file");
    if (result == AUR_OK)
        result = aur_mesh_check(&shape->mesh, (aur_location){.file = bytes->path}, error);
    return result;
}

aur_result aur_shape_file_open(const aur_shape_input *input, const char *filename, aur_shape_file *file,
                               aur_error *error) {
    *file = (aur_shape_file){0};
    aur_parameters *const parameters = input->parameters;
    if (filename == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "%s '%s' needs the string 'filename'", parameters->kind, parameters->plugin);
    const aur_model_file *const part = aur_model_find_file(&input->document->model_files, filename);
    if (part != NULL) {
        *file = (aur_shape_file){part->name, part->size, part->data, NULL, NULL};
        return AUR_OK;
    }
    aur_result result =
        aur_xml_find_asset(input->document, aur_parameters_find(parameters, "filename")->location, filename,
                           &file->read_path, error);
    if (result == AUR_OK)
        result = aur_file_read(file->read_path, LARGEST_FILE, &file->read_data, &file->size, error);
    file->path = file->read_path;
    file->data = file->read_data;
    if (result != AUR_OK)
        aur_shape_file_close(file);
    return result;
}

void aur_shape_file_close(aur_shape_file *file) {
    free(file->read_path);
    free(file->read_data);
}

aur_result aur_mesh_file_create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    aur_parameters *const parameters = input->parameters;
    aur_mesh_file_keys keys = {.filename = NULL};
    aur_shape_file file;
    aur_result result = aur_row_read(&shape->descriptor->row, parameters, &keys, error);
    if (result == AUR_OK)
        result = aur_shape_file_open(input, keys.filename, &file, error);
    if (result != AUR_OK)
        return result;
    result = read_mesh(&file, &keys, shape, error);
    aur_shape_file_close(&file);
    if (result == AUR_OK && !keys.face_normals && shape->mesh.normals == NULL && keys.crease_angle < 180.0)
        result = aur_mesh_split_creases(&shape->mesh, keys.crease_angle, shape->location, error);
    if (result != AUR_OK)
        return result;
    aur_shape_transform(input, shape);
    shape->smooth = !keys.face_normals && shape->mesh.normals == NULL;
    return AUR_OK;
}
