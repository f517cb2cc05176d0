/* The open truncated cone from p0 to p1, facing outwards. */
#include <math.h>

#include "render/scene/shape.h"

/* `radius` is at p0. `inner` is the change of radius per unit length. */
static double radius_at(const aur_shape *shape, double z) {
    return fmax(0.0, (double)shape->radius + z * (double)shape->inner);
}

static void bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    (void)primitive;
    const aur_vector end = aur_vector_add_scaled(shape->center, shape->length, shape->axis[2]);
    const double ends[2][3] = {{shape->center.x, shape->center.y, shape->center.z}, {end.x, end.y, end.z}};
    const double along[3] = {shape->axis[2].x, shape->axis[2].y, shape->axis[2].z};
    for (size_t i = 0; i < 3; ++i) {
        const double part = sqrt(fmax(0.0, 1.0 - along[i] * along[i]));
        const double half[2] = {part * radius_at(shape, 0.0), part * radius_at(shape, (double)shape->length)};
        lower[i] = fmin(ends[0][i] - half[0], ends[1][i] - half[1]);
        upper[i] = fmax(ends[0][i] + half[0], ends[1][i] + half[1]);
    }
}

/* The roots of a t^2 + 2 b t + c in ascending order, for any a including 0. Returns their number. */
static size_t find_roots(double a, double b, double c, double roots[2]) {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0))
        return 0;
    const double q = -(b + copysign(sqrt(discriminant), b));
    if (a == 0.0 || q == 0.0) {
        roots[0] = a == 0.0 ? c / q : 0.0;
        return isfinite(roots[0]) ? 1 : 0;
    }
    roots[0] = fmin(q / a, c / q);
    roots[1] = fmax(q / a, c / q);
    return 2;
}

static bool intersect(const aur_shape *shape, const double origin[3], const double direction[3],
                      double nearest, double farthest, double *distance) {
    const double offset[3] = {origin[0] - (double)shape->center.x, origin[1] - (double)shape->center.y,
                              origin[2] - (double)shape->center.z};
    const double slope = shape->inner, radius = shape->radius, length = shape->length;
    const double ox = aur_shape_dot(offset, shape->axis[0]), oy = aur_shape_dot(offset, shape->axis[1]),
                 oz = aur_shape_dot(offset, shape->axis[2]);
    const double dx = aur_shape_dot(direction, shape->axis[0]), dy = aur_shape_dot(direction, shape->axis[1]),
                 dz = aur_shape_dot(direction, shape->axis[2]);
    const double reach = radius + slope * oz, grows = slope * dz;
    double roots[2];
    const size_t count = find_roots(dx * dx + dy * dy - grows * grows, ox * dx + oy * dy - reach * grows,
                                    ox * ox + oy * oy - reach * reach, roots);
    for (size_t i = 0; i < count; ++i) {
        const double z = oz + roots[i] * dz; /* between the ends there is no second nappe of the cone */
        *distance = roots[i];
        if (z >= 0.0 && z <= length && roots[i] > nearest && roots[i] < farthest)
            return true;
    }
    return false;
}

/* The fraction of the area below a height: the second texture coordinate. */
static float area_below(const aur_shape *shape, float z) {
    const float first = shape->radius, last = first + shape->inner * shape->length;
    const float radius = first + shape->inner * z;
    return z / shape->length * (radius + first) / (last + first);
}

/* Computed in doubles, and moved onto the cone that rays intersect, as the stored axes are rounded. */
static aur_vector point_of(const aur_shape *shape, aur_vector outwards, float z) {
    const double radius = radius_at(shape, (double)z), height = z;
    const aur_vector along = shape->axis[2];
    const double way[3] = {radius * (double)outwards.x + height * (double)along.x,
                           radius * (double)outwards.y + height * (double)along.y,
                           radius * (double)outwards.z + height * (double)along.z};
    const double x = aur_shape_dot(way, shape->axis[0]), y = aur_shape_dot(way, shape->axis[1]);
    const double more = radius_at(shape, aur_shape_dot(way, along)) - sqrt(x * x + y * y);
    return (aur_vector){(float)((double)shape->center.x + way[0] + more * (double)outwards.x),
                        (float)((double)shape->center.y + way[1] + more * (double)outwards.y),
                        (float)((double)shape->center.z + way[2] + more * (double)outwards.z)};
}

