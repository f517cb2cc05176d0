/* The cube [-1,1]^3, facing outwards. */
#include "scene/shape.h"

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    aur_mesh *const mesh = &shape->mesh;
    const aur_result result =
        aur_mesh_allocate(mesh, 24, 12, AUR_MESH_UVS, input->parameters->location, error);
    if (result != AUR_OK)
        return result;
    for (size_t face = 0; face < 6; ++face) {
        const size_t axis = face / 2;
        const float side = face % 2 == 0 ? -1.0f : 1.0f;
        for (size_t i = 0; i < 4; ++i) {
            const size_t vertex = 4 * face + i;
            const float u = i == 1 || i == 2;
            const float v = i >= 2;
            /* On the negative faces one axis runs backwards, so that all faces turn the same way. */
            mesh->positions[3 * vertex + axis] = side;
            mesh->positions[3 * vertex + (axis + 1) % 3] = side * (2.0f * u - 1.0f);
            mesh->positions[3 * vertex + (axis + 2) % 3] = 2.0f * v - 1.0f;
            mesh->uvs[2 * vertex] = u;
            mesh->uvs[2 * vertex + 1] = v;
        }
        static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
        for (size_t i = 0; i < 6; ++i)
            mesh->indices[6 * face + i] = (uint32_t)(4 * face) + indices[i];
    }
    aur_shape_place(input, shape);
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_cube = {"cube", "the cube [-1,1]^3 facing outwards", create};
