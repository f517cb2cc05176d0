/* The nearest spherical Fibonacci points, compiled for one instruction set by the file that includes this.
 * Loops over lanes have no branches, so that compilers turn them into vectors: as fast as intrinsics,
 * measured. */
#pragma once

#include <math.h>
#include <string.h>

#include "sphere/nearest/inverse.h"
#include "sphere/phase.h"

enum { LANES = 8 };

/* The azimuth in turns, within 1e-12: it only has to find the cell. atan t / (2 pi t) is a polynomial of t^2
 * within 1.2e-13 up to tan(pi/8); above it atan t = pi/4 + atan((t - 1)/(t + 1)). */
static inline double azimuth(double x, double y) {
    const double a = fabs(x);
    const double b = fabs(y);
    const double longer = a > b ? a : b;
    const double shorter = a > b ? b : a;
    const int steep = shorter > 0.41421356237309503 * longer;
    const double above = steep ? shorter - longer : shorter;
    const double below = steep ? shorter + longer : longer;
    const double t = above / (below > 0.0 ? below : 1.0);
    const double q = t * t;
    double p = -0x1.88c1caeb27e21p-8;
    p = p * q + 0x1.6bb7b4d15bff6p-7;
    p = p * q + -0x1.d4fa8886f2df6p-7;
    p = p * q + 0x1.21887bf45caf7p-6;
    p = p * q + -0x1.7481457da6f11p-6;
    p = p * q + 0x1.04c265f437c13p-5;
    p = p * q + -0x1.b2995e6f24801p-5;
    p = p * q + 0x1.45f306dc9b798p-3;
    p = p * t + (steep ? 0.125 : 0.0);
    p = a > b ? p : 0.25 - p;
    p = x < 0.0 ? 0.5 - p : p;
    return y < 0.0 ? -p : p;
}

/* The zone k: b_k and b_{k+1} are nearly orthogonal on the sphere where Phi^{2k} is sqrt 5 pi N sin^2 theta
 * (Keinert 2015), at least 2. log2 of 1 + m is a polynomial within 7.5e-4; the last factor is 1/(2 log2 Phi).
 */
static inline int64_t zone_of(double whole, double sine_squared) {
    const double v = 7.0248147310407263 * whole * sine_squared + 1.0;
    int64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int64_t exponent = (bits >> 52) - 1023;
    const int64_t one_bits = (bits & INT64_C(0xfffffffffffff)) | INT64_C(0x3ff0000000000000);
    double m;
    memcpy(&m, &one_bits, sizeof m);
    m -= 1.0;
    double fraction = 0.15270028479752112;
    fraction = fraction * m + -0.5687040530057504;
    fraction = fraction * m + 1.415653190432735;
    fraction = fraction * m + 8.254628229341662e-4;
    const int64_t k = (int64_t)(((double)exponent + fraction) * 0.72021004203696985);
    return k > 2 ? k : 2;
}

/* LANES directions. */
static inline void nearest_lanes(const aur_sphere_lattice *lattice, const double *xyz, double *indices) {
    double corner[LANES], f0[LANES], f1[LANES], best[LANES], nearest[LANES], highest[LANES];
    for (int l = 0; l < LANES; ++l) {
        const double x = xyz[3 * l], y = xyz[3 * l + 1], z = xyz[3 * l + 2];
        const double across = x * x + y * y;
        /* 1 - z without cancellation about the pole */
        const double depth = z > 0.0 ? across / (1.0 + z) : 1.0 - z;
        const double index = depth / lattice->step - 0.5;
        const double turns = azimuth(x, y);
        const int64_t k = zone_of(lattice->whole, across);
        f0[l] = aur_sphere_lattice_fibonacci[k];
        f1[l] = aur_sphere_lattice_fibonacci[k + 1];
        const double e0 = aur_sphere_lattice_turns[k];
        const double e1 = aur_sphere_lattice_turns[k + 1];
        /* coordinates in the basis, whose determinant is (-1)^k */
        const double sign = e0 > 0.0 ? -1.0 : 1.0;
        const double c0 = floor((index * e1 - f1[l] * turns) * sign);
        const double c1 = floor((f0[l] * turns - e0 * index) * sign);
        corner[l] = c0 * f0[l] + c1 * f1[l];
        best[l] = 1e300;
        nearest[l] = highest[l] = -1.0;
    }
    for (int i = 0; i < 4; ++i) {
        for (int l = 0; l < LANES; ++l) {
            const double j = corner[l] + ((i & 1) != 0 ? f0[l] : 0.0) + ((i & 2) != 0 ? f1[l] : 0.0);
            const int inside = (j >= 0.0) & (j < lattice->whole);
            const double clamped = inside ? j : 0.0;
            const double down = (clamped + 0.5) * lattice->step;
            const double radius = sqrt(down * (2.0 - down));
            double sine, cosine;
            aur_phase_sincos((uint64_t)(int64_t)clamped * AUR_GOLDEN_PHASE, &sine, &cosine);
            const double x = radius * cosine - xyz[3 * l];
            const double y = radius * sine - xyz[3 * l + 1];
            const double z = (1.0 - down) - xyz[3 * l + 2];
            const double distance = inside ? x * x + y * y + z * z : 1e300;
            const int closer = (distance < best[l]) | ((distance == best[l]) & (j < nearest[l]));
            best[l] = closer ? distance : best[l];
            nearest[l] = closer ? j : nearest[l];
            highest[l] = j > highest[l] ? j : highest[l];
        }
    }
    for (int l = 0; l < LANES; ++l)
        indices[l] =
            ((lattice->limit < lattice->whole) & (highest[l] >= lattice->limit)) != 0 ? -1.0 : nearest[l];
}

static inline void nearest_points(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                  double *indices) {
    size_t i = 0;
    for (; i + LANES <= count; i += LANES)
        nearest_lanes(lattice, xyz + 3 * i, indices + i);
    if (i == count)
        return;
    double rest_xyz[3 * LANES] = {0}, rest[LANES];
    memcpy(rest_xyz, xyz + 3 * i, 3 * (count - i) * sizeof *xyz);
    nearest_lanes(lattice, rest_xyz, rest);
    memcpy(indices + i, rest, (count - i) * sizeof *rest);
}
