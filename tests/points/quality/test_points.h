/* A test's private points, which it changes and frees, wrapped for the library. */
#pragma once

#include <aureole/quality.h>
#include <stdlib.h>
#include <string.h>

typedef struct test_points {
    aur_domain domain;
    size_t count, dimension;
    double *coordinates, *weights;
} test_points;

static inline aur_points_view seen(const test_points *points) {
    aur_points_view view =
        aur_points_view_of(points->domain, points->count, points->dimension, points->coordinates);
    view.weights = points->weights;
    return view;
}

static inline void release_points(test_points *points) {
    free(points->coordinates);
    free(points->weights);
    *points = (test_points){0};
}
