/* The two parts of the kernel d^-S or log 1/d: F(d) = a^S g(S/2, a^2 d^2) is smooth and the rest is next to
 * nothing for a d >> 1. g is Tricomi's incomplete gamma function, g(s, q) = q^-s (1 - Gamma(s, q) /
 * Gamma(s)), which has no singularity (DLMF 8.7.1). */
#pragma once

#include <stddef.h>

enum { AUR_SPLIT_TERMS = 64 };

typedef struct aur_split_kernel {
    double exponent; /* S */
    double scale;    /* a */
    double reach;    /* the distance from which on the rest is left out */
    double rest;     /* no more than this */
    size_t term_count;
    double terms[AUR_SPLIT_TERMS]; /* F as a Chebyshev series in d^2 over [0, reach^2] */
} aur_split_kernel;

/* The kernel itself; `square` is d^2 > 0. */
double aur_split_whole(double exponent, double square);
/* F, and F(0) for 0. */
double aur_split_smooth(const aur_split_kernel *kernel, double square);
/* With the rest left out where (a d)^2 > `range`. */
aur_split_kernel aur_split_kernel_make(double exponent, double reach, double range);
