/* Spherical Fibonacci points of a cos^m lobe, written out here so that these tests need nothing of the
 * sphere. */
#pragma once

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* cos^m about +z; m may be the exponent of another density than the lobe's. */
static inline void fibonacci_lobe(size_t count, double m, double *xyz) {
    for (size_t j = 0; j < count; ++j) {
        const double even = 1.0 - (2.0 * (double)j + 1.0) / (2.0 * (double)count);
        const double z = pow(even, 1.0 / (m + 1.0));
        const double phi =
            2.0 * 3.14159265358979323846 * 0x1p-64 * (double)((uint64_t)j * UINT64_C(0x9e3779b97f4a7c15));
        xyz[3 * j] = sqrt((1.0 - z) * (1.0 + z)) * cos(phi);
        xyz[3 * j + 1] = sqrt((1.0 - z) * (1.0 + z)) * sin(phi);
        xyz[3 * j + 2] = z;
    }
}

static inline void fibonacci_sphere(size_t count, double *xyz) {
    for (size_t j = 0; j < count; ++j) {
        const double z = 1.0 - (2.0 * (double)j + 1.0) / (double)count;
        const double phi =
            2.0 * 3.14159265358979323846 * 0x1p-64 * (double)((uint64_t)j * UINT64_C(0x9e3779b97f4a7c15));
        xyz[3 * j] = sqrt((1.0 - z) * (1.0 + z)) * cos(phi);
        xyz[3 * j + 1] = sqrt((1.0 - z) * (1.0 + z)) * sin(phi);
        xyz[3 * j + 2] = z;
    }
}

/* Turns about the y axis, +z towards +x. */
static inline void tilt(size_t count, double radians, double *xyz) {
    for (size_t j = 0; j < count; ++j) {
        const double x = xyz[3 * j], z = xyz[3 * j + 2];
        xyz[3 * j] = cos(radians) * x + sin(radians) * z;
        xyz[3 * j + 2] = cos(radians) * z - sin(radians) * x;
    }
}
