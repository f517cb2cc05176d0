/* Points for the tests of the measures. */
#pragma once

#include <aureole/quality.h>
#include <aureole/sphere.h>
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

/* As the library makes them, so that a measure is tried on the points that it will be asked about. */
static inline aur_points spherical_fibonacci(size_t count, aur_domain domain) {
    const aur_directions_options options = aur_directions_options_default(count, domain);
    const aur_points_request request = aur_points_request_default(&options);
    aur_points points = {0};
    aur_error error = {0};
    if (aur_points_generate("spherical-fibonacci", &request, &points, &error) != AUR_OK)
        fail_msg("%s", error.message);
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
