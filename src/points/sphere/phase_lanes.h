/* aur_phase_sincos for all lanes of a vector: the same operations, so bit-identical. */
#pragma once

#include "points/base/simd_lanes.h"
#include "points/sphere/phase.h"

#define REAL aur_reals
#define NAME aur_phase_eighth_lanes
#include "points/sphere/phase_body.h"

static inline void aur_phase_sincos_lanes(aur_words phase, aur_reals *sine, aur_reals *cosine) {
    const aur_words quadrant = (phase + (UINT64_C(1) << 61)) >> 62;
    const aur_reals t = aur_lanes_from_signed(phase - (quadrant << 62)) * 0x1p-61;
    aur_reals s, c;
    aur_phase_eighth_lanes(t, &s, &c);
    /* odd quadrants exchange the two, and bits of the quadrant are their signs */
    const aur_words odd = -(quadrant & 1);
    const uint64_t sign = UINT64_C(1) << 63;
    *sine = (aur_reals)((aur_words)aur_lanes_choose(odd, c, s) ^ (quadrant << 62 & sign));
    *cosine = (aur_reals)((aur_words)aur_lanes_choose(odd, s, c) ^ ((quadrant + 1) << 62 & sign));
}
