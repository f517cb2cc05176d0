/* Vectors of doubles and of 64-bit words as wide as the instruction set that the including file is compiled
 * for: the compiler's own vector types, whose operators work lane by lane on every processor, and what they
 * lack. Sums, products and roots are rounded as those of single numbers are, so that all widths give the same
 * bits. */
#ifndef AUR_CORE_SIMD_LANES_H
#define AUR_CORE_SIMD_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
enum { AUR_LANES = 8 };
#elif defined(__AVX2__)
enum { AUR_LANES = 4 };
#else
enum { AUR_LANES = 2 };
#endif

typedef double aur_reals __attribute__((vector_size(8 * AUR_LANES)));
typedef uint64_t aur_words __attribute__((vector_size(8 * AUR_LANES)));

/* 0, 1, 2, ... */
static inline aur_words aur_lanes_count(void) {
    aur_words count;
    for (unsigned l = 0; l < AUR_LANES; ++l)
        count[l] = l;
    return count;
}

/* a where the mask's bits are set, b elsewhere. */
static inline aur_reals aur_lanes_choose(aur_words mask, aur_reals a, aur_reals b) {
    return (aur_reals)((mask & (aur_words)a) | (~mask & (aur_words)b));
}

static inline aur_reals aur_lanes_sqrt(aur_reals x) {
#if defined(__AVX512F__)
    return (aur_reals)_mm512_sqrt_pd((__m512d)x);
#elif defined(__AVX2__)
    return (aur_reals)_mm256_sqrt_pd((__m256d)x);
#else
    for (unsigned l = 0; l < AUR_LANES; ++l)
        x[l] = sqrt(x[l]);
    return x;
#endif
}

/* Signed 64-bit integers to doubles, rounded once. Without an instruction for it the halves become the
 * mantissas of 2^84 and 2^52. */
static inline aur_reals aur_lanes_from_signed(aur_words x) {
#if defined(__AVX512DQ__)
    return (aur_reals)_mm512_cvtepi64_pd((__m512i)x);
#elif defined(__AVX2__)
    const aur_words high = x >> 32 ^ UINT64_C(0x4530000080000000);
    const aur_words low =
        (aur_words)_mm256_blend_epi32((__m256i)x, _mm256_set1_epi64x(INT64_C(0x4330000000000000)), 0xaa);
    return ((aur_reals)high - (0x1p84 + 0x1p63 + 0x1p52)) + (aur_reals)low;
#else
    aur_reals y;
    for (unsigned l = 0; l < AUR_LANES; ++l)
        y[l] = (double)(int64_t)x[l];
    return y;
#endif
}
/* Writes the lanes; `stream` goes past the caches, where the processor can and `to` is a multiple of the
 * vector. */
static inline void aur_lanes_put(double *to, aur_reals values, bool stream) {
#if defined(__AVX512F__)
    if (stream)
        _mm512_stream_pd(to, (__m512d)values);
    else
        _mm512_storeu_pd(to, (__m512d)values);
#elif defined(__AVX2__)
    if (stream)
        _mm256_stream_pd(to, (__m256d)values);
    else
        _mm256_storeu_pd(to, (__m256d)values);
#else
    (void)stream;
    memcpy(to, &values, sizeof values);
#endif
}

/* Writes x0, y0, z0, x1, y1, z1, ..., as aur_lanes_put does. */
static inline void aur_lanes_store3(double *to, aur_reals x, aur_reals y, aur_reals z, bool stream) {
#if defined(__AVX512F__)
    aur_lanes_put(to,
                  __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 8, 0, 1, 9, 0, 2, 10), z, 0, 1, 8,
                                          3, 4, 9, 6, 7),
                  stream);
    aur_lanes_put(to + 8,
                  __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 3, 11, 0, 4, 12, 0, 5), z, 10, 1,
                                          2, 11, 4, 5, 12, 7),
                  stream);
    aur_lanes_put(to + 16,
                  __builtin_shufflevector(__builtin_shufflevector(x, y, 13, 0, 6, 14, 0, 7, 15, 0), z, 0, 13,
                                          2, 3, 14, 5, 6, 15),
                  stream);
#elif defined(__AVX2__)
    const aur_reals xy = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const aur_reals yz = __builtin_shufflevector(y, z, 1, 5, 3, 7);
    const aur_reals zx = __builtin_shufflevector(z, x, 0, 5, 2, 7);
    aur_lanes_put(to, __builtin_shufflevector(xy, zx, 0, 1, 4, 5), stream);
    aur_lanes_put(to + 4, __builtin_shufflevector(yz, xy, 0, 1, 6, 7), stream);
    aur_lanes_put(to + 8, __builtin_shufflevector(zx, yz, 2, 3, 6, 7), stream);
#else
    (void)stream;
    for (unsigned l = 0; l < AUR_LANES; ++l) {
        to[3 * l] = x[l];
        to[3 * l + 1] = y[l];
        to[3 * l + 2] = z[l];
    }
#endif
}
/* Ends a run of streamed stores: other threads see them in order from here on. */
static inline void aur_lanes_end_stream(void) {
#if defined(__AVX2__)
    _mm_sfence();
#endif
}

#endif
