/* Fourier transforms by Stockham's passes, which need no bit reversal: each turns `many` transforms of `radix
 * * length` numbers into `radix` times as many of `length`. */
#include <string.h>

#include "points/base/fourier.h"

/* One pass over `many` transforms of radix * length numbers; entry 1 of `turns` is one step of the whole
 * circle. */
typedef struct pass {
    size_t length, many;
    const double *turns;
} pass;

typedef struct split {
    double *restrict re, *restrict im;
} split;

static inline void halve(pass p, split from, split to) {
    const size_t length = p.length, many = p.many, high = length * many;
    for (size_t j = 0; j < length; ++j) {
        const double c = p.turns[2 * j * many], s = p.turns[2 * j * many + 1];
        const size_t low = j * many, out = 2 * low;
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < many; ++k) {
            const double a = from.re[low + k], b = from.im[low + k];
            const double d = from.re[low + high + k], e = from.im[low + high + k];
            to.re[out + k] = a + d;
            to.im[out + k] = b + e;
            to.re[out + many + k] = (a - d) * c - (b - e) * s;
            to.im[out + many + k] = (a - d) * s + (b - e) * c;
        }
    }
}

static inline void third(pass p, split from, split to) {
    const size_t length = p.length, many = p.many, next = length * many;
    const double half_root = 0.86602540378443864676;
    for (size_t j = 0; j < length; ++j) {
        const double *const one = p.turns + 2 * j * many, *const two = p.turns + 4 * j * many;
        const size_t low = j * many, out = 3 * low;
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < many; ++k) {
            const size_t i = low + k, o = out + k;
            const double re = from.re[i + next] + from.re[i + 2 * next];
            const double im = from.im[i + next] + from.im[i + 2 * next];
            const double x = half_root * (from.im[i + next] - from.im[i + 2 * next]);
            const double y = half_root * (from.re[i + next] - from.re[i + 2 * next]);
            const double a = from.re[i] - 0.5 * re, b = from.im[i] - 0.5 * im;
            to.re[o] = from.re[i] + re;
            to.im[o] = from.im[i] + im;
            to.re[o + many] = (a - x) * one[0] - (b + y) * one[1];
            to.im[o + many] = (a - x) * one[1] + (b + y) * one[0];
            to.re[o + 2 * many] = (a + x) * two[0] - (b - y) * two[1];
            to.im[o + 2 * many] = (a + x) * two[1] + (b - y) * two[0];
        }
    }
}

static inline void quarter(pass p, split from, split to) {
    const size_t length = p.length, many = p.many, next = length * many;
    for (size_t j = 0; j < length; ++j) {
        const double *const one = p.turns + 2 * j * many, *const two = p.turns + 4 * j * many,
                            *const three = p.turns + 6 * j * many;
        const size_t low = j * many, out = 4 * low;
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < many; ++k) {
            const size_t i = low + k, o = out + k;
            const double a = from.re[i] + from.re[i + 2 * next], b = from.im[i] + from.im[i + 2 * next];
            const double c = from.re[i] - from.re[i + 2 * next], d = from.im[i] - from.im[i + 2 * next];
            const double e = from.re[i + next] + from.re[i + 3 * next];
            const double f = from.im[i + next] + from.im[i + 3 * next];
            const double g = from.re[i + next] - from.re[i + 3 * next];
            const double h = from.im[i + next] - from.im[i + 3 * next];
            to.re[o] = a + e;
            to.im[o] = b + f;
            to.re[o + many] = (c - h) * one[0] - (d + g) * one[1];
            to.im[o + many] = (c - h) * one[1] + (d + g) * one[0];
            to.re[o + 2 * many] = (a - e) * two[0] - (b - f) * two[1];
            to.im[o + 2 * many] = (a - e) * two[1] + (b - f) * two[0];
            to.re[o + 3 * many] = (c + h) * three[0] - (d - g) * three[1];
            to.im[o + 3 * many] = (c + h) * three[1] + (d - g) * three[0];
        }
    }
}

static void transform(size_t size, const double *turns, double *re, double *im, double *work) {
    split from = {re, im}, to = {work, work + size};
    for (size_t length = size, many = 1; length > 1;) {
        const size_t radix = length % 3 == 0 ? 3 : length % 4 == 0 ? 4 : 2;
        length /= radix;
        (radix == 3 ? third : radix == 4 ? quarter : halve)((pass){length, many, turns}, from, to);
        many *= radix;
        const split old = from;
        from = to;
        to = old;
    }
    if (from.re != re) {
        memcpy(re, from.re, size * sizeof *re);
        memcpy(im, from.im, size * sizeof *im);
    }
}

const aur_fourier_kernel AUR_KERNEL(aur_fourier_kernel) = {transform};
