/* Points and directions in double precision, by value; y is up in every scene. */
#pragma once

#include <math.h>

#define PI 3.14159265358979323846

typedef struct vec {
    double x, y, z;
} vec;

static inline vec add(vec a, vec b) {
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vec subtract(vec a, vec b) {
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vec scale(vec a, double s) {
    return (vec){a.x * s, a.y * s, a.z * s};
}

/* a + s b */
static inline vec add_scaled(vec a, double s, vec b) {
    return (vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline double dot(vec a, vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec cross(vec a, vec b) {
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double length(vec a) {
    return sqrt(dot(a, a));
}

/* The zero vector stays as it is. */
static inline vec normalize(vec a) {
    const double size = length(a);
    return size > 0.0 ? scale(a, 1.0 / size) : a;
}

static inline vec mix(vec a, vec b, double t) {
    return add_scaled(scale(a, 1.0 - t), t, b);
}

static inline double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static inline double smoothstep(double low, double high, double x) {
    const double t = clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/* Turns about an axis by an angle in radians, right-handed. */
static inline vec turn_x(vec p, double angle) {
    const double c = cos(angle), s = sin(angle);
    return (vec){p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

static inline vec turn_y(vec p, double angle) {
    const double c = cos(angle), s = sin(angle);
    return (vec){c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}

static inline vec turn_z(vec p, double angle) {
    const double c = cos(angle), s = sin(angle);
    return (vec){c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}
