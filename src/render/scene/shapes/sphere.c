/* The sphere, facing outwards. */
#include "render/scene/materials/sampling.h"
#include "render/scene/shape.h"

static void bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    (void)primitive;
    const double center[3] = {shape->center.x, shape->center.y, shape->center.z};
    for (size_t i = 0; i < 3; ++i) {
        lower[i] = center[i] - (double)shape->radius;
        upper[i] = center[i] + (double)shape->radius;
    }
}

static bool intersect(const aur_shape *shape, const double origin[3], const double direction[3],
                      double nearest, double farthest, double *distance) {
    const double offset[3] = {origin[0] - (double)shape->center.x, origin[1] - (double)shape->center.y,
                              origin[2] - (double)shape->center.z};
    const double radius = shape->radius;
    double a = 0.0, b = 0.0, c = -radius * radius;
    for (size_t i = 0; i < 3; ++i) {
        a += direction[i] * direction[i];
        b += direction[i] * offset[i];
        c += offset[i] * offset[i];
    }
    return aur_first_root(a, b, c, nearest, farthest, distance);
}

/* The point with this normal before flipping, relative to the centre. Computed in doubles, so that points are
 * accurate on spheres much larger than other objects. */
static aur_vector point_of(const aur_shape *shape, aur_vector normal) {
    const double n[3] = {normal.x, normal.y, normal.z};
    const double squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const double scale = squared > 0.0 ? (double)shape->radius / sqrt(squared) : 0.0;
    return (aur_vector){(float)((double)shape->center.x + scale * n[0]),
                        (float)((double)shape->center.y + scale * n[1]),
                        (float)((double)shape->center.z + scale * n[2])};
}

static aur_bsdf_point texture_at(const aur_shape *shape, aur_vector normal) {
    const float x = aur_vector_dot(normal, shape->axis[0]);
    const float y = aur_vector_dot(normal, shape->axis[1]);
    const float z = aur_vector_dot(normal, shape->axis[2]);
    return (aur_bsdf_point){.u = aur_shape_azimuth(x, y),
                            .v = acosf(fminf(fmaxf(z, -1.0f), 1.0f)) / AUR_PI_F};
}

/* The point with this unit normal before flipping. */
static aur_shape_point point_at(const aur_shape *shape, aur_vector normal, bool textured) {
    aur_shape_point point = {.texture = textured ? texture_at(shape, normal) : (aur_bsdf_point){0}};
    aur_round_point(point_of(shape, normal), aur_vector_scale(normal, shape->flipped ? -1.0f : 1.0f),
                    aur_coordinate_sum(shape->center) + shape->radius, &point);
    return point;
}

static void surface(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]) {
    (void)hit;
    const aur_vector normal = aur_vector_normalize(aur_vector_subtract(position, shape->center));
    *point = point_at(shape, normal, true);
    if (tangents == NULL)
        return;
    /* The axes of a mirrored sphere are left-handed. */
    const float x = aur_vector_dot(normal, shape->axis[0]), y = aur_vector_dot(normal, shape->axis[1]);
    const float z = aur_vector_dot(normal, shape->axis[2]), across = hypotf(x, y);
    const float around = 2.0f * AUR_PI_F * shape->radius, down = AUR_PI_F * shape->radius;
    tangents[0] =
        aur_vector_add_scaled(aur_vector_scale(shape->axis[0], -around * y), around * x, shape->axis[1]);
    const float cosine = across > 0.0f ? x / across : 1.0f, sine = across > 0.0f ? y / across : 0.0f;
    tangents[1] = aur_vector_add_scaled(aur_vector_scale(shape->axis[0], down * z * cosine), down * z * sine,
                                        shape->axis[1]);
    tangents[1] = aur_vector_add_scaled(tangents[1], -down * across, shape->axis[2]);
}

static aur_shape_point sample(const aur_shape *shape, float u, float v) {
    return point_at(shape, aur_sample_sphere(u, v), true);
}

/* 1 - cos of the sphere's half angle; 2 from inside. A sphere that faces inwards is seen only from inside,
 * even from its surface points that rounding moved outside. */
static float seen_cap(const aur_shape *shape, aur_vector reference) {
    if (shape->flipped)
        return 2.0f;
    const aur_vector way = aur_vector_subtract(shape->center, reference);
    const float ratio = shape->radius * shape->radius / aur_vector_dot(way, way);
    return ratio < 1.0f ? ratio / (1.0f + sqrtf(1.0f - ratio)) : 2.0f;
}

static float pdf_seen(const aur_shape *shape, aur_vector reference) {
    const float cap = seen_cap(shape, reference);
    return cap < 2.0f ? 1.0f / (2.0f * AUR_PI_F * cap) : 0.0f;
}

/* Samples a direction uniformly in the cone that the sphere subtends. */
static bool sample_seen(const aur_shape *shape, aur_vector reference, float u, float v, bool textured,
                        aur_shape_point *point, float *pdf) {
    const float cap = seen_cap(shape, reference);
    if (!(cap < 2.0f))
        return false;
    const aur_vector way = aur_vector_subtract(shape->center, reference);
    const float distance = aur_vector_length(way);
    const float above = u * cap; /* 1 - cos of the angle to the centre */
    const float cosine = 1.0f - above;
    const float sine_squared = above * (2.0f - above);
    const float inside = shape->radius * shape->radius - distance * distance * sine_squared;
    const float near_distance = distance * cosine - sqrtf(fmaxf(inside, 0.0f));
    const float sine = sqrtf(fmaxf(sine_squared, 0.0f));
    const float angle = 2.0f * AUR_PI_F * v;
    const aur_frame frame = aur_frame_about(aur_vector_scale(way, 1.0f / distance));
    const aur_vector direction =
        aur_frame_to_world(&frame, (aur_vector){sine * cosf(angle), sine * sinf(angle), cosine});
    const aur_vector position = aur_vector_add_scaled(reference, near_distance, direction);
    *point = point_at(shape, aur_vector_normalize(aur_vector_subtract(position, shape->center)), textured);
    *pdf = 1.0f / (2.0f * AUR_PI_F * cap);
    return true;
}

static void equal_area(const aur_hit *hit, float coordinates[2]) {
    (void)hit;
    coordinates[1] = 0.5f - 0.5f * cosf(AUR_PI_F * coordinates[1]);
}

static const aur_curved curved = {bounds,      intersect, surface,    sample,
                                  sample_seen, pdf_seen,  equal_area, NULL};

typedef struct sphere_keys {
    double center[3], radius;
} sphere_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_VECTOR(sphere_keys, "center", center, -AUR_REACH, AUR_REACH, "0 0 0", "its centre")},
    {AUR_KEY_OF_REAL(sphere_keys, "radius", radius, 1.0 / AUR_REACH, AUR_REACH, "1", "its radius")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    sphere_keys p;
    double scale;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_similarity(input, &scale, error);
    if (result != AUR_OK)
        return result;
    aur_transform_point(&input->to_world, p.center, shape->position);
    shape->radius = (float)(p.radius * scale);
    for (size_t i = 0; i < 3; ++i) {
        const aur_vector axis = {i == 0, i == 1, i == 2};
        shape->axis[i] = aur_vector_normalize(aur_transform_direction_f(&input->to_world, axis));
    }
    shape->area = 4.0 * AUR_PI * (double)shape->radius * (double)shape->radius;
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_sphere = {
    .row = {.name = "sphere", .summary = "a sphere of `center` and `radius`", AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create};
