/* The open cylinder from p0 to p1, facing outwards. */
#include "render/scene/materials/sampling.h"
#include "render/scene/shape.h"

static void bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    (void)primitive;
    const aur_vector end = aur_vector_add_scaled(shape->center, shape->length, shape->axis[2]);
    const float from[3] = {shape->center.x, shape->center.y, shape->center.z}, to[3] = {end.x, end.y, end.z};
    const float along[3] = {shape->axis[2].x, shape->axis[2].y, shape->axis[2].z};
    for (size_t i = 0; i < 3; ++i) {
        const float half = shape->radius * sqrtf(fmaxf(0.0f, 1.0f - along[i] * along[i]));
        lower[i] = (double)(fminf(from[i], to[i]) - half);
        upper[i] = (double)(fmaxf(from[i], to[i]) + half);
    }
}

static bool intersect(const aur_shape *shape, const double origin[3], const double direction[3],
                      double nearest, double farthest, double *distance) {
    const double offset[3] = {origin[0] - (double)shape->center.x, origin[1] - (double)shape->center.y,
                              origin[2] - (double)shape->center.z};
    const double radius = shape->radius;
    const double ox = aur_shape_dot(offset, shape->axis[0]), oy = aur_shape_dot(offset, shape->axis[1]),
                 oz = aur_shape_dot(offset, shape->axis[2]);
    const double dx = aur_shape_dot(direction, shape->axis[0]), dy = aur_shape_dot(direction, shape->axis[1]),
                 dz = aur_shape_dot(direction, shape->axis[2]);
    const double a = dx * dx + dy * dy, b = ox * dx + oy * dy, c = ox * ox + oy * oy - radius * radius;
    /* The first root may lie beyond an end of the cylinder, and the second between the ends. */
    double from = nearest;
    for (size_t i = 0; i < 2; ++i) {
        if (!aur_first_root(a, b, c, from, farthest, distance))
            return false;
        const double z = oz + *distance * dz;
        if (z >= 0.0 && z <= (double)shape->length)
            return true;
        from = *distance;
    }
    return false;
}

/* Computed in doubles, and moved onto the surface that rays intersect, as the stored axes are rounded. */
static aur_vector point_of(const aur_shape *shape, aur_vector normal, float z) {
    const aur_vector along = shape->axis[2];
    const double radius = shape->radius, height = z;
    const double way[3] = {radius * (double)normal.x + height * (double)along.x,
                           radius * (double)normal.y + height * (double)along.y,
                           radius * (double)normal.z + height * (double)along.z};
    const double x = aur_shape_dot(way, shape->axis[0]), y = aur_shape_dot(way, shape->axis[1]);
    const double outwards = radius - sqrt(x * x + y * y);
    return (aur_vector){(float)((double)shape->center.x + way[0] + outwards * (double)normal.x),
                        (float)((double)shape->center.y + way[1] + outwards * (double)normal.y),
                        (float)((double)shape->center.z + way[2] + outwards * (double)normal.z)};
}

static aur_shape_point point_at(const aur_shape *shape, float cosine, float sine, float z) {
    aur_vector normal = aur_vector_scale(shape->axis[0], cosine);
    normal = aur_vector_add_scaled(normal, sine, shape->axis[1]);
    aur_shape_point point = {.texture = {.u = aur_shape_azimuth(cosine, sine), .v = z / shape->length}};
    aur_round_point(point_of(shape, normal, z), aur_vector_scale(normal, shape->flipped ? -1.0f : 1.0f),
                    aur_coordinate_sum(shape->center) + shape->radius + fabsf(z), &point);
    return point;
}

static void surface(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]) {
    (void)hit;
    const aur_vector way = aur_vector_subtract(position, shape->center);
    const float x = aur_vector_dot(way, shape->axis[0]), y = aur_vector_dot(way, shape->axis[1]);
    const float size = fmaxf(hypotf(x, y), 1e-30f);
    *point = point_at(shape, x / size, y / size, aur_vector_dot(way, shape->axis[2]));
    if (tangents == NULL)
        return;
    const float turn = 2.0f * AUR_PI_F;
    tangents[0] =
        aur_vector_add_scaled(aur_vector_scale(shape->axis[0], -turn * y), turn * x, shape->axis[1]);
    tangents[1] = aur_vector_scale(shape->axis[2], shape->length);
}

