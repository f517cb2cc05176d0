/* Checks of what callers pass in. */
#pragma once

#include "core/error.h"

/* ARGUMENT for the first of `count` vectors that is not of unit length. */
aur_result aur_check_directions(size_t count, const double *xyz, aur_error *error);

/* CAPACITY unless `needed` numbers fit into `capacity`. */
aur_result aur_check_capacity(size_t needed, size_t capacity, aur_error *error);

/* ARGUMENT for an angle outside [0, pi/2]. */
aur_result aur_check_angle(double radians, aur_error *error);
