/* The maps of the square, one point at a time. All but POLAR preserve area. A disk of squared radius a = r^2
 * is lifted to a cap of height h about +z by z = 1 - h a, which is Archimedes' theorem: h = 1 is the
 * hemisphere, h = 2 the sphere. */
#pragma once

#include <aureole/sphere.h>
#include <math.h>
#include <stdint.h>

#include "points/sphere/phase.h"

/* A point of the disk by polar coordinates. The radius may be negative. */
typedef struct aur_polar_point {
    double radius, area; /* area is the radius squared */
    double sine, cosine;
} aur_polar_point;

/* Shirley and Chiu 1997: squares about the centre become circles. */
static inline aur_polar_point aur_polar_concentric(const double square[2]) {
    const double a = 2.0 * square[0] - 1.0;
    const double b = 2.0 * square[1] - 1.0;
    aur_polar_point point = {fabs(a) > fabs(b) ? a : b, 0.0, 0.0, 1.0};
    if (point.radius == 0.0)
        return point;
    const double turns = fabs(a) > fabs(b) ? b / a / 8.0 : 0.25 - a / b / 8.0;
    point.area = point.radius * point.radius;
    aur_phase_sincos(aur_phase_from_turns(turns), &point.sine, &point.cosine);
    return point;
}

static inline aur_polar_point aur_polar_of_square(aur_map map, const double square[2]) {
    if (map == AUR_MAP_CONCENTRIC)
        return aur_polar_concentric(square);
    const double u = square[0];
    aur_polar_point point = {map == AUR_MAP_POLAR ? u : sqrt(u), map == AUR_MAP_POLAR ? u * u : u, 0.0, 0.0};
    aur_phase_sincos(aur_phase_from_turns(square[1]), &point.sine, &point.cosine);
    return point;
}

static inline void aur_point_to_disk(aur_map map, const double square[2], double disk[2]) {
    const aur_polar_point point = aur_polar_of_square(map, square);
    disk[0] = point.radius * point.cosine;
    disk[1] = point.radius * point.sine;
}

static inline void aur_point_to_cap(aur_map map, double height, const double square[2], double direction[3]) {
    const aur_polar_point point = aur_polar_of_square(map, square);
    const double depth = height * point.area;
    const double radius = copysign(sqrt(depth * (2.0 - depth)), point.radius);
    direction[0] = radius * point.cosine;
    direction[1] = radius * point.sine;
    direction[2] = 1.0 - depth;
}

/* The inverses, with the conventions of the public functions. */
void aur_point_from_disk(aur_map map, const double disk[2], double square[2]);
void aur_point_from_cap(aur_map map, double height, const double direction[3], double square[2]);

/* Unit quaternions w,x,y,z. */

/* A uniformly random quaternion by a hash of the seed (Shoemake 1992). */
void aur_quaternion_uniform(uint64_t seed, double wxyz[4]);

static inline double aur_dot4(const double a[4], const double b[4]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* The product: rotation by b, then by a. */
static inline void aur_quaternion_multiply(const double a[4], const double b[4], double product[4]) {
    const double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    const double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    const double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    const double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
    product[0] = w;
    product[1] = x;
    product[2] = y;
    product[3] = z;
}