static aur_shape_point sample(const aur_shape *shape, float u, float v) {
    const float angle = 2.0f * AUR_PI_F * u;
    return point_at(shape, cosf(angle), sinf(angle), v * shape->length);
}

static const aur_curved curved = {bounds, intersect, surface, sample, NULL, NULL, NULL, NULL};

typedef struct cylinder_keys {
    double p0[3], p1[3], radius;
} cylinder_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_VECTOR(cylinder_keys, "p0", p0, -AUR_REACH, AUR_REACH, "0 0 0", "one end of its axis")},
    {AUR_KEY_OF_VECTOR(cylinder_keys, "p1", p1, -AUR_REACH, AUR_REACH, "0 0 1", "the other end")},
    {AUR_KEY_OF_REAL(cylinder_keys, "radius", radius, 1.0 / AUR_REACH, AUR_REACH, "1", "its radius")},
};

/* `to_world` may scale a cylinder along its axis, in addition to the similarity allowed for all round shapes.
 * *scale is the factor across the axis. */
static aur_result scale_across(const aur_shape_input *input, aur_vector way, double *scale,
                               aur_error *error) {
    aur_error even;
    const float length = aur_vector_length(way);
    if (aur_shape_similarity(input, scale, &even) == AUR_OK || !(length > 0.0f))
        return AUR_OK;
    const aur_frame frame = aur_frame_about(aur_vector_scale(way, 1.0f / length));
    const aur_vector x = aur_transform_direction_f(&input->to_world, frame.x);
    const aur_vector y = aur_transform_direction_f(&input->to_world, frame.y);
    const aur_vector z = aur_transform_direction_f(&input->to_world, frame.z);
    const double xx = (double)aur_vector_dot(x, x), yy = (double)aur_vector_dot(y, y);
    const double zz = (double)aur_vector_dot(z, z);
    *scale = sqrt(0.5 * (xx + yy));
    const bool round = fabs(xx - yy) <= 1e-4 * xx && fabs((double)aur_vector_dot(x, y)) <= 1e-4 * xx;
    const bool upright = fabs((double)aur_vector_dot(x, z)) <= 1e-4 * sqrt(xx * zz) &&
                         fabs((double)aur_vector_dot(y, z)) <= 1e-4 * sqrt(yy * zz);
    return round && upright
               ? AUR_OK
               : aur_parameters_fail(input->parameters, error, AUR_ERROR_UNSUPPORTED,
                                     "'to_world' may turn, move and scale it evenly, and stretch "
                                     "it along its axis, but not across");
}

/* The axes rotate with `to_world`, so that textures do, and are left-handed if it mirrors. `before` and `way`
 * are the axis vectors before and after `to_world`. */
static void set_axes(const aur_shape_input *input, aur_vector before, aur_vector way, aur_shape *shape) {
    const aur_frame frame = aur_frame_about(aur_vector_normalize(before));
    const aur_vector z = aur_vector_normalize(way);
    const aur_vector x = aur_transform_direction_f(&input->to_world, frame.x);
    shape->axis[2] = z;
    shape->axis[0] = aur_vector_normalize(aur_vector_add_scaled(x, -aur_vector_dot(x, z), z));
    const float side = aur_transform_determinant(&input->to_world) < 0.0 ? -1.0f : 1.0f;
    shape->axis[1] = aur_vector_scale(aur_vector_cross(z, shape->axis[0]), side);
}

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    cylinder_keys p;
    double scale;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    const aur_vector axis = {(float)(p.p1[0] - p.p0[0]), (float)(p.p1[1] - p.p0[1]),
                             (float)(p.p1[2] - p.p0[2])};
    if (result == AUR_OK)
        result = scale_across(input, axis, &scale, error);
    if (result != AUR_OK)
        return result;
    aur_transform_point(&input->to_world, p.p0, shape->position);
    const aur_vector way = aur_transform_direction_f(&input->to_world, axis);
    shape->length = aur_vector_length(way);
    if (!(shape->length > 0.0f) || !isfinite(shape->length))
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "'p0' and 'p1' must differ");
    set_axes(input, axis, way, shape);
    shape->radius = (float)(p.radius * scale);
    shape->area = 2.0 * AUR_PI * (double)shape->radius * (double)shape->length;
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_cylinder = {
    .row = {.name = "cylinder", .summary = "an open cylinder from `p0` to `p1`", AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create};
