/* The transforms of transform.h for the whole sphere in O(points + degree^3): a function of degree L is a
 * trigonometric polynomial on the torus (theta, phi), which is known from a grid by Fourier transforms and
 * carried between grid and points by the window of window.h (non-uniform Fourier transforms: Dutt and Rokhlin
 * 1993, Barnett, Magland and af Klinteberg 2019; on spheres Kunis and Potts 2003). It is good to some 1e-11
 * of the largest value, and both directions are adjoint to rounding. */
#pragma once

#include "points/quadrature/exact/transform.h"

typedef struct aur_fast_transform aur_fast_transform;

/* The basis, one of the whole sphere, and the points must outlive it. `progress` as of aur_transform. Errors:
 * MEMORY. */
aur_result aur_fast_transform_create(const aur_basis *basis, const aur_polar_points *points, size_t threads,
                                     aur_progress progress, aur_fast_transform **fast, aur_error *error);
void aur_fast_transform_destroy(aur_fast_transform *fast);

/* As those of aur_transform; not by two threads at once. */
aur_result aur_fast_transform_analyse(aur_fast_transform *fast, const double *weights, double *coefficients,
                                      aur_error *error);
aur_result aur_fast_transform_synthesise(aur_fast_transform *fast, const double *coefficients, double *values,
                                         aur_error *error);
