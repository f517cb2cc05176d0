/* Azimuths in 64-bit fixed point: a phase counts 2^-64 turns and wraps by itself, so that neither adding nor
 * multiplying by an index ever loses a digit. */
#pragma once

#include <stdint.h>

#include "pointset/fraction128.h"

/* The golden angle, 1/Phi turns, rounded to the nearest phase: 2.6e-21 turn too much. (The constant without
 * the rounding, ...7c15, is 5.2e-20 turn short: at 43,000 points the azimuths differ by more than a double's
 * last digits.) */
#define AUR_GOLDEN_PHASE (AUR_GOLDEN_HIGH + (AUR_GOLDEN_LOW >> 63))

/* The fraction of `turns`, exact to 2^-64 turn. Any finite number is allowed. */
static inline uint64_t aur_phase_from_turns(double turns) {
    const double fraction = turns - __builtin_floor(turns);
    return fraction < 1.0 ? (uint64_t)(fraction * 0x1p64) : 0;
}

/* Polynomials on t in [-1,1], in powers of t^2: sin(pi t/4)/t to 4e-17 and cos(pi t/4) to 2e-17 (minimax).
 * The cosine's first coefficient is 1. */
#define AUR_PHASE_SINE_0 0x1.921fb54442d18p-1
#define AUR_PHASE_SINE_1 -0x1.4abbce625be52p-4
#define AUR_PHASE_SINE_2 0x1.466bc6775a476p-9
#define AUR_PHASE_SINE_3 -0x1.32d2cce500387p-15
#define AUR_PHASE_SINE_4 0x1.50783208843ebp-22
#define AUR_PHASE_SINE_5 -0x1.e3027dea82bd7p-30
#define AUR_PHASE_SINE_6 0x1.e4a9d9166f052p-38
#define AUR_PHASE_COSINE_1 -0x1.3bd3cc9be45dep-2
#define AUR_PHASE_COSINE_2 0x1.03c1f081b5ac0p-6
#define AUR_PHASE_COSINE_3 -0x1.55d3c7e3cb241p-12
#define AUR_PHASE_COSINE_4 0x1.e1f5068688d5bp-19
#define AUR_PHASE_COSINE_5 -0x1.a6d1eef479be1p-26
#define AUR_PHASE_COSINE_6 0x1.f9ce245cada0bp-34
#define AUR_PHASE_COSINE_7 -0x1.b2f3eb054afcdp-42

/* Sine and cosine of a phase to 2e-16: exact reduction to an eighth of a turn, then the polynomials in plain
 * multiplications and additions, so that scalar and SIMD code agree bit for bit. */
static inline void aur_phase_sincos(uint64_t phase, double *sine, double *cosine) {
    const uint64_t quadrant = (phase + (UINT64_C(1) << 61)) >> 62;
    const double t = (double)(int64_t)(phase - (quadrant << 62)) * 0x1p-61;
    const double q = t * t;
    const double q2 = q * q;
    const double q4 = q2 * q2;
    /* by pairs (Estrin), whose chains of dependent operations are half as long as Horner's */
    const double s01 = AUR_PHASE_SINE_1 * q + AUR_PHASE_SINE_0;
    const double s23 = AUR_PHASE_SINE_3 * q + AUR_PHASE_SINE_2;
    const double s45 = AUR_PHASE_SINE_5 * q + AUR_PHASE_SINE_4;
    const double s46 = AUR_PHASE_SINE_6 * q2 + s45;
    const double s = (s46 * q4 + (s23 * q2 + s01)) * t;
    const double c01 = AUR_PHASE_COSINE_1 * q + 1.0;
    const double c23 = AUR_PHASE_COSINE_3 * q + AUR_PHASE_COSINE_2;
    const double c45 = AUR_PHASE_COSINE_5 * q + AUR_PHASE_COSINE_4;
    const double c67 = AUR_PHASE_COSINE_7 * q + AUR_PHASE_COSINE_6;
    const double c = (c67 * q2 + c45) * q4 + (c23 * q2 + c01);
    const double turned_sine = (quadrant & 1) != 0 ? c : s;
    const double turned_cosine = (quadrant & 1) != 0 ? s : c;
    *sine = (quadrant & 2) != 0 ? -turned_sine : turned_sine;
    *cosine = ((quadrant + 1) & 2) != 0 ? -turned_cosine : turned_cosine;
}
