/* Arithmetic of spherical rectangles for one point, without branches and calls, so that loops over it
 * vectorise. Operations are not contracted or reordered: all instruction sets give the same bits. */
#include "render/scene/lights/arcs.h"
#include "render/scene/lights/spherical_rectangle.h"
#include "render/scene/patches.h"

/* Loops over calls do not vectorise. */
#define AUR_ALWAYS_INLINE static inline __attribute__((always_inline))

/* Clamps a number to [0, 1]. Branch-free: comparisons would not vectorise. */
static inline float rectangle_part(float x) {
    const float positive = 0.5f * (x + fabsf(x));
    return 0.5f * (positive + 1.0f - fabsf(positive - 1.0f));
}

/* The nearest integer of a number below 2^22: vector code has no floorf that preserves the exception flags.
 */
static inline float rectangle_nearest(float x) {
    return (x + 0x1.8p23f) - 0x1.8p23f;
}

/* 1 for odd integers, else 0. */
static inline float rectangle_is_odd(float integer) {
    return fabsf(integer - 2.0f * rectangle_nearest(0.5f * integer));
}

/* Sine and cosine of an angle within -3 pi .. 3 pi, by Taylor series about the nearest multiple of pi / 2. */
AUR_ALWAYS_INLINE void rectangle_turn(float angle, float *sine, float *cosine) {
    const float quarter = rectangle_nearest(angle * (2.0f / AUR_PI_F));
    const float x = (angle - quarter * 1.57079637f) + quarter * 4.371139e-8f; /* pi / 2 in two parts */
    const float square = x * x;
    const float s =
        x * (1.0f + square * (-1.0f / 6.0f +
                              square * (1.0f / 120.0f + square * (-1.0f / 5040.0f + square / 362880.0f))));
    const float c =
        1.0f +
        square * (-0.5f + square * (1.0f / 24.0f + square * (-1.0f / 720.0f + square * (1.0f / 40320.0f))));
    const float odd = rectangle_is_odd(quarter);
    const float sign = 1.0f - 2.0f * rectangle_is_odd(0.5f * (quarter - odd)); /* -1 in quarters 2 and 3 */
    *sine = sign * (s + odd * (c - s));
    *cosine = sign * (c - odd * (c + s));
}

/* The rectangle in a frame at the reference point. */
typedef struct rectangle_view {
    float x0, y0, z0;
    float height;  /* of the rectangle's plane along its normal; z0 is negative */
    float squared; /* distance of the centre */
    float excess;  /* positive if it is sampled by solid angle */
} rectangle_view;

static inline rectangle_view rectangle_placed(const aur_rectangle *r, aur_vector normal, float px, float py,
                                              float pz) {
    const float wx = r->corner.x - px, wy = r->corner.y - py, wz = r->corner.z - pz;
    const float x0 = wx * r->x.x + wy * r->x.y + wz * r->x.z;
    const float y0 = wx * r->y.x + wy * r->y.y + wz * r->y.z;
    /* The derivation's frame has the rectangle's plane below the point. */
    const float height = wx * normal.x + wy * normal.y + wz * normal.z;
    const float z0 = -fabsf(height);
    const float middle_x = x0 + 0.5f * r->width, middle_y = y0 + 0.5f * r->height;
    const float squared = middle_x * middle_x + middle_y * middle_y + z0 * z0;
    return (rectangle_view){
        x0,     y0,      z0,
        height, squared, -z0 * r->width * r->height - AUR_LEAST_RECTANGLE * (squared * sqrtf(squared))};
}

/* Sets up the rectangle for a reference point; its solid angle is 0 if it is sampled by area. */
AUR_ALWAYS_INLINE aur_spherical_rectangle rectangle_seen(const aur_rectangle *r, aur_vector normal, float px,
                                                         float py, float pz) {
    const rectangle_view at = rectangle_placed(r, normal, px, py, pz);
    const float x0 = at.x0, y0 = at.y0, z0 = at.z0, zz = z0 * z0;
    const float x1 = x0 + r->width, y1 = y0 + r->height;
    /* z components of the normals of the four planes through the reference point and an edge. */
    const float n0 = -y0 / sqrtf(zz + y0 * y0), n1 = x1 / sqrtf(zz + x1 * x1);
    const float n2 = y1 / sqrtf(zz + y1 * y1), n3 = -x0 / sqrtf(zz + x0 * x0);
    const float k = 2.0f * AUR_PI_F - aur_arc(-n2 * n3) - aur_arc(-n3 * n0);
    const float angle = aur_arc(-n0 * n1) + aur_arc(-n1 * n2) - k;
    return (aur_spherical_rectangle){
        x0, x1, y0, y1, z0, n0, n2, k, angle * (0.5f + copysignf(0.5f, at.excess))};
}

