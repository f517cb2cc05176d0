/* Azimuths in 64-bit fixed point: a phase counts 2^-64 turns and wraps around, so that adding and multiplying
 * by an index are exact. */
#pragma once

#include <math.h>
#include <stdint.h>

#include "points/pointset/fraction128.h"

/* The golden angle, 1/Phi turns, rounded to the nearest phase: 2.6e-21 turn too much. (The constant without
 * the rounding, ...7c15, is 5.2e-20 turn short: at 43,000 points the azimuths differ by more than a double's
 * last digits.) */
#define AUR_GOLDEN_PHASE (AUR_GOLDEN_HIGH + (AUR_GOLDEN_LOW >> 63))

/* The fraction of `turns`, exact to 2^-64 turn. Any finite number is allowed. */
static inline uint64_t aur_phase_from_turns(double turns) {
    const double fraction = turns - floor(turns);
    return fraction < 1.0 ? (uint64_t)(fraction * 0x1p64) : 0;
}

#define REAL double
#define NAME aur_phase_eighth
#include "points/sphere/phase_body.h"

/* Sine and cosine of a phase to 2e-16: exact reduction to an eighth of a turn, then the polynomials. */
static inline void aur_phase_sincos(uint64_t phase, double *sine, double *cosine) {
    const uint64_t quadrant = (phase + (UINT64_C(1) << 61)) >> 62;
    const double t = (double)(int64_t)(phase - (quadrant << 62)) * 0x1p-61;
    double s, c;
    aur_phase_eighth(t, &s, &c);
    const double turned_sine = (quadrant & 1) != 0 ? c : s;
    const double turned_cosine = (quadrant & 1) != 0 ? s : c;
    *sine = (quadrant & 2) != 0 ? -turned_sine : turned_sine;
    *cosine = ((quadrant + 1) & 2) != 0 ? -turned_cosine : turned_cosine;
}
