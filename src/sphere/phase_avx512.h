/* aur_phase_sincos, eight at a time. */
#ifndef AUR_SPHERE_PHASE_AVX512_H
#define AUR_SPHERE_PHASE_AVX512_H

#include <immintrin.h>

#include "sphere/phase.h"

/* a b + c, rounded twice as in aur_phase_sincos */
static inline __m512d aur_phase_step8(__m512d a, __m512d b, __m512d c) {
    return _mm512_add_pd(_mm512_mul_pd(a, b), c);
}

static inline __m512d aur_phase_pair8(double high, __m512d q, double low) {
    return aur_phase_step8(_mm512_set1_pd(high), q, _mm512_set1_pd(low));
}

/* aur_phase_sincos, eight at a time */
static inline void aur_phase_sincos8(__m512i phase, __m512d *sine, __m512d *cosine) {
    const __m512i quadrant =
        _mm512_srli_epi64(_mm512_add_epi64(phase, _mm512_set1_epi64(INT64_C(1) << 61)), 62);
    const __m512i rest = _mm512_sub_epi64(phase, _mm512_slli_epi64(quadrant, 62));
    const __m512d t = _mm512_mul_pd(_mm512_cvtepi64_pd(rest), _mm512_set1_pd(0x1p-61));
    const __m512d q = _mm512_mul_pd(t, t);
    const __m512d q2 = _mm512_mul_pd(q, q);
    const __m512d q4 = _mm512_mul_pd(q2, q2);
    const __m512d s01 = aur_phase_pair8(AUR_PHASE_SINE_1, q, AUR_PHASE_SINE_0);
    const __m512d s23 = aur_phase_pair8(AUR_PHASE_SINE_3, q, AUR_PHASE_SINE_2);
    const __m512d s45 = aur_phase_pair8(AUR_PHASE_SINE_5, q, AUR_PHASE_SINE_4);
    const __m512d s46 = aur_phase_step8(_mm512_set1_pd(AUR_PHASE_SINE_6), q2, s45);
    const __m512d s = _mm512_mul_pd(aur_phase_step8(s46, q4, aur_phase_step8(s23, q2, s01)), t);
    const __m512d c01 = aur_phase_pair8(AUR_PHASE_COSINE_1, q, 1.0);
    const __m512d c23 = aur_phase_pair8(AUR_PHASE_COSINE_3, q, AUR_PHASE_COSINE_2);
    const __m512d c45 = aur_phase_pair8(AUR_PHASE_COSINE_5, q, AUR_PHASE_COSINE_4);
    const __m512d c67 = aur_phase_pair8(AUR_PHASE_COSINE_7, q, AUR_PHASE_COSINE_6);
    const __m512d c = aur_phase_step8(aur_phase_step8(c67, q2, c45), q4, aur_phase_step8(c23, q2, c01));
    const __mmask8 odd = _mm512_test_epi64_mask(quadrant, _mm512_set1_epi64(1));
    const __m512i sign_bit = _mm512_set1_epi64(INT64_MIN);
    const __m512i sine_sign = _mm512_and_si512(_mm512_slli_epi64(quadrant, 62), sign_bit);
    const __m512i next = _mm512_add_epi64(quadrant, _mm512_set1_epi64(1));
    const __m512i cosine_sign = _mm512_and_si512(_mm512_slli_epi64(next, 62), sign_bit);
    *sine = _mm512_castsi512_pd(
        _mm512_xor_si512(_mm512_castpd_si512(_mm512_mask_blend_pd(odd, s, c)), sine_sign));
    *cosine = _mm512_castsi512_pd(
        _mm512_xor_si512(_mm512_castpd_si512(_mm512_mask_blend_pd(odd, c, s)), cosine_sign));
}

#endif
