/* Hair and other thin curves, as in Mitsuba 3. Embree intersects them, from outside only. */
#include <stdlib.h>

#include "points/base/array.h"
#include "render/scene/shapes/mesh_file.h"

/* --- the centreline of a segment */

/* The centreline at a curve parameter, and its derivatives. */
typedef struct middle_line {
    aur_vector center, slope, bend; /* second derivative */
    float radius, growth;
} middle_line;

/* A weighted sum of the segment's control points. */
static aur_vector sum_points(const aur_curves *curves, const float *point, const float *weight,
                             float *radius) {
    aur_vector sum = {0};
    *radius = 0.0f;
    for (size_t i = 0; i < (curves->smooth ? 4u : 2u); ++i, point += 4) {
        sum = aur_vector_add_scaled(sum, weight[i], (aur_vector){point[0], point[1], point[2]});
        *radius += weight[i] * point[3];
    }
    return sum;
}

/* The uniform cubic B-spline (de Boor 1972), or a linear segment. */
static middle_line middle_at(const aur_curves *curves, size_t segment, float u) {
    const float v = 1.0f - u, sixth = 1.0f / 6.0f;
    const float spline[3][4] = {
        {sixth * v * v * v, sixth * (3.0f * u * u * u - 6.0f * u * u + 4.0f),
         sixth * (3.0f * v * v * v - 6.0f * v * v + 4.0f), sixth * u * u * u},
        {-0.5f * v * v, 1.5f * u * u - 2.0f * u, 2.0f * v - 1.5f * v * v, 0.5f * u * u},
        {v, 3.0f * u - 2.0f, 3.0f * v - 2.0f, u}};
    const float line[3][4] = {{v, u}, {-1.0f, 1.0f}, {0.0f, 0.0f}};
    const float(*const weight)[4] = curves->smooth ? spline : line;
    const float *const point = &curves->points[4 * (size_t)curves->firsts[segment]];
    middle_line at;
    float unused;
    at.center = sum_points(curves, point, weight[0], &at.radius);
    at.slope = sum_points(curves, point, weight[1], &at.growth);
    at.bend = sum_points(curves, point, weight[2], &unused);
    return at;
}

static void bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]) {
    const aur_curves *const curves = &shape->curves;
    const float *const point = &curves->points[4 * (size_t)curves->firsts[primitive]];
    for (size_t k = 0; k < 3; ++k) {
        lower[k] = HUGE_VAL;
        upper[k] = -HUGE_VAL;
        for (size_t i = 0; i < (curves->smooth ? 4u : 2u); ++i) {
            lower[k] = fmin(lower[k], (double)point[4 * i + k] - (double)point[4 * i + 3]);
            upper[k] = fmax(upper[k], (double)point[4 * i + k] + (double)point[4 * i + 3]);
        }
    }
}

/* The normal. For a rounded cone it is that of the sphere which touches it there. For a spline with
 * centreline C, whose circles are perpendicular to it: with the unit d from C to the point, d + a C' is
 * perpendicular to the tangent along the curve, C' + r' d + r d', where d' C' = -d C''. So a = -r' / (C'^2 -
 * r d C''). */
static aur_vector normal_of(const aur_curves *curves, const middle_line *middle, aur_vector away) {
    if (!curves->smooth)
        return away;
    const float along = aur_vector_dot(middle->slope, middle->slope);
    const float across = along - middle->radius * aur_vector_dot(away, middle->bend);
    if (!(fabsf(across) > 1e-6f * along))
        return away;
    return aur_vector_normalize(aur_vector_add_scaled(away, -middle->growth / across, middle->slope));
}

/* Texture coordinates: around the centreline, from the direction perpendicular to it and z; and along all
 * segments of the shape. */
static void surface(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]) {
    const aur_curves *const curves = &shape->curves;
    const middle_line middle = middle_at(curves, hit->primitive, hit->u);
    const aur_vector away = aur_vector_normalize(aur_vector_subtract(position, middle.center));
    const aur_vector along = aur_vector_normalize(middle.slope);
    const bool upright = along.x * along.x + along.y * along.y < 1e-11f; /* up to rounding */
    const aur_vector side = upright ? (aur_vector){along.z < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f}
                                    : aur_vector_normalize((aur_vector){-along.y, along.x, 0.0f});
    const float x = aur_vector_dot(away, side), y = aur_vector_dot(away, aur_vector_cross(along, side));
    const aur_vector normal = normal_of(curves, &middle, away);
    *point =
        (aur_shape_point){.position = position,
                          .normal = aur_vector_scale(normal, shape->flipped ? -1.0f : 1.0f),
                          .texture = {.u = aur_shape_azimuth(x, y),
                                      .v = ((float)hit->primitive + hit->u) / (float)curves->segment_count},
                          .offset = aur_surface_offset(position, normal)};
    if (tangents == NULL)
        return;
    /* Derivatives of C + r d. d rotates with the centreline and, where that bends sideways, with the
     * direction perpendicular to it and z. */
    const aur_vector around = aur_vector_cross(along, away), slope = middle.slope, bend = middle.bend;
    const float squared = aur_vector_dot(slope, slope), flat = slope.x * slope.x + slope.y * slope.y;
    const float turn = upright ? 0.0f : along.z * (slope.x * bend.y - slope.y * bend.x) / flat;
    aur_vector continuation = aur_vector_add_scaled(slope, middle.growth, away);
    continuation =
        aur_vector_add_scaled(continuation, -middle.radius * aur_vector_dot(away, bend) / squared, slope);
    continuation = aur_vector_add_scaled(continuation, middle.radius * turn, around);
    tangents[0] = aur_vector_scale(around, 2.0f * AUR_PI_F * middle.radius);
    tangents[1] = aur_vector_scale(continuation, (float)curves->segment_count);
}

