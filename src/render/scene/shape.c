#include "render/scene/shape.h"

#include <stdlib.h>
#include <string.h>

bool aur_first_root(double a, double b, double c, double nearest, double farthest, double *root) {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0) || !(a > 0.0))
        return false;
    /* This form avoids cancellation between b and the square root. */
    const double q = -(b + copysign(sqrt(discriminant), b));
    double first = q / a, second = q != 0.0 ? c / q : first;
    if (first > second) {
        const double swap = first;
        first = second;
        second = swap;
    }
    *root = first > nearest ? first : second;
    return *root > nearest && *root < farthest;
}

/* Two triangles, (0, 1, 2) and (0, 2, 3). */
static void round_parallelogram(const aur_mesh *mesh, aur_shape_point *point) {
    const aur_vector a = aur_mesh_position(mesh, 0), b = aur_mesh_position(mesh, 1);
    const aur_vector c = aur_mesh_position(mesh, 2), d = aur_mesh_position(mesh, 3), n = point->normal;
    point->offset = aur_larger(aur_triangle_offset(a, b, c, n), aur_triangle_offset(a, c, d, n));
    point->rounding = aur_larger(aur_triangle_rounding(a, b, c, n), aur_triangle_rounding(a, c, d, n));
}

aur_shape_point aur_shape_sample(const aur_shape *shape, const aur_distribution *triangles,
                                 const float u[3]) {
    if (shape->curved != NULL)
        return shape->curved->sample(shape, u[1], u[2]);
    const aur_mesh *const mesh = &shape->mesh;
    float choice = u[0];
    const size_t triangle = triangles != NULL ? aur_distribution_choose(triangles, &choice) : 0;
    if (shape->parallelogram) {
        aur_shape_point point = aur_triangle_sample(mesh, 0, 0.0f, 0.0f);
        const aur_vector origin = aur_mesh_position(mesh, 0);
        const aur_vector x = aur_vector_subtract(aur_mesh_position(mesh, 1), origin);
        const aur_vector y = aur_vector_subtract(aur_mesh_position(mesh, 3), origin);
        round_parallelogram(mesh, &point);
        point.position = aur_vector_add_scaled(aur_vector_add_scaled(origin, u[1], x), u[2], y);
        point.texture = (aur_bsdf_point){.u = u[1], .v = u[2]};
        return point;
    }
    return aur_triangle_sample(mesh, triangle, u[1], u[2]);
}

aur_result aur_mesh_distribution(const aur_mesh *mesh, aur_distribution *triangles, aur_error *error) {
    double *const areas = malloc(mesh->triangle_count * sizeof *areas);
    if (areas == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        aur_vector corner[3];
        aur_mesh_corners(mesh, i, corner);
        areas[i] = aur_triangle_area(corner);
    }
    const aur_result result = aur_distribution_create(triangles, mesh->triangle_count, areas, error);
    free(areas);
    return result;
}

aur_shape_point aur_triangle_sample(const aur_mesh *mesh, size_t triangle, float u, float v) {
    aur_vector corner[3];
    aur_mesh_corners(mesh, triangle, corner);
    aur_shape_point point;
    point.normal = aur_triangle_normal(corner);
    point.offset = aur_triangle_offset(corner[0], corner[1], corner[2], point.normal);
    point.rounding = aur_triangle_rounding(corner[0], corner[1], corner[2], point.normal);
    const float root = sqrtf(u);
    const float b1 = root * (1.0f - v);
    const float b2 = root * v;
    point.position = aur_vector_add_scaled(corner[0], b1, aur_vector_subtract(corner[1], corner[0]));
    point.position = aur_vector_add_scaled(point.position, b2, aur_vector_subtract(corner[2], corner[0]));
    point.texture = aur_mesh_texture(mesh, triangle, b1, b2);
    return point;
}

void aur_shape_transform(const aur_shape_input *input, aur_shape *shape) {
    aur_mesh_transform(&shape->mesh, &input->to_world, &input->to_local);
    if (input->flip_normals)
        aur_mesh_flip(&shape->mesh);
}

aur_result aur_shape_similarity(const aur_shape_input *input, double *scale, aur_error *error) {
    const double *const m = input->to_world.m;
    double product[6]; /* dot products of columns: xx, yy, zz, xy, yz, zx */
    for (size_t i = 0; i < 3; ++i) {
        product[i] = m[i] * m[i] + m[4 + i] * m[4 + i] + m[8 + i] * m[8 + i];
        const size_t j = (i + 1) % 3;
        product[3 + i] = m[i] * m[j] + m[4 + i] * m[4 + j] + m[8 + i] * m[8 + j];
    }
    *scale = sqrt((product[0] + product[1] + product[2]) / 3.0);
    bool similar = true;
    for (size_t i = 0; i < 6; ++i)
        similar = similar && fabs(product[i] - (i < 3 ? *scale * *scale : 0.0)) <= 1e-4 * *scale * *scale;
    return similar ? AUR_OK
                   : aur_parameters_fail(input->parameters, error, AUR_ERROR_UNSUPPORTED,
                                         "'to_world' may turn, move and scale it evenly, but not stretch it");
}

aur_result aur_shape_use_attribute(aur_shape *shape, const char *name, bool *found, aur_error *error) {
    *found = false;
    for (size_t k = 0; k < shape->attribute_count; ++k) {
        const aur_mesh_attribute *const a = &shape->attributes[k];
        if (strcmp(a->name, name) != 0 || (a->width != 1 && a->width < 3))
            continue;
        const size_t count = a->of_faces ? shape->mesh.triangle_count : shape->mesh.vertex_count;
        float **const colors = a->of_faces ? &shape->mesh.face_colors : &shape->mesh.vertex_colors;
        free(*colors);
        *colors = malloc((3 * count + 1) * sizeof **colors);
        if (*colors == NULL)
            return aur_fail_memory_at(error, shape->location);
        for (size_t i = 0; i < 3 * count; ++i)
            (*colors)[i] = a->values[a->width * (i / 3) + (a->width == 1 ? 0 : i % 3)];
        *found = true;
        return AUR_OK;
    }
    return AUR_OK;
}

void aur_shape_release_attributes(aur_shape *shape) {
    for (size_t i = 0; i < shape->attribute_count; ++i)
        free(shape->attributes[i].values);
    free(shape->attributes);
    shape->attributes = NULL;
    shape->attribute_count = 0;
}

void aur_shape_curved_bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    const aur_curves *const curves = &shape->curves;
    if (curves->segment_count == 0) {
        shape->curved->bounds(shape, primitive, lower, upper); /* `center` is still 0 */
        for (size_t d = 0; d < 3; ++d) {
            lower[d] += shape->position[d];
            upper[d] += shape->position[d];
        }
        return;
    }
    for (size_t d = 0; d < 3; ++d) {
        lower[d] = HUGE_VAL;
        upper[d] = -HUGE_VAL;
    }
    for (size_t i = 0; i < (curves->smooth ? 4u : 2u); ++i) {
        const size_t point = curves->firsts[primitive] + i;
        const double *const center = &curves->positions[3 * point],
                            radius = (double)curves->points[4 * point + 3];
        for (size_t d = 0; d < 3; ++d) {
            lower[d] = center[d] - radius < lower[d] ? center[d] - radius : lower[d];
            upper[d] = center[d] + radius > upper[d] ? center[d] + radius : upper[d];
        }
    }
}
