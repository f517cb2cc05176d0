/* The square [-1,1]^2 in the plane z = 0, facing +z. */
#include "render/scene/shape.h"

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    aur_mesh *const mesh = &shape->mesh;
    const aur_result result = aur_mesh_allocate(mesh, 4, 2, AUR_MESH_UVS, input->parameters->location, error);
    if (result != AUR_OK)
        return result;
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    for (size_t i = 0; i < 4; ++i) {
        const float u = i == 1 || i == 2;
        const float v = i >= 2;
        mesh->points[3 * i] = 2.0 * (double)u - 1.0;
        mesh->points[3 * i + 1] = 2.0 * (double)v - 1.0;
        mesh->uvs[2 * i] = u;
        mesh->uvs[2 * i + 1] = v;
    }
    for (size_t i = 0; i < 6; ++i)
        mesh->indices[i] = indices[i];
    shape->parallelogram = true;
    aur_shape_transform(input, shape);
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_rectangle = {
    .row = {.name = "rectangle", .summary = "the square [-1,1]^2 facing +z"}, .create = create};