/* The inverse of rectangle_point: the v of a point. */
static inline float rectangle_rank(const aur_spherical_rectangle *seen, float s, float t) {
    const float x = seen->x0 + s * (seen->x1 - seen->x0), y = seen->y0 + t * (seen->y1 - seen->y0);
    const float squared = x * x + seen->z0 * seen->z0;
    const float h0 = seen->y0 / sqrtf(squared + seen->y0 * seen->y0);
    const float h1 = seen->y1 / sqrtf(squared + seen->y1 * seen->y1);
    return rectangle_part((y / sqrtf(squared + y * y) - h0) / (h1 - h0));
}

/* And its u: the fraction of the solid angle to the left of the point. */
static inline float rectangle_strip(const aur_spherical_rectangle *seen, float s) {
    const float x = seen->x0 + s * (seen->x1 - seen->x0);
    const float n = x / sqrtf(x * x + seen->z0 * seen->z0);
    const float angle = aur_arc(-seen->b0 * n) + aur_arc(-n * seen->b1) - seen->k;
    return rectangle_part(angle / seen->solid_angle);
}

AUR_ALWAYS_INLINE void rectangle_point(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                       float *t) {
    float sine, cosine;
    rectangle_turn(u * seen->solid_angle + seen->k, &sine, &cosine);
    const float f = (cosine * seen->b0 - seen->b1) / sine;
    const float q = f * f + seen->b0 * seen->b0;
    const float x = copysignf(seen->z0, f) / sqrtf(fabsf(q - 1.0f) + 1e-12f);
    const float width = seen->x1 - seen->x0, height = seen->y1 - seen->y0;
    *s = rectangle_part((x - seen->x0) / width);
    const float inside = seen->x0 + *s * width;
    const float squared = inside * inside + seen->z0 * seen->z0;
    const float h0 = seen->y0 / sqrtf(squared + seen->y0 * seen->y0);
    const float h1 = seen->y1 / sqrtf(squared + seen->y1 * seen->y1);
    const float h = h0 + v * (h1 - h0);
    const float y = h * sqrtf(squared / (fabsf(1.0f - h * h) + 1e-9f));
    *t = rectangle_part((y - seen->y0) / height);
}

/* max(x, 0); comparisons would become branches. */
static inline float rectangle_positive(float x) {
    return 0.5f * (x + fabsf(x));
}

/* Sampling weights at the rectangle's corners: the cosine at the reference's normal, and for area sampling
 * also the inverse square falloff. Each is at least a small fraction of the mean, as the cosine may be
 * positive between corners where it is not. Without a normal all cosines are equal. */
static inline aur_bilinear rectangle_weights(const aur_rectangle *r, const rectangle_view *at,
                                             aur_vector across, aur_vector facing, bool by_area) {
    const float nx = aur_vector_dot(facing, r->x), ny = aur_vector_dot(facing, r->y);
    const float up = at->height * aur_vector_dot(facing, across);
    const float x[2] = {at->x0, at->x0 + r->width}, y[2] = {at->y0, at->y0 + r->height};
    aur_bilinear weights;
    float sum = 0.0f;
    for (size_t i = 0; i < 4; ++i) {
        const float px = x[i & 1], py = y[i >> 1];
        const float squared = px * px + py * py + at->z0 * at->z0;
        /* A reference at a corner has no direction to it. */
        const float scale = at->squared / (squared + 0.015625f * at->squared);
        const float cosine = rectangle_positive(nx * px + ny * py + up) / sqrtf(squared + 1e-30f);
        weights.corner[i] = by_area ? cosine * scale * sqrtf(scale) : cosine;
        sum += weights.corner[i];
    }
    const float least = 0.0125f * sum + 1e-6f;
    for (size_t i = 0; i < 4; ++i)
        weights.corner[i] = least + rectangle_positive(weights.corner[i] - least);
    return weights;
}

