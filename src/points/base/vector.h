/* Small float vectors for rays, radiance and frames. Everything is by value. */
#pragma once

#include <math.h>
#include <stdint.h>

#define AUR_PI 3.14159265358979323846
#define AUR_PI_F 3.14159265358979323846f

/* A point, a direction or an RGB colour. */
typedef struct aur_vector {
    float x, y, z;
} aur_vector;

static inline aur_vector aur_vector_add(aur_vector a, aur_vector b) {
    return (aur_vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline aur_vector aur_vector_subtract(aur_vector a, aur_vector b) {
    return (aur_vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline void aur_vector_to_doubles(aur_vector a, double d[3]) {
    d[0] = (double)a.x;
    d[1] = (double)a.y;
    d[2] = (double)a.z;
}

static inline aur_vector aur_vector_scale(aur_vector a, float s) {
    return (aur_vector){a.x * s, a.y * s, a.z * s};
}

/* Component by component: colours. */
static inline aur_vector aur_vector_multiply(aur_vector a, aur_vector b) {
    return (aur_vector){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* a + s * b */
static inline aur_vector aur_vector_add_scaled(aur_vector a, float s, aur_vector b) {
    return (aur_vector){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline float aur_vector_dot(aur_vector a, aur_vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The same of the absolute values of the components. */
static inline float aur_vector_dot_absolute(aur_vector a, aur_vector b) {
    return fabsf(a.x * b.x) + fabsf(a.y * b.y) + fabsf(a.z * b.z);
}

static inline aur_vector aur_vector_cross(aur_vector a, aur_vector b) {
    return (aur_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float aur_vector_length(aur_vector a) {
    return sqrtf(aur_vector_dot(a, a));
}

/* Which side of a cube about the origin the vector goes through: +x, -x, +y, -y, +z, -z are 0 to 5. */
static inline uint32_t aur_vector_facing(aur_vector a) {
    const float x = fabsf(a.x), y = fabsf(a.y), z = fabsf(a.z);
    if (x >= y && x >= z)
        return a.x < 0.0f ? 1 : 0;
    if (y >= z)
        return a.y < 0.0f ? 3 : 2;
    return a.z < 0.0f ? 5 : 4;
}

/* The zero vector is unchanged. */
static inline aur_vector aur_vector_normalize(aur_vector a) {
    const float length = aur_vector_length(a);
    return length > 0.0f ? aur_vector_scale(a, 1.0f / length) : a;
}

/* The larger, and b when either is NaN: one instruction, where fmaxf is a call. */
static inline float aur_larger(float a, float b) {
    return a > b ? a : b;
}

static inline float aur_smaller(float a, float b) {
    return a < b ? a : b;
}

/* Component by component. */
static inline aur_vector aur_vector_larger(aur_vector a, aur_vector b) {
    return (aur_vector){aur_larger(a.x, b.x), aur_larger(a.y, b.y), aur_larger(a.z, b.z)};
}

static inline aur_vector aur_vector_smaller(aur_vector a, aur_vector b) {
    return (aur_vector){aur_smaller(a.x, b.x), aur_smaller(a.y, b.y), aur_smaller(a.z, b.z)};
}

static inline float aur_vector_max(aur_vector a) {
    return aur_larger(a.x, aur_larger(a.y, a.z));
}

static inline int aur_vector_is_zero(aur_vector a) {
    return a.x == 0.0f && a.y == 0.0f && a.z == 0.0f;
}

static inline int aur_vector_is_finite(aur_vector a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* An orthonormal right-handed frame: z is the normal or lobe axis. */
typedef struct aur_frame {
    aur_vector x, y, z;
} aur_frame;

/* A frame about a unit vector, without a branch or a trigonometric function (Duff et al. 2017). */
static inline aur_frame aur_frame_about(aur_vector n) {
    const float sign = copysignf(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return (aur_frame){
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

static inline aur_vector aur_frame_to_world(const aur_frame *frame, aur_vector v) {
    aur_vector w = aur_vector_scale(frame->x, v.x);
    w = aur_vector_add_scaled(w, v.y, frame->y);
    return aur_vector_add_scaled(w, v.z, frame->z);
}

static inline aur_vector aur_frame_to_local(const aur_frame *frame, aur_vector v) {
    return (aur_vector){aur_vector_dot(frame->x, v), aur_vector_dot(frame->y, v),
                        aur_vector_dot(frame->z, v)};
}
