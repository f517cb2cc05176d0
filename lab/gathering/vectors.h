/* Vectors and frames in float, in the arithmetic of the library: its images do not depend on who computes a
 * direction. */
#pragma once

#include <math.h>

#define LAB_PI 3.14159265358979323846

typedef struct lab_vector {
    float x, y, z;
} lab_vector;

/* Orthonormal; z is the axis of a lobe. */
typedef struct lab_frame {
    lab_vector x, y, z;
} lab_frame;

static inline lab_vector lab_vector_of(const float numbers[3]) {
    return (lab_vector){numbers[0], numbers[1], numbers[2]};
}

static inline float lab_dot(lab_vector a, lab_vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline lab_vector lab_scale(lab_vector a, float s) {
    return (lab_vector){a.x * s, a.y * s, a.z * s};
}

/* a + s * b */
static inline lab_vector lab_add_scaled(lab_vector a, float s, lab_vector b) {
    return (lab_vector){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline lab_vector lab_cross(lab_vector a, lab_vector b) {
    return (lab_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Duff and others 2017. */
static inline lab_frame lab_frame_about(lab_vector n) {
    const float sign = copysignf(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return (lab_frame){
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}
