/* The narrow window that carries values between points and the cells of a grid, for Fourier transforms of
 * points (Barnett, Magland and af Klinteberg 2019): exp(b (sqrt(1-x^2) - 1)) over WIDTH cells on each axis.
 * The grid has at least 3/2 times the cells of the polynomial, so that it errs by some e^{-pi WIDTH
 * sqrt(1/3)}. */
#pragma once

#include <stddef.h>

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