static void rectangle_lanes(const aur_rectangle_light *given, const aur_light_references *references,
                            const float *u, const float *v, aur_light_lanes *drawn) {
    const aur_lane_vectors *const reference = references->position, *const facing = references->normal;
    const aur_rectangle_light light = *given; /* outputs must not alias these */
    const aur_rectangle *const r = &light.rectangle;
    aur_lane_numbers s = {0}, t = {0}, angle = {0}, moved_u, moved_v, density;
    const aur_vector normal = aur_vector_cross(r->x, r->y);
    uint32_t any = 0; /* sampled by solid angle */
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const rectangle_view at =
            rectangle_placed(r, normal, reference->x[k], reference->y[k], reference->z[k]);
        const aur_bilinear weights =
            rectangle_weights(r, &at, normal, aur_lane_vector(facing, k), !(at.excess > 0.0f));
        float moved[2] = {u[k], v[k]};
        aur_bilinear_draw(&weights, &moved[0], &moved[1]);
        moved_u[k] = moved[0];
        moved_v[k] = moved[1];
        any |= (uint32_t)(at.excess > 0.0f);
        density[k] = aur_bilinear_density(&weights, moved[0], moved[1]);
    }
    if (any != 0) {
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const aur_spherical_rectangle seen =
                rectangle_seen(r, normal, reference->x[k], reference->y[k], reference->z[k]);
            rectangle_point(&seen, moved_u[k], moved_v[k], &s[k], &t[k]);
            angle[k] = seen.solid_angle;
        }
    }
    const aur_vector x = aur_vector_scale(r->x, r->width), y = aur_vector_scale(r->y, r->height);
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const bool seen = angle[k] > 0.0f;
        const float along_x = seen ? s[k] : moved_u[k], along_y = seen ? t[k] : moved_v[k];
        const aur_vector point =
            aur_vector_add_scaled(aur_vector_add_scaled(r->corner, along_x, x), along_y, y);
        const aur_vector from = aur_lane_vector(reference, k);
        const aur_vector way = aur_vector_subtract(from, point);
        const float height = aur_vector_dot(way, light.normal), squared = aur_vector_dot(way, way);
        const float by_area = squared * sqrtf(squared) / (height * light.area);
        const float by_angle = 1.0f / angle[k];
        const float pdf = density[k] * (seen ? by_angle : by_area);
        aur_lane_set(&drawn->position, k, aur_surface_target(from, point, light.normal, light.rounding));
        aur_lane_set(&drawn->radiance, k, light.radiance);
        drawn->pdf[k] = height > 0.0f ? pdf : 0.0f;
        drawn->reachable[k] = 1.0f;
    }
}

static inline aur_rectangle rectangle_of_lane(const aur_rectangle_lanes *lights, size_t k) {
    return (aur_rectangle){aur_lane_vector(&lights->corner, k), aur_lane_vector(&lights->x, k),
                           aur_lane_vector(&lights->y, k), lights->width[k], lights->height[k]};
}

/* Points on the rectangles, as fractions of width and height, and their pdfs (aur_seen_rectangle_draw).
 * `angle` is the solid angle, or not above 0 if the rectangle is sampled by area. */
static void rectangle_points(const aur_rectangle_lanes *lights, const aur_light_references *references,
                             aur_lane_numbers s, aur_lane_numbers t, aur_lane_numbers angle,
                             aur_lane_numbers density) {
    const aur_lane_vectors *const from = references->position, *const facing = references->normal;
    aur_lane_numbers x, y;
    uint32_t any = 0;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_rectangle r = rectangle_of_lane(lights, k);
        const rectangle_view at =
            rectangle_placed(&r, aur_vector_cross(r.x, r.y), from->x[k], from->y[k], from->z[k]);
        any |= (uint32_t)(at.excess > 0.0f);
        angle[k] = at.excess;
    }
    if (any != 0) {
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const aur_rectangle r = rectangle_of_lane(lights, k);
            const aur_spherical_rectangle seen =
                rectangle_seen(&r, aur_vector_cross(r.x, r.y), from->x[k], from->y[k], from->z[k]);
            angle[k] = angle[k] > 0.0f ? seen.solid_angle : 0.0f;
        }
    }
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_rectangle r = rectangle_of_lane(lights, k);
        const aur_vector across = aur_vector_cross(r.x, r.y);
        const rectangle_view at = rectangle_placed(&r, across, from->x[k], from->y[k], from->z[k]);
        const aur_bilinear weights =
            rectangle_weights(&r, &at, across, aur_lane_vector(facing, k), !(angle[k] > 0.0f));
        float moved[2] = {s[k], t[k]};
        aur_bilinear_draw(&weights, &moved[0], &moved[1]);
        s[k] = moved[0];
        t[k] = moved[1];
        density[k] = aur_bilinear_density(&weights, moved[0], moved[1]);
    }
    if (any == 0)
        return;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_rectangle r = rectangle_of_lane(lights, k);
        const aur_spherical_rectangle seen =
            rectangle_seen(&r, aur_vector_cross(r.x, r.y), from->x[k], from->y[k], from->z[k]);
        rectangle_point(&seen, s[k], t[k], &x[k], &y[k]);
    }
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const bool by_angle = angle[k] > 0.0f;
        s[k] = by_angle ? x[k] : s[k];
        t[k] = by_angle ? y[k] : t[k];
    }
}

