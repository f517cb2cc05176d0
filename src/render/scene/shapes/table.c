/* Every shape by name. To add a shape: one new file, and one line here. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/plugin/plugin.h"
#include "render/scene/shape.h"

#define SHAPES(ROW)                                                                                          \
    ROW(rectangle)                                                                                           \
    ROW(polygon)                                                                                             \
    ROW(cube)                                                                                                \
    ROW(obj)                                                                                                 \
    ROW(ply)                                                                                                 \
    ROW(stl)                                                                                                 \
    ROW(off)                                                                                                 \
    ROW(serialized)                                                                                          \
    ROW(sphere)                                                                                              \
    ROW(disk)                                                                                                \
    ROW(cylinder)                                                                                            \
    ROW(cone)                                                                                                \
    ROW(linearcurve)                                                                                         \
    ROW(bsplinecurve)

#define DECLARE(name) extern const aur_shape_descriptor aur_shape_##name;
SHAPES(DECLARE)

#define ADDRESS(name) &aur_shape_##name.row,
static const aur_row *const rows[] = {SHAPES(ADDRESS)};

static const aur_key common_keys[] = {
    {AUR_KEY_OF_TRANSFORM(aur_shape_keys, "to_world", to_world, "object to world")},
    {AUR_KEY_OF_BOOLEAN(aur_shape_keys, "flip_normals", flip_normals, "false",
                        "normals point to the other side")},
    {AUR_KEY_OF_ITEM(aur_shape_keys, "bsdf", bsdf, NULL, "material; without one grey, or black for a light",
                     "bsdf")},
    {AUR_KEY_OF_ITEM(aur_shape_keys, "emitter", emitter, NULL, "emitter: makes the shape a light",
                     "emitter")},
    {AUR_KEY_OF_ITEM(aur_shape_keys, "interior", interior, NULL, "medium inside", "medium")},
    {AUR_KEY_OF_ITEM(aur_shape_keys, "exterior", exterior, NULL, "medium outside", "medium")},
};

static const aur_row common = {
    .name = "shape", .summary = "what every shape takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_shape_table = {
    .kind = "shape", .summary = "surfaces", AUR_TABLE_ROWS(rows), .common = &common};

/* `context`: the scene's document. */
static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    aur_shape *const shape = object;
    aur_shape_keys keys = {.bsdf = NULL};
    aur_shape_input input = {.parameters = parameters, .document = (aur_xml_document *)(uintptr_t)context};
    aur_result result = aur_keys_read(common.key_count, common.keys, parameters, &keys, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &keys.to_world, &input.to_local, error);
    if (result != AUR_OK)
        return result;
    input.to_world = keys.to_world;
    input.flip_normals = keys.flip_normals;
    shape->location = parameters->location;
    shape->emitter = AUR_NO_EMITTER;
    shape->curved = shape->descriptor->curved;
    shape->flipped = keys.flip_normals;
    result = shape->descriptor->create(&input, shape, error);
    return result == AUR_OK ? aur_mesh_check(&shape->mesh, parameters->location, error) : result;
}

static void release(void *object) {
    aur_shape *const shape = object;
    aur_mesh_release(&shape->mesh);
    aur_shape_release_attributes(shape);
    free(shape->file);
    free(shape->curves.positions);
    free(shape->curves.points);
    free(shape->curves.firsts);
}

static const aur_plugin_kind kind = {
    .table = &aur_shape_table, .size = sizeof(aur_shape), .fill = fill, .release = release};

aur_result aur_shape_create(aur_parameters *parameters, aur_xml_document *document, aur_shape **shape,
                            aur_error *error) {
    return aur_plugin_create(&kind, parameters, document, shape, error);
}

void aur_shape_destroy(aur_shape *shape) {
    aur_plugin_destroy(&kind, shape);
}

static void measure_mesh(aur_shape *shape) {
    for (size_t i = 0; i < shape->mesh.triangle_count; ++i) {
        aur_vector corner[3];
        aur_mesh_corners(&shape->mesh, i, corner);
        const double area = aur_triangle_area(corner);
        const float squared = (float)(4.0 * area * area);
        shape->area += area;
        shape->extreme = shape->extreme || (area > 0.0 && !aur_is_usual_square(squared));
    }
}

static void recenter_curves(aur_shape *shape, const double origin[3]) {
    aur_curves *const curves = &shape->curves;
    for (size_t i = 0; i < curves->point_count; ++i)
        for (size_t k = 0; k < 3; ++k)
            curves->points[4 * i + k] = (float)(curves->positions[3 * i + k] - origin[k]);
    free(curves->positions);
    curves->positions = NULL;
    for (size_t i = 0; i < curves->segment_count; ++i)
        shape->area += shape->curved->area(shape, i);
}

aur_result aur_shape_recenter(aur_shape *shape, const double origin[3], bool with_points, aur_error *error) {
    shape->center = aur_internal_point(origin, shape->position);
    if (shape->curves.segment_count > 0)
        recenter_curves(shape, origin);
    if (shape->curved != NULL)
        return AUR_OK;
    aur_result result = aur_mesh_recenter(&shape->mesh, origin, with_points, shape->location, error);
    if (result == AUR_OK && shape->smooth)
        result = aur_mesh_smooth(&shape->mesh, shape->location, error);
    if (result == AUR_OK && shape->descriptor->read_file != NULL)
        aur_mesh_drop_flat_normals(&shape->mesh);
    if (result == AUR_OK)
        measure_mesh(shape);
    return result;
}
