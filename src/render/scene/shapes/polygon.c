/* A planar polygon, triangulated. A degenerate or self-intersecting one becomes an empty mesh. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/shape.h"

typedef struct polygon_keys {
    const char *vertices;
} polygon_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(polygon_keys, "vertices", vertices, NULL,
                     "x y z of each corner, counter-clockwise seen from the front; must be given")},
};

static bool is_parallelogram(const double *v) {
    double gap = 0.0, size = 0.0;
    for (size_t d = 0; d < 3; ++d) {
        gap += fabs(v[d] - v[3 + d] + v[6 + d] - v[9 + d]);
        size += fabs(v[6 + d] - v[d]);
    }
    return gap <= 1e-7 * size;
}

/* Corners from index `first` on. */
static void put_corners(size_t count, size_t first, const double *corners, double *points) {
    for (size_t i = 0; i < 3 * count; ++i)
        points[i] = corners[(3 * first + i) % (3 * count)];
}

static aur_result make_mesh(const aur_shape_input *input, size_t count, const double *corners,
                            aur_shape *shape, aur_error *error) {
    static const uint32_t halves[6] = {0, 1, 2, 0, 2, 3};
    aur_triangulator work = {0};
    aur_face_cut cut;
    if (!aur_triangulate(&work, count, (const double(*)[3])(const void *)corners, &cut))
        return aur_fail_memory_at(error, input->parameters->location);
    aur_face_flaws_count(&shape->flaws, cut.flaw, 0);
    shape->parallelogram = count == 4 && cut.triangle_count == 2 && is_parallelogram(corners);
    /* The start of the outline matters only for directional lights, which need parallelograms. */
    const size_t first = shape->parallelogram ? 0 : cut.first;
    const aur_result result = aur_mesh_allocate(&shape->mesh, count, cut.triangle_count,
                                                AUR_MESH_POSITIONS_ONLY, input->parameters->location, error);
    if (result == AUR_OK) {
        put_corners(count, first, corners, shape->mesh.points);
        for (size_t i = 0; i < 3 * cut.triangle_count; ++i)
            shape->mesh.indices[i] =
                shape->parallelogram ? halves[i] : (uint32_t)((cut.indices[i] + count - first) % count);
        aur_shape_transform(input, shape);
    }
    aur_triangulator_release(&work);
    return result;
}

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    polygon_keys p = {.vertices = NULL};
    const aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (p.vertices == NULL)
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "it needs 'vertices'");
    /* A number takes at least two characters. */
    const size_t capacity = strlen(p.vertices) / 2 + 1;
    double *const corners = malloc(capacity * sizeof *corners);
    aur_result status = corners != NULL ? AUR_OK : aur_fail_memory(error);
    if (status == AUR_OK) {
        const size_t numbers = aur_parse_doubles(p.vertices, corners, capacity);
        bool finite = numbers != SIZE_MAX && numbers >= 9 && numbers % 3 == 0;
        for (size_t i = 0; finite && i < numbers; ++i)
            finite = fabs(corners[i]) <= AUR_REACH;
        status = finite
                     ? make_mesh(input, numbers / 3, corners, shape, error)
                     : aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT,
                                           "'vertices' must be three numbers a corner, within %g, of three "
                                           "corners or more",
                                           AUR_REACH);
    }
    free(corners);
    return status;
}

const aur_shape_descriptor aur_shape_polygon = {
    .row = {.name = "polygon", .summary = "a plane polygon of any outline", AUR_ROW_KEYS(keys)},
    .create = create};
