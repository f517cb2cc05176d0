/* Rotations by Hopf coordinates: a height u in [0,1] and two azimuths, uniform over the rotations where they
 * are uniform over the cube (Shoemake 1992). The quaternion is w = sqrt(u) sin(2 pi a), x = sqrt(u) cos(2 pi
 * a), y = sqrt(1 - u) sin(2 pi b), z = sqrt(1 - u) cos(2 pi b). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "points/base/simd.h"

/* Point j has u = (j + offset) * step and azimuths phases[k] + j turns[k], in units of 2^-64 turns. */
typedef struct aur_hopf_line {
    double step, offset;
    uint64_t phases[2], turns[2];
} aur_hopf_line;

/* 1/sqrt 2 and 1/psi turns, psi^4 = psi + 4 (Alexa 2022), rounded to the nearest phase. */
#define AUR_SUPER_FIBONACCI_TURNS                                                                            \
    { UINT64_C(0xb504f333f9de6484), UINT64_C(0xa6e939cd91ba1a16) }

/* Points first .. first+count-1 of a line, and of `count` points u,a,b of the cube, as quaternions w,x,y,z.
 * Bit-identical for all instruction sets. */
typedef struct aur_hopf_kernels {
    void (*line)(const aur_hopf_line *line, uint64_t first, size_t count, double *wxyz);
    void (*lift)(size_t count, const double *cube, double *wxyz);
} aur_hopf_kernels;

AUR_KERNELS(const aur_hopf_kernels, aur_hopf);
