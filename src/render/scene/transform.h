/* Affine and projective maps as 4x4 matrices, row major, world = M * local. They are composed in double
 * precision, and converted to float for rays. */
#pragma once

#include <stdbool.h>

#include "points/base/parameters.h"
#include "points/base/vector.h"

typedef struct aur_transform {
    double m[16];
} aur_transform;

aur_transform aur_transform_identity(void);
aur_transform aur_transform_multiply(const aur_transform *a, const aur_transform *b);
aur_transform aur_transform_translate(double x, double y, double z);
aur_transform aur_transform_scale(double x, double y, double z);
/* About `axis` (any length but 0), counter-clockwise when looking against it. False for a zero axis. */
bool aur_transform_rotate(const double axis[3], double degrees, aur_transform *result);
/* From camera to world: local +z towards the target, +y near `up`. False if they are degenerate. */
bool aur_transform_look_at(const double origin[3], const double target[3], const double up[3],
                           aur_transform *result);
/* False if singular or not finite. */
bool aur_transform_inverse(const aur_transform *a, aur_transform *inverse);
/* Whether the last row is 0 0 0 1. */
bool aur_transform_is_affine(const aur_transform *a);
/* Determinant of the upper left 3x3. */
double aur_transform_determinant(const aur_transform *a);

/* Converts the target's coordinates to those relative to `origin`. */
void aur_transform_move(aur_transform *a, const double origin[3]);

/* Apply an affine map. */
AUR_INTERNAL void aur_transform_point(const aur_transform *a, const double point[3], double result[3]);
void aur_transform_direction(const aur_transform *a, const double direction[3], double result[3]);
/* Transforms a normal by the map with this inverse, using the transposed inverse. The result is not
 * normalised. */
void aur_transform_normal(const aur_transform *inverse, const double normal[3], double result[3]);

aur_vector aur_transform_point_f(const aur_transform *a, aur_vector point);
aur_vector aur_transform_direction_f(const aur_transform *a, aur_vector direction);
aur_vector aur_transform_normal_f(const aur_transform *inverse, aur_vector normal);

/* Limits of the scene's distance from the origin, and of scale factors. Far beyond it squared lengths
 * overflow floats, and Debian's Embree aborts the process for ray origins beyond 1.8e18. */
#define AUR_REACH 1e12

/* Whether an affine map moves by at most AUR_REACH, and scales within its limits. */
bool aur_transform_is_within_reach(const aur_transform *a);

/* Whether the parameter `to_world` is affine and invertible, with inverse *to_local, and within the limits.
 * Errors: FORMAT. */
aur_result aur_to_world_check(const aur_parameters *parameters, const aur_transform *to_world,
                              aur_transform *to_local, aur_error *error);
