/* Points for the tests of the measures, made from their closed forms. */
#ifndef AUR_TESTS_SPHERE_SETS_H
#define AUR_TESTS_SPHERE_SETS_H

#include <aureole/quality.h>
#include <math.h>
#include <stdlib.h>

#include "core/random.h"
#include "core/vector.h"

static inline aur_points sphere_points(size_t count) {
    return (aur_points){.domain = AUR_DOMAIN_SPHERE,
                        .count = count,
                        .dimension = 3,
                        .coordinates = malloc(count * 3 * sizeof(double))};
}

static inline void release_points(aur_points *points) {
    free(points->coordinates);
    free(points->weights);
    *points = (aur_points){0};
}

static inline void set_direction(aur_points *points, size_t index, double z, double phi) {
    const double r = sqrt((1.0 - z) * (1.0 + z));
    points->coordinates[3 * index] = r * cos(phi);
    points->coordinates[3 * index + 1] = r * sin(phi);
    points->coordinates[3 * index + 2] = z;
}

/* Marques 2013 eq. 4 with the azimuth in 64-bit fixed point. */
static inline aur_points spherical_fibonacci(size_t count, aur_domain domain) {
    aur_points points = sphere_points(count);
    points.domain = domain;
    const double scale = domain == AUR_DOMAIN_SPHERE ? 1.0 : 2.0;
    for (size_t j = 0; j < count; ++j) {
        const uint64_t phase = (uint64_t)j * UINT64_C(0x9E3779B97F4A7C15);
        set_direction(&points, j, 1.0 - (2.0 * (double)j + 1.0) / (scale * (double)count),
                      2.0 * AUR_PI * (double)phase * 0x1p-64);
    }
    return points;
}

static inline aur_points random_directions(size_t count, uint64_t seed) {
    aur_points points = sphere_points(count);
    for (size_t j = 0; j < count; ++j)
        set_direction(&points, j, 1.0 - 2.0 * aur_unit_double(aur_hash3(seed, j, 0)),
                      2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, j, 1)));
    return points;
}

static inline aur_points octahedron(void) {
    static const double corners[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    aur_points points = sphere_points(6);
    for (size_t i = 0; i < 18; ++i)
        points.coordinates[i] = corners[i];
    return points;
}

#endif
