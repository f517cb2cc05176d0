/* The discrete Fourier transform of a power of two of complex numbers. */
#pragma once

#include <stddef.h>

/* Fills turns[size] with the cosines and sines of 2 pi k / size, 0 <= k < size / 2. */
void aur_fourier_prepare(size_t size, double *turns);

/* Replaces re and im by the sums of x_j e^{i 2 pi j k / size}; the other sign for re and im exchanged. `work`
 * has room for 2 * size numbers. */
void aur_fourier(size_t size, const double *turns, double *re, double *im, double *work);
