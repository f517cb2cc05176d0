/* Shared by the tests of the sphere. */
#pragma once

#include "check.h"

#include <aureole/sphere.h>
#include <stdlib.h>

#include "points/base/random.h"
#include "points/base/vector.h"

static inline double check_dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double check_distance(const double *a, const double *b) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(check_dot(d, d));
}

/* count triples of a set, to be freed. */
static inline double *check_directions(const char *set, aur_directions_options options) {
    aur_directions *directions;
    aur_error error = {0};
    if (aur_directions_create(set, &options, &directions, &error) != AUR_OK)
        fail_msg("%s: %s", set, error.message);
    const size_t count = (size_t)aur_directions_size(directions);
    double *const xyz = malloc(3 * count * sizeof *xyz);
    assert_non_null(xyz);
    assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, NULL), AUR_OK);
    aur_directions_destroy(directions);
    return xyz;
}

/* E_N of Marques 2013 eq. 3, by the sum over all pairs. */
static inline double check_energy(size_t count, const double *xyz) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < i; ++k)
            sum += 2.0 * check_distance(xyz + 3 * i, xyz + 3 * k);
    return sqrt(4.0 / 3.0 - sum / ((double)count * (double)count));
}

static inline double check_smallest_distance(size_t count, const double *xyz) {
    double smallest = INFINITY;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < i; ++k)
            smallest = fmin(smallest, check_distance(xyz + 3 * i, xyz + 3 * k));
    return smallest;
}

/* A random direction, uniform over the sphere. */
static inline void check_random_direction(uint64_t seed, uint64_t index, double direction[3]) {
    const double z = 1.0 - 2.0 * aur_unit_double(aur_hash3(seed, index, 0));
    const double phi = 2.0 * AUR_PI * aur_unit_double(aur_hash3(seed, index, 1));
    const double radius = sqrt(1.0 - z * z);
    direction[0] = radius * cos(phi);
    direction[1] = radius * sin(phi);
    direction[2] = z;
}
