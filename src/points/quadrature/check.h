/* Checks of arguments. */
#pragma once

#include <aureole/quadrature.h>
#include <math.h>

#include "points/base/error.h"
#include "points/base/vector.h"

/* ARGUMENT for the first of `count` vectors that is not of unit length. */
aur_result aur_check_directions(size_t count, const double *xyz, aur_error *error);

/* The default set. */
static const char aur_set_default[] = "spherical-fibonacci";

/* Copies the caller's options, which may be NULL, over the defaults in *copy. */
aur_result aur_weights_options_read(const aur_weights_options *given, aur_weights_options *copy,
                                    aur_error *error);

/* The options->count points of a set, and their weights unless NULL; the set must have that number. */
aur_result aur_points_of_set(const char *set, const aur_directions_options *options, double *xyz,
                             double *weights, aur_error *error);

/* CAPACITY unless `needed` numbers fit into `capacity`. Inline, like the check of angles: every look-up of
 * weights calls both. */
static inline aur_result aur_check_capacity(size_t needed, size_t capacity, aur_error *error) {
    return needed <= capacity ? AUR_OK
                              : aur_fail(error, AUR_ERROR_CAPACITY,
                                         "there is room for %zu numbers, not for %zu", capacity, needed);
}

/* ARGUMENT for an exponent of a cos^m lobe outside [0, AUR_EXPONENT_MAXIMUM], and for a smoothness outside
 * (1, AUR_SMOOTHNESS_MAXIMUM) or, above 2, within .01 of an integer, where the kernel is a polynomial. */
static inline bool aur_smoothness_in_range(double smoothness) {
    return smoothness > 1.0 && smoothness < AUR_SMOOTHNESS_MAXIMUM &&
           (smoothness < 2.0 || fabs(smoothness - rint(smoothness)) >= 0.01);
}
aur_result aur_check_exponent(double exponent, aur_error *error);
aur_result aur_check_smoothness(double smoothness, aur_error *error);

/* ARGUMENT for an angle outside [0, pi/2]. */
static inline aur_result aur_check_angle(double radians, aur_error *error) {
    return radians >= 0.0 && radians <= 0.5 * AUR_PI + 1e-9
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "the angle must be between 0 and pi/2, not %g", radians);
}
