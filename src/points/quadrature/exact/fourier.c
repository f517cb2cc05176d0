#include "points/quadrature/exact/fast.h"

#include <math.h>
#include <string.h>

#include "points/base/vector.h"

void aur_fourier_prepare(size_t size, double *turns) {
    for (size_t k = 0; k < size / 2; ++k) {
        const double angle = 2.0 * AUR_PI * (double)k / (double)size;
        turns[2 * k] = cos(angle);
        turns[2 * k + 1] = sin(angle);
    }
}

/* Stockham's form, which needs no reversal of bits: `many` transforms of length 2 `length` become twice as
 * many of half the length. */
static void halve(size_t length, size_t many, const double *turns, const double *restrict re,
                  const double *restrict im, double *restrict to_re, double *restrict to_im) {
    for (size_t j = 0; j < length; ++j) {
        const double c = turns[2 * j * many], s = turns[2 * j * many + 1];
        const size_t low = j * many, high = low + length * many, out = 2 * low;
        for (size_t k = 0; k < many; ++k) {
            const double x = re[low + k] - re[high + k], y = im[low + k] - im[high + k];
            to_re[out + k] = re[low + k] + re[high + k];
            to_im[out + k] = im[low + k] + im[high + k];
            to_re[out + many + k] = x * c - y * s;
            to_im[out + many + k] = x * s + y * c;
        }
    }
}

void aur_fourier(size_t size, const double *turns, double *re, double *im, double *work) {
    double *from_re = re, *from_im = im, *to_re = work, *to_im = work + size;
    for (size_t length = size / 2, many = 1; length > 0; length /= 2, many *= 2) {
        halve(length, many, turns, from_re, from_im, to_re, to_im);
        double *const old_re = from_re, *const old_im = from_im;
        from_re = to_re;
        from_im = to_im;
        to_re = old_re;
        to_im = old_im;
    }
    if (from_re != re) {
        memcpy(re, from_re, size * sizeof *re);
        memcpy(im, from_im, size * sizeof *im);
    }
}
