/* The unit disk in the plane z = 0, facing +z, optionally with a hole; an affine map makes it an ellipse. */
#include "render/scene/materials/sampling.h"
#include "render/scene/shape.h"

static void bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    (void)primitive;
    const float center[3] = {shape->center.x, shape->center.y, shape->center.z};
    const float half[3] = {hypotf(shape->axis[0].x, shape->axis[1].x),
                           hypotf(shape->axis[0].y, shape->axis[1].y),
                           hypotf(shape->axis[0].z, shape->axis[1].z)};
    for (size_t i = 0; i < 3; ++i) {
        lower[i] = (double)(center[i] - half[i]);
        upper[i] = (double)(center[i] + half[i]);
    }
}

/* Coordinates along the two axes, which may be oblique. */
static void local(const aur_shape *shape, const double way[3], double *x, double *y) {
    const aur_vector a = shape->axis[0], b = shape->axis[1];
    const double aa = aur_vector_dot(a, a), ab = aur_vector_dot(a, b), bb = aur_vector_dot(b, b);
    const double wa = aur_shape_dot(way, a), wb = aur_shape_dot(way, b), determinant = aa * bb - ab * ab;
    *x = (wa * bb - wb * ab) / determinant;
    *y = (wb * aa - wa * ab) / determinant;
}

static bool intersect(const aur_shape *shape, const double origin[3], const double direction[3],
                      double nearest, double farthest, double *distance) {
    const double to_center[3] = {(double)shape->center.x - origin[0], (double)shape->center.y - origin[1],
                                 (double)shape->center.z - origin[2]};
    const double t = aur_shape_dot(to_center, shape->axis[2]) / aur_shape_dot(direction, shape->axis[2]);
    if (!(t > nearest) || !(t < farthest))
        return false;
    const double way[3] = {t * direction[0] - to_center[0], t * direction[1] - to_center[1],
                           t * direction[2] - to_center[2]};
    double x, y;
    local(shape, way, &x, &y);
    *distance = t;
    const double squared = x * x + y * y;
    return squared <= 1.0 && squared >= (double)shape->inner * (double)shape->inner;
}

/* Computed in doubles, and moved onto the plane that rays intersect, as the stored axes are rounded. */
static aur_vector point_of(const aur_shape *shape, double x, double y) {
    const aur_vector a = shape->axis[0], b = shape->axis[1], z = shape->axis[2];
    const double way[3] = {x * (double)a.x + y * (double)b.x, x * (double)a.y + y * (double)b.y,
                           x * (double)a.z + y * (double)b.z};
    const double unit[3] = {z.x, z.y, z.z};
    const double height = aur_shape_dot(way, z) / aur_shape_dot(unit, z);
    return (aur_vector){(float)((double)shape->center.x + way[0] - height * unit[0]),
                        (float)((double)shape->center.y + way[1] - height * unit[1]),
                        (float)((double)shape->center.z + way[2] - height * unit[2])};
}

static aur_shape_point point_at(const aur_shape *shape, float x, float y) {
    aur_shape_point point = {.texture = {.u = hypotf(x, y), .v = aur_shape_azimuth(x, y)}};
    aur_round_point(point_of(shape, (double)x, (double)y),
                    aur_vector_scale(shape->axis[2], shape->flipped ? -1.0f : 1.0f),
                    aur_coordinate_sum(shape->center) + aur_coordinate_sum(shape->axis[0]) +
                        aur_coordinate_sum(shape->axis[1]),
                    &point);
    return point;
}

static void surface(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]) {
    (void)hit;
    const aur_vector way = aur_vector_subtract(position, shape->center);
    double x, y;
    local(shape, (double[3]){way.x, way.y, way.z}, &x, &y);
    *point = point_at(shape, (float)x, (float)y);
    if (tangents == NULL)
        return;
    const float radius = hypotf((float)x, (float)y), turn = 2.0f * AUR_PI_F;
    tangents[0] = radius > 0.0f ? aur_vector_scale(way, 1.0f / radius) : shape->axis[0];
    tangents[1] = aur_vector_add_scaled(aur_vector_scale(shape->axis[0], -turn * (float)y), turn * (float)x,
                                        shape->axis[1]);
}

static aur_shape_point sample(const aur_shape *shape, float u, float v) {
    float x, y;
    if (shape->inner > 0.0f) {
        const float hole = shape->inner * shape->inner, radius = sqrtf(hole + u * (1.0f - hole));
        return point_at(shape, radius * cosf(2.0f * AUR_PI_F * v), radius * sinf(2.0f * AUR_PI_F * v));
    }
    aur_sample_disk(u, v, &x, &y);
    return point_at(shape, x, y);
}

static void equal_area(const aur_hit *hit, float coordinates[2]) {
    (void)hit;
    coordinates[0] *= coordinates[0];
}

static const aur_curved curved = {bounds, intersect, surface, sample, NULL, NULL, equal_area, NULL};

typedef struct disk_keys {
    double inner_radius;
} disk_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(disk_keys, "inner_radius", inner_radius, 0.0, 1.0, "0", "of a hole in the middle"),
     .maximum_open = true},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    disk_keys p;
    const aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result != AUR_OK)
        return result;
    shape->ellipse = true;
    shape->inner = (float)p.inner_radius;
    aur_transform_point(&input->to_world, (const double[3]){0.0, 0.0, 0.0}, shape->position);
    shape->axis[0] = aur_transform_direction_f(&input->to_world, (aur_vector){1.0f, 0.0f, 0.0f});
    shape->axis[1] = aur_transform_direction_f(&input->to_world, (aur_vector){0.0f, 1.0f, 0.0f});
    shape->axis[2] =
        aur_vector_normalize(aur_transform_normal_f(&input->to_local, (aur_vector){0.0f, 0.0f, 1.0f}));
    shape->area = AUR_PI * (double)aur_vector_length(aur_vector_cross(shape->axis[0], shape->axis[1]));
    shape->area *= 1.0 - (double)shape->inner * (double)shape->inner;
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_disk = {
    .row = {.name = "disk", .summary = "the unit disk facing +z", AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create};
