/* The transforms of transform.h for the whole sphere in O(points + degree^3): a function of degree L is a
 * trigonometric polynomial on the torus (theta, phi), which is known from a grid by Fourier transforms and
 * carried between grid and points by the window of window.c (non-uniform Fourier transforms: Dutt and Rokhlin
 * 1993, Barnett, Magland and af Klinteberg 2019; on spheres Kunis and Potts 2003). It is good to some 1e-11
 * of the largest value, and both directions are adjoint to rounding. */
#pragma once

#include <stddef.h>

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

/* The discrete Fourier transform of a power of two of complex numbers. */

/* Fills turns[size] with the cosines and sines of 2 pi k / size, 0 <= k < size / 2. */
void aur_fourier_prepare(size_t size, double *turns);

/* Replaces re and im by the sums of x_j e^{i 2 pi j k / size}; the other sign for re and im exchanged. `work`
 * has room for 2 * size numbers. */
void aur_fourier(size_t size, const double *turns, double *re, double *im, double *work);

/* The narrow window that carries values between points and the cells of a grid, for Fourier transforms of
 * points (Barnett, Magland and af Klinteberg 2019): exp(b (sqrt(1-x^2) - 1)) over WIDTH cells on each axis.
 * The grid has at least 3/2 times the cells of the polynomial, so that it errs by some e^{-pi WIDTH
 * sqrt(1/3)}. */

enum { AUR_WINDOW_WIDTH = 14 };

/* The largest error of a sum over points, over the sum of their absolute weights: about e^{-14 pi / sqrt 3}
 * on each axis. */
#define AUR_WINDOW_ERROR 2e-11

typedef struct aur_window {
    size_t side;  /* of the grid, cells around: a power of two */
    double shape; /* b */
} aur_window;

/* For frequencies -degree .. degree. */
aur_window aur_window_make(size_t degree);

/* The first cell of the window about the place `cell`, in cells from the first one on, and the window's
 * values there; it may be negative or beyond the grid. */
double aur_window_fill(const aur_window *window, double cell, double values[AUR_WINDOW_WIDTH]);

/* One over the window's own transform at the frequencies 0 .. degree. */
void aur_window_invert(const aur_window *window, size_t degree, double *factors);
