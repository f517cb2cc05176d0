/* Points of a set for tests, and brute-force oracles. */
#pragma once

#include "check.h"

#include <aureole/pointset.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline aur_pointset *make_set(const char *text, aur_pointset_options options) {
    aur_pointset *set = NULL;
    aur_error error = {0};
    if (aur_pointset_create(text, &options, &set, &error) != AUR_OK)
        print_error("%s: %s\n", text, error.message);
    assert_non_null(set);
    return set;
}

/* All points of a set; free them. */
static inline double *make_points(const char *text, aur_pointset_options options) {
    aur_pointset *const set = make_set(text, options);
    const size_t count = (size_t)aur_pointset_size(set);
    const size_t dimension = aur_pointset_dimension(set);
    double *const points = malloc(count * dimension * sizeof *points);
    assert_non_null(points);
    assert_int_equal(aur_pointset_points(set, 0, count, count * dimension, points, NULL), AUR_OK);
    for (size_t i = 0; i < count * dimension; ++i)
        assert_true(points[i] >= 0.0 && points[i] < 1.0);
    aur_pointset_destroy(set);
    return points;
}

/* Whether coordinates a and b of base^m points, `dimension` apart, are a (0,m,2)-net: each elementary
 * interval of area base^-m holds exactly one point. */
static inline bool is_net(size_t base, unsigned m, const double *points, size_t dimension, size_t a,
                          size_t b) {
    size_t count = 1;
    for (unsigned k = 0; k < m; ++k)
        count *= base;
    unsigned char *const seen = malloc(count);
    assert_non_null(seen);
    bool net = true;
    size_t columns = 1;
    for (unsigned k = 0; k <= m && net; ++k, columns *= base) {
        const size_t rows = count / columns;
        memset(seen, 0, count);
        for (size_t i = 0; i < count; ++i) {
            /* Quotients of integers by powers of the base are rounded: a point on a boundary must not fall
             * outside. */
            const double nudge = base == 2 ? 0.0 : 1e-9;
            const size_t x = (size_t)(points[i * dimension + a] * (double)columns + nudge);
            const size_t y = (size_t)(points[i * dimension + b] * (double)rows + nudge);
            net &= x < columns && y < rows && seen[x * rows + y]++ == 0;
        }
    }
    free(seen);
    return net;
}

/* The star discrepancy of points of the square from its definition: corners consist of the points'
 * coordinates and 1; open boxes undercount, closed ones overcount. O(N^3). */
static inline double brute_star_discrepancy(size_t count, const double *points) {
    double worst = 0.0;
    for (size_t i = 0; i <= count; ++i) {
        const double x = i < count ? points[2 * i] : 1.0;
        for (size_t j = 0; j <= count; ++j) {
            const double y = j < count ? points[2 * j + 1] : 1.0;
            size_t open = 0, closed = 0;
            for (size_t k = 0; k < count; ++k) {
                open += points[2 * k] < x && points[2 * k + 1] < y;
                closed += points[2 * k] <= x && points[2 * k + 1] <= y;
            }
            worst = fmax(worst, x * y - (double)open / (double)count);
            worst = fmax(worst, (double)closed / (double)count - x * y);
        }
    }
    return worst;
}
