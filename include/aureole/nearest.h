/* Nearest neighbours of directions, axes, rotations, points of the square or of a cube, in batches. */
#ifndef AUREOLE_NEAREST_H
#define AUREOLE_NEAREST_H

#include <aureole/pointset.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A tree over points: immutable, usable by any number of threads. */
typedef struct aur_nearest aur_nearest;

/* Builds a tree over at least one point in O(N log N) time; the points are copied. For axes and rotations x
 * and -x are the same point. Errors: ARGUMENT for no point, a number that is not finite, or more than 8
 * coordinates per point. */
AUR_API aur_result aur_nearest_create(const aur_points_view *points, aur_nearest **nearest, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API void aur_nearest_destroy(aur_nearest *nearest); /* NULL is allowed */

typedef struct aur_nearest_options {
    size_t size;       /* sizeof the caller's struct */
    size_t neighbours; /* of each query: at least 1 and at most the number of points; 0: 1 */
    size_t threads;    /* 0: all */
    aur_progress progress;
} aur_nearest_options;

AUR_API aur_result aur_nearest_options_init(aur_nearest_options *options, aur_error *error) AUR_NONNULL(1);

/* Finds the points nearest to each of `count` queries, in the layout of the points. indices[count *
 * neighbours] are sorted by distance, then by index. distances[count * neighbours], unless NULL, are angles
 * in radians for directions, axes and rotations, otherwise Euclidean distances. Queries of directions and
 * rotations need not have unit length. Time grows with the logarithm of the number of points; the result does
 * not depend on the threads. Errors: ARGUMENT for more neighbours than points or a query that is not finite
 * (or, where it is a direction or rotation, zero), CANCELLED, MEMORY. */
AUR_API aur_result aur_nearest_find(const aur_nearest *nearest, const aur_nearest_options *options,
                                    size_t count, const double *queries, size_t *indices, double *distances,
                                    aur_error *error) AUR_NONNULL(1, 5);

#ifdef __cplusplus
}
#endif

#endif