static void rectangle_lanes_each(const aur_rectangle_lanes *given, const aur_light_references *references,
                                 const float *u, const float *v, aur_light_lanes *drawn) {
    const aur_rectangle_lanes lights = *given; /* outputs must not alias these */
    aur_lane_numbers s, t, angle, density, lit;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        s[k] = u[k];
        t[k] = v[k];
    }
    rectangle_points(&lights, references, s, t, angle, density);
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_rectangle r = rectangle_of_lane(&lights, k);
        const aur_vector from = aur_lane_vector(references->position, k);
        const aur_vector normal = aur_lane_vector(&lights.normal, k);
        const aur_vector along = aur_vector_add_scaled(r.corner, s[k] * r.width, r.x);
        const aur_vector point = aur_vector_add_scaled(along, t[k] * r.height, r.y);
        const aur_vector way = aur_vector_subtract(point, from);
        const float squared = aur_vector_dot(way, way), scale = 1.0f / sqrtf(squared);
        const aur_vector direction = aur_vector_scale(way, scale);
        const float cosine = -aur_vector_dot(direction, normal);
        const float by_area = density[k] * squared / (cosine * lights.area[k]);
        const float by_angle = density[k] / angle[k];
        const float pdf = angle[k] > 0.0f ? by_angle : by_area;
        const float finite = fabsf(pdf) < INFINITY ? pdf : 0.0f, faced = cosine > 0.0f ? finite : 0.0f;
        lit[k] = squared > 0.0f ? faced : 0.0f;
        aur_lane_set(&drawn->position, k, aur_surface_target(from, point, normal, lights.rounding[k]));
        aur_lane_set(&drawn->direction, k, direction);
        drawn->reachable[k] = 1.0f;
    }
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        drawn->pdf[k] = lit[k];
        aur_lane_set(&drawn->radiance, k, aur_lane_vector(&lights.radiance, k));
    }
}

const aur_rectangle_kernels AUR_KERNEL(aur_rectangle_kernels) = {rectangle_lanes, rectangle_lanes_each};

#if !AUR_KERNEL_WIDE

bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference,
                                    aur_spherical_rectangle *seen) {
    const aur_vector normal = aur_vector_cross(rectangle->x, rectangle->y);
    if (!(rectangle_placed(rectangle, normal, reference.x, reference.y, reference.z).excess > 0.0f))
        return false;
    *seen = rectangle_seen(rectangle, normal, reference.x, reference.y, reference.z);
    return seen->solid_angle > 0.0f;
}

void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t) {
    rectangle_point(seen, u, v, s, t);
}

aur_seen_rectangle aur_rectangle_see(const aur_rectangle *rectangle, const aur_light_reference *reference) {
    const aur_vector across = aur_vector_cross(rectangle->x, rectangle->y), p = reference->position;
    aur_seen_rectangle seen = {.by_area = !aur_spherical_rectangle_create(rectangle, p, &seen.sphere)};
    const rectangle_view at = rectangle_placed(rectangle, across, p.x, p.y, p.z);
    seen.weights = rectangle_weights(rectangle, &at, across, reference->normal, seen.by_area);
    return seen;
}

float aur_seen_rectangle_draw(const aur_seen_rectangle *seen, float u, float v, float *s, float *t) {
    *s = u;
    *t = v;
    aur_bilinear_draw(&seen->weights, s, t);
    const float density = aur_bilinear_density(&seen->weights, *s, *t);
    if (seen->by_area)
        return density;
    rectangle_point(&seen->sphere, *s, *t, s, t);
    return density / seen->sphere.solid_angle;
}

float aur_seen_rectangle_density(const aur_seen_rectangle *seen, float s, float t) {
    if (seen->by_area)
        return aur_bilinear_density(&seen->weights, s, t);
    const aur_spherical_rectangle *const sphere = &seen->sphere;
    return aur_bilinear_density(&seen->weights, rectangle_strip(sphere, s), rectangle_rank(sphere, s, t)) /
           sphere->solid_angle;
}

#endif
