/* Affine and projective maps as 4x4 matrices, row major, world = M * local. Double precision: they are
 * composed while loading and become float where rays meet them. */
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
/* About `axis` (any length but 0), counter-clockwise seen against it. False for a zero axis. */
bool aur_transform_rotate(const double axis[3], double degrees, aur_transform *result);
/* From camera to world: local +z towards the target, +y near `up`. False when they give no frame. */
bool aur_transform_look_at(const double origin[3], const double target[3], const double up[3],
                           aur_transform *result);
/* False when singular or not finite. */
bool aur_transform_inverse(const aur_transform *a, aur_transform *inverse);
/* Whether the last row is 0 0 0 1. */
bool aur_transform_is_affine(const aur_transform *a);
/* Determinant of the upper left 3x3. */
double aur_transform_determinant(const aur_transform *a);

/* Changes the target's coordinates to those that count from `origin`. */
void aur_transform_move(aur_transform *a, const double origin[3]);

/* Apply an affine map. */
AUR_INTERNAL void aur_transform_point(const aur_transform *a, const double point[3], double result[3]);
void aur_transform_direction(const aur_transform *a, const double direction[3], double result[3]);
/* Applies the map whose inverse is `inverse` to a normal, by the transposed inverse. The result's length is
 * not 1. */
void aur_transform_normal(const aur_transform *inverse, const double normal[3], double result[3]);

aur_vector aur_transform_point_f(const aur_transform *a, aur_vector point);
aur_vector aur_transform_direction_f(const aur_transform *a, aur_vector direction);
aur_vector aur_transform_normal_f(const aur_transform *inverse, aur_vector normal);

/* How far from the origin a scene may reach, and by how much a map may stretch or shrink lengths. Far beyond
 * it squares of lengths leave the range of floats, and Embree, as Debian builds it, ends the process when a
 * ray begins beyond 1.8e18. */
#define AUR_REACH 1e12

/* Whether an affine map moves by no more than AUR_REACH, and stretches and shrinks by no more. */
bool aur_transform_is_within_reach(const aur_transform *a);

/* Whether the value of the key `to_world` is affine, has an inverse, *to_local, and moves and scales nothing
 * out of reach. Errors: FORMAT. */
aur_result aur_to_world_check(const aur_parameters *parameters, const aur_transform *to_world,
                              aur_transform *to_local, aur_error *error);
