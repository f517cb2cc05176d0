/* The discrete Fourier transform of 2^a 3^b complex numbers. */
#pragma once

#include <math.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "points/base/vector.h"

/* Fills turns[2 * size] with the cosines and sines of 2 pi k / size. */
static inline void aur_fourier_prepare(size_t size, double *turns) {
    for (size_t k = 0; k < size; ++k) {
        const double angle = 2.0 * AUR_PI * (double)k / (double)size;
        turns[2 * k] = cos(angle);
        turns[2 * k + 1] = sin(angle);
    }
}

typedef struct aur_fourier_kernel {
    void (*transform)(size_t size, const double *turns, double *re, double *im, double *work);
} aur_fourier_kernel;

AUR_KERNELS(const aur_fourier_kernel, aur_fourier_kernel);

/* Replaces re and im by the sums of x_j e^{i 2 pi j k / size}; the other sign for re and im exchanged. `work`
 * has room for 2 * size numbers. */
static inline void aur_fourier(size_t size, const double *turns, double *re, double *im, double *work) {
    AUR_KERNEL_HERE(aur_fourier_kernel).transform(size, turns, re, im, work);
}
