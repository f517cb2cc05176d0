/* The cube [-1,1]^3, facing outwards. */
#include "render/scene/shape.h"

/* The signs of the corner coordinates of each face, counter-clockwise from outside, starting at Mitsuba's
 * texture coordinates (0, 1). */
static const char *const corners[6][4] = {
    {"+--", "+-+", "--+", "---"}, {"++-", "-+-", "-++", "+++"}, {"+--", "++-", "+++", "+-+"},
    {"+-+", "+++", "-++", "--+"}, {"--+", "-++", "-+-", "---"}, {"++-", "+--", "---", "-+-"},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    aur_mesh *const mesh = &shape->mesh;
    const aur_result result =
        aur_mesh_allocate(mesh, 24, 12, AUR_MESH_UVS, input->parameters->location, error);
    if (result != AUR_OK)
        return result;
    for (size_t vertex = 0; vertex < 24; ++vertex) {
        for (size_t axis = 0; axis < 3; ++axis)
            mesh->points[3 * vertex + axis] = corners[vertex / 4][vertex % 4][axis] == '+' ? 1.0 : -1.0;
        mesh->uvs[2 * vertex] = vertex % 4 == 1 || vertex % 4 == 2;
        mesh->uvs[2 * vertex + 1] = vertex % 4 < 2;
    }
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    for (size_t i = 0; i < 36; ++i)
        mesh->indices[i] = (uint32_t)(4 * (i / 6)) + indices[i % 6];
    aur_shape_transform(input, shape);
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_cube = {
    .row = {.name = "cube", .summary = "the cube [-1,1]^3 facing outwards"}, .create = create};
