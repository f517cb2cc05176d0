/* Points in arrays: those that the library keeps, and reading a view of somebody's. */
#pragma once

#include <aureole/pointset.h>

struct aur_points {
    aur_points_view view; /* of the arrays below */
    double *coordinates, *weights;
    size_t *lines;
};

/* Room for `count` points one after another, and for their weights where they are weighted. Errors: MEMORY.
 */
aur_result aur_points_create(aur_domain domain, uint64_t count, size_t dimension, bool weighted,
                             aur_points **points, aur_error *error);

/* The caller's view as this library knows it, with its stride. Errors: ARGUMENT for an unknown domain or a
 * stride below the dimension. */
aur_result aur_points_view_read(const aur_points_view *given, aur_points_view *view, aur_error *error);

static inline const double *aur_point_at(const aur_points_view *points, size_t index) {
    return points->coordinates + index * points->stride;
}
