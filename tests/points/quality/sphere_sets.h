/* Points for the tests of the measures. */
#pragma once

#include <aureole/sphere.h>
#include <math.h>
#include <stdlib.h>

#include "own_points.h"
#include "points/base/random.h"
#include "points/base/vector.h"

static inline own_points sphere_points(size_t count) {
    return (own_points){.domain = AUR_DOMAIN_SPHERE,
                        .count = count,
                        .dimension = 3,
                        .coordinates = malloc(count * 3 * sizeof(double))};
}

static inline void set_direction(own_points *points, size_t index, double z, double phi) {
    const double r = sqrt((1.0 - z) * (1.0 + z));
    points->coordinates[3 * index] = r * cos(phi);
    points->coordinates[3 * index + 1] = r * sin(phi);
    points->coordinates[3 * index + 2] = z;
}

/* As the library makes them, so that a measure is tried on the points that it will be asked about. */
static inline own_points spherical_fibonacci(size_t count, aur_domain domain) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    own_points points = sphere_points(count);
    points.domain = domain;
    aur_directions *directions = NULL;
    aur_error error = {0};
    if (aur_directions_create("spherical-fibonacci", &options, &directions, &error) != AUR_OK ||
        aur_directions_points(directions, 0, count, 3 * count, points.coordinates, NULL, NULL) != AUR_OK)
        fail_msg("%s", error.message);
    aur_directions_destroy(directions);
    return points;
}

static inline own_points random_directions(size_t count, uint64_t seed) {
    own_points points = sphere_points(count);
    for (size_t j = 0; j < count; ++j)
        set_direction(&points, j, 1.0 - 2.0 * aur_unit_double(aur_hash3(seed, j, 0)),
                      2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, j, 1)));
    return points;
}

static inline own_points octahedron(void) {
    static const double corners[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    own_points points = sphere_points(6);
    for (size_t i = 0; i < 18; ++i)
        points.coordinates[i] = corners[i];
    return points;
}
