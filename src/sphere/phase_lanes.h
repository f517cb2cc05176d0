/* aur_phase_sincos for all lanes of a vector: the same operations, so the same bits. */
#pragma once

#include "core/simd_lanes.h"
#include "sphere/phase.h"

static inline void aur_phase_sincos_lanes(aur_words phase, aur_reals *sine, aur_reals *cosine) {
    const aur_words quadrant = (phase + (UINT64_C(1) << 61)) >> 62;
    const aur_reals t = aur_lanes_from_signed(phase - (quadrant << 62)) * 0x1p-61;
    const aur_reals q = t * t;
    const aur_reals q2 = q * q;
    const aur_reals q4 = q2 * q2;
    const aur_reals s01 = AUR_PHASE_SINE_1 * q + AUR_PHASE_SINE_0;
    const aur_reals s23 = AUR_PHASE_SINE_3 * q + AUR_PHASE_SINE_2;
    const aur_reals s45 = AUR_PHASE_SINE_5 * q + AUR_PHASE_SINE_4;
    const aur_reals s46 = AUR_PHASE_SINE_6 * q2 + s45;
    const aur_reals s = (s46 * q4 + (s23 * q2 + s01)) * t;
    const aur_reals c01 = AUR_PHASE_COSINE_1 * q + 1.0;
    const aur_reals c23 = AUR_PHASE_COSINE_3 * q + AUR_PHASE_COSINE_2;
    const aur_reals c45 = AUR_PHASE_COSINE_5 * q + AUR_PHASE_COSINE_4;
    const aur_reals c67 = AUR_PHASE_COSINE_7 * q + AUR_PHASE_COSINE_6;
    const aur_reals c = (c67 * q2 + c45) * q4 + (c23 * q2 + c01);
    /* odd quadrants exchange the two, and bits of the quadrant are their signs */
    const aur_words odd = -(quadrant & 1);
    const uint64_t sign = UINT64_C(1) << 63;
    *sine = (aur_reals)((aur_words)aur_lanes_choose(odd, c, s) ^ (quadrant << 62 & sign));
    *cosine = (aur_reals)((aur_words)aur_lanes_choose(odd, s, c) ^ ((quadrant + 1) << 62 & sign));
}
