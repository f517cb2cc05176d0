/* Vectors of doubles and of 64-bit words as wide as the instruction set that the including file is compiled
 * for: the compiler's own vector types, whose operators work lane by lane on every processor, and what they
 * lack. Sums, products and roots are rounded as those of single numbers are, so that all widths give the same
 * bits. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__x86_64__)
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
typedef uint32_t aur_halves __attribute__((vector_size(8 * AUR_LANES))); /* two a word */

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
    double roots[AUR_LANES]; /* gcc makes one instruction of a loop over an array only */
    memcpy(roots, &x, sizeof roots);
    for (unsigned l = 0; l < AUR_LANES; ++l)
        roots[l] = sqrt(roots[l]);
    memcpy(&x, roots, sizeof x);
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

/* Writes one number, as aur_lanes_put does, at any address. */
static inline void aur_lanes_put_one(double *to, double value, bool stream) {
#if defined(__AVX2__)
    if (stream) {
        long long bits;
        memcpy(&bits, &value, sizeof bits);
        _mm_stream_si64((long long *)(void *)to, bits);
        return;
    }
#endif
    (void)stream;
    *to = value;
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
/* Every second lane of a and b, interleaved: a0, b0, a2, b2, ..., and a1, b1, a3, b3, ... */
static inline aur_reals aur_lanes_even(aur_reals a, aur_reals b) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
#elif defined(__AVX2__)
    return __builtin_shufflevector(a, b, 0, 4, 2, 6);
#else
    return __builtin_shufflevector(a, b, 0, 2);
#endif
}

static inline aur_reals aur_lanes_odd(aur_reals a, aur_reals b) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
#elif defined(__AVX2__)
    return __builtin_shufflevector(a, b, 1, 5, 3, 7);
#else
    return __builtin_shufflevector(a, b, 1, 3);
#endif
}

/* Words of halves: in each 128 bits the low and high halves low0, high0, low1, high1 of the first two halves
 * of either, and of the last two. */
static inline aur_words aur_lanes_first_words(aur_halves low, aur_halves high) {
#if defined(__AVX512F__)
    return (aur_words)__builtin_shufflevector(low, high, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13,
                                              29);
#elif defined(__AVX2__)
    return (aur_words)__builtin_shufflevector(low, high, 0, 8, 1, 9, 4, 12, 5, 13);
#else
    return (aur_words)__builtin_shufflevector(low, high, 0, 4, 1, 5);
#endif
}

static inline aur_words aur_lanes_last_words(aur_halves low, aur_halves high) {
#if defined(__AVX512F__)
    return (aur_words)__builtin_shufflevector(low, high, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30,
                                              15, 31);
#elif defined(__AVX2__)
    return (aur_words)__builtin_shufflevector(low, high, 2, 10, 3, 11, 6, 14, 7, 15);
#else
    return (aur_words)__builtin_shufflevector(low, high, 2, 6, 3, 7);
#endif
}

/* The 32 bits of each half in the reverse order: nibbles by a table, then bytes. */
static inline aur_halves aur_lanes_reverse_bits(aur_halves x) {
#if defined(__AVX2__)
    static const uint8_t reversed[16] = {0x0, 0x8, 0x4, 0xc, 0x2, 0xa, 0x6, 0xe,
                                         0x1, 0x9, 0x5, 0xd, 0x3, 0xb, 0x7, 0xf};
    static const uint8_t bytes[16] = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    const __m128i table = _mm_loadu_si128((const __m128i *)(const void *)reversed);
    const __m128i order = _mm_loadu_si128((const __m128i *)(const void *)bytes);
    const aur_halves low = x & 0x0f0f0f0f;
    const aur_halves high = x >> 4 & 0x0f0f0f0f;
#if defined(__AVX512BW__)
    const __m512i tables = _mm512_broadcast_i32x4(table);
    const aur_halves nibbles = (aur_halves)_mm512_shuffle_epi8(tables, (__m512i)low) << 4 |
                               (aur_halves)_mm512_shuffle_epi8(tables, (__m512i)high);
    return (aur_halves)_mm512_shuffle_epi8((__m512i)nibbles, _mm512_broadcast_i32x4(order));
#else
    const __m256i tables = _mm256_broadcastsi128_si256(table);
    const aur_halves nibbles = (aur_halves)_mm256_shuffle_epi8(tables, (__m256i)low) << 4 |
                               (aur_halves)_mm256_shuffle_epi8(tables, (__m256i)high);
    return (aur_halves)_mm256_shuffle_epi8((__m256i)nibbles, _mm256_broadcastsi128_si256(order));
#endif
#else
    x = (x >> 1 & 0x55555555) | (x & 0x55555555) << 1;
    x = (x >> 2 & 0x33333333) | (x & 0x33333333) << 2;
    x = (x >> 4 & 0x0f0f0f0f) | (x & 0x0f0f0f0f) << 4;
    x = (x >> 8 & 0x00ff00ff) | (x & 0x00ff00ff) << 8;
    return x >> 16 | x << 16;
#endif
}

/* Ends a run of streamed stores, of a file for any instruction set: other threads see them in order from here
 * on. */
static inline void aur_lanes_end_stream(void) {
#if defined(__x86_64__)
    _mm_sfence();
#endif
}
