/* Points of the square and the cube for the tests of the measures. Include check.h first. */
#pragma once

#include "points/base/random.h"
#include "test_points.h"

static inline double measured(const char *metric, const test_points *points) {
    double value = NAN;
    aur_error error = {0};
    assert_int_equal(aur_measure(metric, (const aur_points_view[]){seen(points)}, NULL, &value, &error),
                     AUR_OK);
    return value;
}

static inline test_points cube_points(size_t count, size_t dimension) {
    return (test_points){.domain = dimension == 2 ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_CUBE,
                         .count = count,
                         .dimension = dimension,
                         .coordinates = malloc(count * dimension * sizeof(double))};
}

static inline test_points random_points(size_t count, size_t dimension, uint64_t seed) {
    test_points points = cube_points(count, dimension);
    for (size_t i = 0; i < count * dimension; ++i)
        points.coordinates[i] = aur_unit_double(aur_hash2(seed, i));
    return points;
}

static inline test_points scrambled_set(const char *set, size_t count, size_t dimension,
                                        aur_scramble scramble) {
    const aur_pointset_options options = {
        .size = sizeof options, .count = count, .dimension = dimension, .scramble = scramble, .seed = 5};
    aur_pointset *pointset = NULL;
    assert_int_equal(aur_pointset_create(set, &options, &pointset, NULL), AUR_OK);
    test_points points = cube_points(count, dimension);
    assert_int_equal(aur_pointset_points(pointset, 0, count, dimension * count, points.coordinates, NULL),
                     AUR_OK);
    aur_pointset_destroy(pointset);
    return points;
}
