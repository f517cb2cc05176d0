/* Unit quaternions w,x,y,z. */
#pragma once

#include <stdint.h>

/* A uniformly random one by a hash of the seed (Shoemake 1992). */
void aur_quaternion_uniform(uint64_t seed, double wxyz[4]);

static inline double aur_dot4(const double a[4], const double b[4]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* The rotation by b, then by a. */
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
