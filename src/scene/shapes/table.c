/* Every shape by name. One new shape is one new file and one line here. */
#include <stdlib.h>
#include <string.h>

#include "scene/shape.h"

extern const aur_shape_descriptor aur_shape_rectangle;
extern const aur_shape_descriptor aur_shape_cube;
extern const aur_shape_descriptor aur_shape_obj;
extern const aur_shape_descriptor aur_shape_ply;
extern const aur_shape_descriptor aur_shape_serialized;
extern const aur_shape_descriptor aur_shape_sphere;
extern const aur_shape_descriptor aur_shape_disk;
extern const aur_shape_descriptor aur_shape_cylinder;

static const aur_shape_descriptor *const table[] = {
    &aur_shape_rectangle,  &aur_shape_cube,   &aur_shape_obj,  &aur_shape_ply,
    &aur_shape_serialized, &aur_shape_sphere, &aur_shape_disk, &aur_shape_cylinder,
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
    const aur_result result =
        aur_parameters_to_world(input->parameters, &input->to_world, &input->to_local, error);
    return result != AUR_OK
               ? result
               : aur_parameters_boolean(input->parameters, "flip_normals", &input->flip_normals, error);
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
    for (size_t i = 0; i < made->mesh.triangle_count; ++i) {
        const double area = aur_mesh_triangle_area(&made->mesh, i);
        const float squared = (float)(4.0 * area * area);
        made->area += area;
        made->extreme = made->extreme || (area > 0.0 && !aur_is_usual_square(squared));
    }
    *shape = made;
    return AUR_OK;
}

void aur_shape_destroy(aur_shape *shape) {
    if (shape == NULL)
        return;
    aur_mesh_release(&shape->mesh);
    free(shape);
}
