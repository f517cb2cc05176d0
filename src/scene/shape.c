#include "scene/shape.h"

#include <stdlib.h>
#include <string.h>

extern const aur_shape_descriptor aur_shape_rectangle;
extern const aur_shape_descriptor aur_shape_cube;
extern const aur_shape_descriptor aur_shape_obj;

static const aur_shape_descriptor *const table[] = {
    &aur_shape_rectangle,
    &aur_shape_cube,
    &aur_shape_obj,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

const aur_shape_descriptor *aur_shape_descriptor_at(size_t index) {
    return index < TABLE_SIZE ? table[index] : NULL;
}

static aur_result find_descriptor(const aur_parameters *parameters, const aur_shape_descriptor **descriptor,
                                  aur_error *error) {
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0) {
            *descriptor = table[i];
            return AUR_OK;
        }
    }
    return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
}

static aur_result read_common(aur_shape_input *input, aur_error *error) {
    input->to_world = aur_transform_identity();
    aur_result result = aur_parameters_transform(input->parameters, "to_world", input->to_world.m, error);
    if (result == AUR_OK)
        result = aur_parameters_boolean(input->parameters, "flip_normals", &input->flip_normals, error);
    if (result != AUR_OK)
        return result;
    if (!aur_transform_is_affine(&input->to_world) ||
        !aur_transform_inverse(&input->to_world, &input->to_local))
        return aur_fail_at(error, input->parameters->location, AUR_ERROR_FORMAT,
                           "%s '%s': 'to_world' must be affine: its last row is 0 0 0 1",
                           input->parameters->kind, input->parameters->plugin);
    return AUR_OK;
}

aur_result aur_shape_create(aur_parameters *parameters, const aur_xml_document *document,
                            const aur_warnings *warnings, aur_shape **shape, aur_error *error) {
    *shape = NULL;
    const aur_shape_descriptor *descriptor = NULL;
    aur_shape_input input = {.parameters = parameters, .document = document, .warnings = warnings};
    aur_result result = find_descriptor(parameters, &descriptor, error);
    if (result == AUR_OK)
        result = read_common(&input, error);
    if (result != AUR_OK)
        return result;
    aur_shape *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    made->descriptor = descriptor;
    made->location = parameters->location;
    made->emitter = AUR_NO_EMITTER;
    result = descriptor->create(&input, made, error);
    if (result == AUR_OK)
        result = aur_mesh_check(&made->mesh, parameters->location, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_shape_destroy(made);
        return result;
    }
    for (size_t i = 0; i < made->mesh.triangle_count; ++i)
        made->area += aur_mesh_triangle_area(&made->mesh, i);
    *shape = made;
    return AUR_OK;
}

void aur_shape_destroy(aur_shape *shape) {
    if (shape == NULL)
        return;
    aur_mesh_release(&shape->mesh);
    free(shape);
}

void aur_shape_place(const aur_shape_input *input, aur_shape *shape) {
    aur_mesh_transform(&shape->mesh, &input->to_world, &input->to_local);
    if (input->flip_normals)
        aur_mesh_flip(&shape->mesh);
}

aur_result aur_shape_filename(const aur_shape_input *input, char **path, aur_error *error) {
    const aur_parameters *const parameters = input->parameters;
    const aur_parameter *const item = aur_parameters_find(input->parameters, "filename");
    if (item == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "%s '%s' needs the string 'filename'", parameters->kind, parameters->plugin);
    const char *name = NULL;
    const aur_result result = aur_parameters_string(input->parameters, "filename", &name, error);
    return result != AUR_OK ? result : aur_xml_find_asset(input->document, item->location, name, path, error);
}
