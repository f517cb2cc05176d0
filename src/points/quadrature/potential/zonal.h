/* The potential of a cos^m lobe: a function of x = u.axis only. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

/* z(x) is smooth but at x = 0, where the lobe ends: one Chebyshev series for each side, in t = 2|x| - 1. */
typedef struct aur_zonal {
    size_t count[2];         /* of x >= 0 and of x < 0 */
    double *coefficients[2]; /* one allocation, that of [0] */
    double self_energy;
} aur_zonal;

/* The lobe (m+1)/(2 pi) cos^m with m in [0, 1e5]. */
aur_result aur_zonal_create(double exponent, double smoothness, aur_zonal *zonal, aur_error *error);
void aur_zonal_release(aur_zonal *zonal);

/* z[i] at x[i] in [-1,1]; rounding may lead a little beyond. NaN gives NaN. */
void aur_zonal_evaluate(const aur_zonal *zonal, size_t count, const double *x, double *z);

/* Terms after which the series is a good 1e-12 of its sum. */
size_t aur_zonal_terms(double exponent, double smoothness);
