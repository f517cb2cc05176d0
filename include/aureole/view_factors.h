/* View factors: how much of what leaves one surface, diffusely, arrives at another. */
#ifndef AUREOLE_VIEW_FACTORS_H
#define AUREOLE_VIEW_FACTORS_H

#include <aureole/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The view factor from a plane convex polygon of from_count corners, from[3 * from_count], to another one,
 * seen from their fronts (corners counter-clockwise), with nothing between them. What lies behind the other's
 * plane does not count. They may touch, but not cut each other. The contour integral in closed form along one
 * edge and by Gauss's rule along the other (Sparrow 1963): about twelve digits. Errors: ARGUMENT for fewer
 * than 3 or more than 2^16 corners, corners that are not finite, not in a plane (to 1e-6 of the polygon's
 * size) or not convex, and polygons without area; MEMORY. */
AUR_API aur_result aur_view_factor_polygons(size_t from_count, const double *from, size_t to_count,
                                            const double *to, double *factor, aur_error *error)
    AUR_NONNULL(2, 4, 5);

#ifdef __cplusplus
}
#endif

#endif