static void equal_area(const aur_hit *hit, float coordinates[2]) {
    coordinates[1] = hit->u;
}

/* Lateral area of a segment, without caps: circumference times slope, at eight parameters. */
static double area(const aur_shape *shape, size_t primitive) {
    enum { SAMPLES = 8 };
    double sum = 0.0;
    for (size_t i = 0; i < SAMPLES; ++i) {
        const middle_line middle = middle_at(&shape->curves, primitive, ((float)i + 0.5f) / SAMPLES);
        sum += (double)middle.radius * hypot((double)aur_vector_length(middle.slope), (double)middle.growth);
    }
    return 2.0 * AUR_PI * sum / SAMPLES;
}

static const aur_curved curved = {bounds, NULL, surface, NULL, NULL, NULL, equal_area, area};

/* --- curve files */

typedef struct reader {
    aur_mesh_file file;
    const aur_transform *to_world;
    aur_curves *curves;
    size_t place_capacity, point_capacity, segment_capacity;
    size_t length; /* control points of the current curve */
} reader;

/* Parses "x y z radius", and adds the segment that it completes. `to_world` transforms only positions. */
static aur_result read_point(reader *self) {
    aur_curves *const curves = self->curves;
    if (!aur_array_reserve(&curves->positions, &self->place_capacity, curves->point_count + 1,
                           3 * sizeof(double)) ||
        !aur_array_reserve(&curves->points, &self->point_capacity, curves->point_count + 1,
                           4 * sizeof(float)) ||
        !aur_array_reserve(&curves->firsts, &self->segment_capacity, curves->segment_count + 1,
                           sizeof(uint32_t)))
        return aur_fail_memory(self->file.error);
    double value[4];
    for (size_t i = 0; i < 4; ++i)
        if (!aur_scan_double(&self->file.scanner, &value[i]))
            return aur_mesh_file_fail(&self->file, "expected a point 'x y z radius'");
    if (!(fabs(value[0]) + fabs(value[1]) + fabs(value[2]) <= 1e30) || !(value[3] >= 0.0 && value[3] <= 1e30))
        return aur_mesh_file_fail(&self->file,
                                  "a coordinate is not finite, or beyond 1e30, or a radius is below 0");
    aur_transform_point(self->to_world, value, &curves->positions[3 * curves->point_count]);
    curves->points[4 * curves->point_count++ + 3] = (float)value[3];
    const size_t needed = curves->smooth ? 4 : 2;
    if (curves->point_count > UINT32_MAX)
        return aur_mesh_file_fail(&self->file, "more points than 32 bits can number");
    if (++self->length >= needed)
        curves->firsts[curves->segment_count++] = (uint32_t)(curves->point_count - needed);
    return AUR_OK;
}

/* Ends the current curve, if any: it must have a segment. */
static aur_result end_curve(reader *self) {
    const size_t needed = self->curves->smooth ? 4 : 2;
    if (self->length > 0 && self->length < needed)
        return aur_mesh_file_fail(&self->file, "a curve must have at least %zu points (found %zu)", needed,
                                  self->length);
    self->length = 0;
    return AUR_OK;
}

static aur_result read_curves(reader *self) {
    aur_scanner *const scanner = &self->file.scanner;
    aur_result result = AUR_OK;
    for (scanner->line = 1; result == AUR_OK && scanner->at < scanner->end; aur_scan_next_line(scanner)) {
        if (!aur_scan_line_done(scanner))
            result = read_point(self);
        else if (*scanner->at != '#')
            result = end_curve(self);
    }
    if (result == AUR_OK)
        result = end_curve(self);
    scanner->line = 0;
    if (result == AUR_OK && self->curves->segment_count == 0)
        result = aur_mesh_file_fail(&self->file, "no curve in this file");
    return result;
}

typedef struct curve_keys {
    const char *filename;
} curve_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(curve_keys, "filename", filename, NULL, "file, relative to the scene; required")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    curve_keys p = {0};
    aur_shape_file file;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_file_open(input, p.filename, &file, error);
    if (result != AUR_OK)
        return result;
    reader self = {
        .file = {.scanner = {file.data, file.data + file.size, 0}, .path = file.path, .error = error},
        .to_world = &input->to_world,
        .curves = &shape->curves};
    result = read_curves(&self);
    aur_shape_file_close(&file);
    return result;
}

static aur_result create_smooth(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    shape->curves.smooth = true;
    return create(input, shape, error);
}

const aur_shape_descriptor aur_shape_linearcurve = {
    .row = {.name = "linearcurve",
            .summary = "rounded cones from point to point: `filename` has a line `x y z radius` each, and "
                       "an empty line between curves",
            AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create};

const aur_shape_descriptor aur_shape_bsplinecurve = {
    .row = {.name = "bsplinecurve",
            .summary =
                "tubes about cubic B-splines: a file as for `linearcurve`, with four points or more a curve",
            AUR_ROW_KEYS(keys)},
    .curved = &curved,
    .create = create_smooth};