static aur_shape_point point_at(const aur_shape *shape, float cosine, float sine, float z) {
    const float slope = shape->inner, scale = 1.0f / sqrtf(1.0f + slope * slope);
    const aur_vector outwards =
        aur_vector_add_scaled(aur_vector_scale(shape->axis[0], cosine), sine, shape->axis[1]);
    const aur_vector normal =
        aur_vector_scale(aur_vector_add_scaled(outwards, -slope, shape->axis[2]), scale);
    aur_shape_point point = {.texture = {.u = aur_shape_azimuth(cosine, sine), .v = area_below(shape, z)}};
    aur_round_point(point_of(shape, outwards, z), aur_vector_scale(normal, shape->flipped ? -1.0f : 1.0f),
                    aur_coordinate_sum(shape->center) + shape->radius + fabsf(z), &point);
    return point;
}

static void surface(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]) {
    (void)hit;
    const aur_vector way = aur_vector_subtract(position, shape->center);
    const float x = aur_vector_dot(way, shape->axis[0]), y = aur_vector_dot(way, shape->axis[1]);
    const float size = fmaxf(hypotf(x, y), 1e-30f), turn = 2.0f * AUR_PI_F;
    const float mean = shape->radius + 0.5f * shape->inner * shape->length;
    *point = point_at(shape, x / size, y / size, aur_vector_dot(way, shape->axis[2]));
    if (tangents == NULL)
        return;
    tangents[0] =
        aur_vector_add_scaled(aur_vector_scale(shape->axis[0], -turn * y), turn * x, shape->axis[1]);
    const aur_vector outwards =
        aur_vector_add_scaled(aur_vector_scale(shape->axis[0], x / size), y / size, shape->axis[1]);
    tangents[1] = aur_vector_scale(aur_vector_add_scaled(shape->axis[2], shape->inner, outwards),
                                   shape->length * mean / size);
}

/* Uniform by area: the squared radius is uniform between its values at the ends. */
static aur_shape_point sample(const aur_shape *shape, float u, float v) {
    const float angle = 2.0f * AUR_PI_F * u;
    const float first = shape->radius, last = first + shape->inner * shape->length;
    const float radius = sqrtf(first * first + v * (last * last - first * first));
    /* z / length = (radius - first) / (last - first), in a form that is stable for equal radii */
    const float z = v * (last + first) / (radius + first) * shape->length;
    return point_at(shape, cosf(angle), sinf(angle), fminf(z, shape->length));
}

static const aur_curved curved = {bounds, intersect, surface, sample, NULL, NULL, NULL, NULL};

typedef struct cone_keys {
    double p0[3], p1[3], radius0, radius1;
} cone_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_VECTOR(cone_keys, "p0", p0, -AUR_REACH, AUR_REACH, "0 0 0", "one end of its axis")},
    {AUR_KEY_OF_VECTOR(cone_keys, "p1", p1, -AUR_REACH, AUR_REACH, "0 0 1", "the other end")},
    {AUR_KEY_OF_REAL(cone_keys, "radius0", radius0, 0.0, AUR_REACH, "1", "its radius at p0")},
    {AUR_KEY_OF_REAL(cone_keys, "radius1", radius1, 0.0, AUR_REACH, "0", "its radius at p1")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    cone_keys p;
    double scale;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_similarity(input, &scale, error);
    if (result != AUR_OK)
        return result;
    aur_transform_point(&input->to_world, p.p0, shape->position);
    const aur_vector way = aur_transform_direction_f(
        &input->to_world,
        (aur_vector){(float)(p.p1[0] - p.p0[0]), (float)(p.p1[1] - p.p0[1]), (float)(p.p1[2] - p.p0[2])});
    shape->length = aur_vector_length(way);
    if (!(shape->length > 0.0f) || !isfinite(shape->length))
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "'p0' and 'p1' must differ");
    if (!(p.radius0 + p.radius1 > 1.0 / AUR_REACH))
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT,
                                   "one of 'radius0' and 'radius1' must be above 0");
    const aur_frame frame = aur_frame_about(aur_vector_scale(way, 1.0f / shape->length));
    shape->axis[0] = frame.x;
    shape->axis[1] = frame.y;
    shape->axis[2] = frame.z;
    const double length = shape->length, first = p.radius0 * scale, last = p.radius1 * scale;
    shape->radius = (float)first;
    shape->inner = (float)((last - first) / length);
    shape->area = AUR_PI * (first + last) * hypot(length, last - first);
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_cone = {
    .row = {.name = "cone",
            .summary = "an open cone, or a truncated one, from `p0` to `p1`",
            AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create};
