#if defined(__x86_64__)

#include <immintrin.h>
#include <stdbool.h>

#include "sphere/phase.h"
#include "sphere/sets/fibonacci_kernels.h"

/* a b + c, rounded twice as in aur_phase_sincos */
static inline __m256d step(__m256d a, __m256d b, __m256d c) {
    return _mm256_add_pd(_mm256_mul_pd(a, b), c);
}

static inline __m256d pair(double high, __m256d q, double low) {
    return step(_mm256_set1_pd(high), q, _mm256_set1_pd(low));
}

/* Signed 64-bit integers to doubles, rounded once: the halves become the mantissas of 2^84 and 2^52. */
static inline __m256d to_double(__m256i value) {
    const __m256i high =
        _mm256_xor_si256(_mm256_srli_epi64(value, 32), _mm256_set1_epi64x(INT64_C(0x4530000080000000)));
    const __m256i low = _mm256_blend_epi32(value, _mm256_set1_epi64x(INT64_C(0x4330000000000000)), 0xaa);
    const __m256d upper = _mm256_sub_pd(_mm256_castsi256_pd(high), _mm256_set1_pd(0x1p84 + 0x1p63 + 0x1p52));
    return _mm256_add_pd(upper, _mm256_castsi256_pd(low));
}

/* aur_phase_sincos, four at a time */
static inline void sincos4(__m256i phase, __m256d *sine, __m256d *cosine) {
    const __m256i quadrant =
        _mm256_srli_epi64(_mm256_add_epi64(phase, _mm256_set1_epi64x(INT64_C(1) << 61)), 62);
    const __m256i rest = _mm256_sub_epi64(phase, _mm256_slli_epi64(quadrant, 62));
    const __m256d t = _mm256_mul_pd(to_double(rest), _mm256_set1_pd(0x1p-61));
    const __m256d q = _mm256_mul_pd(t, t);
    const __m256d q2 = _mm256_mul_pd(q, q);
    const __m256d q4 = _mm256_mul_pd(q2, q2);
    const __m256d s01 = pair(AUR_PHASE_SINE_1, q, AUR_PHASE_SINE_0);
    const __m256d s23 = pair(AUR_PHASE_SINE_3, q, AUR_PHASE_SINE_2);
    const __m256d s45 = pair(AUR_PHASE_SINE_5, q, AUR_PHASE_SINE_4);
    const __m256d s46 = step(_mm256_set1_pd(AUR_PHASE_SINE_6), q2, s45);
    const __m256d s = _mm256_mul_pd(step(s46, q4, step(s23, q2, s01)), t);
    const __m256d c01 = pair(AUR_PHASE_COSINE_1, q, 1.0);
    const __m256d c23 = pair(AUR_PHASE_COSINE_3, q, AUR_PHASE_COSINE_2);
    const __m256d c45 = pair(AUR_PHASE_COSINE_5, q, AUR_PHASE_COSINE_4);
    const __m256d c67 = pair(AUR_PHASE_COSINE_7, q, AUR_PHASE_COSINE_6);
    const __m256d c = step(step(c67, q2, c45), q4, step(c23, q2, c01));
    /* the lowest bit of the quadrant as the sign of a lane, which is what blends look at */
    const __m256d odd = _mm256_castsi256_pd(_mm256_slli_epi64(quadrant, 63));
    const __m256i sign_bit = _mm256_set1_epi64x(INT64_MIN);
    const __m256i sine_sign = _mm256_and_si256(_mm256_slli_epi64(quadrant, 62), sign_bit);
    const __m256i next = _mm256_add_epi64(quadrant, _mm256_set1_epi64x(1));
    const __m256i cosine_sign = _mm256_and_si256(_mm256_slli_epi64(next, 62), sign_bit);
    *sine = _mm256_xor_pd(_mm256_blendv_pd(s, c, odd), _mm256_castsi256_pd(sine_sign));
    *cosine = _mm256_xor_pd(_mm256_blendv_pd(c, s, odd), _mm256_castsi256_pd(cosine_sign));
}

/* Four x, y and z to four triples in three registers. */
static inline void interleave(__m256d x, __m256d y, __m256d z, __m256d out[3]) {
    const __m256d xy = _mm256_unpacklo_pd(x, y);   /* x0 y0 x2 y2 */
    const __m256d yz = _mm256_unpackhi_pd(y, z);   /* y1 z1 y3 z3 */
    const __m256d zx = _mm256_blend_pd(z, x, 10);  /* z0 x1 z2 x3 */
    out[0] = _mm256_permute2f128_pd(xy, zx, 0x20); /* x0 y0 z0 x1 */
    out[1] = _mm256_permute2f128_pd(yz, xy, 0x30); /* y1 z1 x2 y2 */
    out[2] = _mm256_permute2f128_pd(zx, yz, 0x31); /* z2 x3 y3 z3 */
}

void aur_fibonacci_points_avx2(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    const bool stream = count >= AUR_FIBONACCI_STREAM_BYTES / (3 * sizeof *xyz);
    if (stream) {
        size_t head = 0;
        while (head < 8 && ((uintptr_t)(xyz + 3 * head) & 63) != 0)
            ++head;
        aur_fibonacci_points_portable(set, first, head, xyz);
        first += head;
        count -= head;
        xyz += 3 * head;
    }
    const bool aligned = ((uintptr_t)xyz & 31) == 0;
    const uint64_t start = set->phase + first * AUR_GOLDEN_PHASE;
    __m256i phase =
        _mm256_setr_epi64x((int64_t)start, (int64_t)(start + AUR_GOLDEN_PHASE),
                           (int64_t)(start + 2 * AUR_GOLDEN_PHASE), (int64_t)(start + 3 * AUR_GOLDEN_PHASE));
    const __m256i phase_step = _mm256_set1_epi64x((int64_t)(4 * AUR_GOLDEN_PHASE));
    __m256d index = _mm256_add_pd(_mm256_set1_pd((double)first), _mm256_setr_pd(0.0, 1.0, 2.0, 3.0));
    const __m256d offset = _mm256_set1_pd(set->offset);
    const __m256d scale = _mm256_set1_pd(set->step);
    size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        __m256d sine, cosine, out[3];
        sincos4(phase, &sine, &cosine);
        const __m256d depth = _mm256_mul_pd(_mm256_add_pd(index, offset), scale);
        const __m256d radius =
            _mm256_sqrt_pd(_mm256_mul_pd(depth, _mm256_sub_pd(_mm256_set1_pd(2.0), depth)));
        interleave(_mm256_mul_pd(radius, cosine), _mm256_mul_pd(radius, sine),
                   _mm256_sub_pd(_mm256_set1_pd(1.0), depth), out);
        double *const to = xyz + 3 * i;
        if (stream && aligned) {
            _mm256_stream_pd(to, out[0]);
            _mm256_stream_pd(to + 4, out[1]);
            _mm256_stream_pd(to + 8, out[2]);
        } else {
            _mm256_storeu_pd(to, out[0]);
            _mm256_storeu_pd(to + 4, out[1]);
            _mm256_storeu_pd(to + 8, out[2]);
        }
        phase = _mm256_add_epi64(phase, phase_step);
        index = _mm256_add_pd(index, _mm256_set1_pd(4.0));
    }
    if (stream)
        _mm_sfence();
    aur_fibonacci_points_portable(set, first + i, count - i, xyz + 3 * i);
}

#else

#include "sphere/sets/fibonacci_kernels.h"

/* Never chosen on other processors. */
void aur_fibonacci_points_avx2(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    aur_fibonacci_points_portable(set, first, count, xyz);
}

#endif
