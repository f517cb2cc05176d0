/* The transforms of transform.h for the whole sphere in O(points + degree^3): a function of degree L is a
 * trigonometric polynomial on the torus (theta, phi), which is transformed on a grid and interpolated between
 * grid and points by the window of window.c (non-uniform Fourier transforms: Dutt and Rokhlin 1993, Barnett,
 * Magland and af Klinteberg 2019; on spheres Kunis and Potts 2003). The error is about 1e-14 of the largest
 * value, and both directions are adjoint to rounding. */
#pragma once

#include <stddef.h>

#include "points/base/fourier.h"
#include "points/quadrature/exact/transform.h"

typedef struct aur_fast_transform aur_fast_transform;

/* The basis, one of the whole sphere, and the points must outlive it. `progress` as of aur_transform. Errors:
 * MEMORY. */
aur_result aur_fast_transform_create(const aur_basis *basis, const aur_polar_points *points, size_t threads,
                                     aur_progress progress, aur_fast_transform **fast, aur_error *error);
void aur_fast_transform_destroy(aur_fast_transform *fast);

/* As those of aur_transform; not thread-safe. */
aur_result aur_fast_transform_analyse(aur_fast_transform *fast, const double *weights, double *coefficients,
                                      aur_error *error);
aur_result aur_fast_transform_synthesise(aur_fast_transform *fast, const double *coefficients, double *values,
                                         aur_error *error);

/* The smallest size from `least` on that is 64, 192 or 576 times a power of two. */
size_t aur_fourier_size(size_t least);

/* The narrow window that interpolates between points and the cells of a grid, for Fourier transforms of
 * points (Barnett, Magland and af Klinteberg 2019): exp(b (sqrt(1-x^2) - 1)) over WIDTH cells on each axis.
 * The grid has at least 7/4 times the cells of the polynomial; the error is about e^{-pi WIDTH sqrt(3/7)}. */

enum { AUR_WINDOW_WIDTH = 16 };

/* The largest error of a sum over points, over the sum of their absolute weights: about e^{-16 pi sqrt(3/7)}
 * on each axis, and rounding. */
#define AUR_WINDOW_ERROR 2e-14

typedef struct aur_window {
    size_t side;  /* of the grid, cells around: of aur_fourier_size */
    double shape; /* b */
} aur_window;

/* For frequencies -degree .. degree. */
aur_window aur_window_make(size_t degree);

/* The first cell of the window about the position `cell`, and the values of the window at its cells; it may
 * be negative or beyond the grid. */
double aur_window_fill(const aur_window *window, double cell, double values[AUR_WINDOW_WIDTH]);

/* The reciprocal of the window's transform at the frequencies 0 .. degree. */
void aur_window_invert(const aur_window *window, size_t degree, double *factors);

/* A point's position on the grid: its first cell, and the window at its cells, theta first. */
typedef struct aur_spot {
    size_t index, row, column;
    double window[2][AUR_WINDOW_WIDTH];
} aur_spot;

typedef struct aur_fast_kernel {
    /* Adds the weights of the spots, whose windows all overlap the rows, to the rows `from` to `to`. */
    void (*spread)(size_t count, const aur_spot *spots, const double *weights, size_t from, size_t to,
                   size_t stride, double *grid);
    void (*gather)(size_t count, const aur_spot *spots, size_t stride, const double *grid, double *values);
} aur_fast_kernel;

AUR_KERNELS(const aur_fast_kernel, aur_fast_kernel);
