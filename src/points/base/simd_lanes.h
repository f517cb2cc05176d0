/* Vectors of doubles and of 64-bit words as wide as the instruction set that the including file is compiled
 * for: the compiler's vector types, whose operators work lane by lane on every processor, and additional
 * operations. Sums, products and roots are rounded like scalar ones, so that all widths are bit-identical. */
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
typedef uint32_t aur_halves __attribute__((vector_size(8 * AUR_LANES))); /* two per word */

/* 0, 1, 2, ... */
static inline aur_words aur_lanes_count(void) {
    aur_words count;
    for (unsigned l = 0; l < AUR_LANES; ++l)
        count[l] = l;
    return count;
}

static inline aur_reals aur_lanes_all(double x) {
    return (aur_reals){0} + x;
}

/* a where the mask's bits are set, b elsewhere. */
static inline aur_reals aur_lanes_choose(aur_words mask, aur_reals a, aur_reals b) {
    return (aur_reals)((mask & (aur_words)a) | (~mask & (aur_words)b));
}

static inline aur_reals aur_lanes_absolute(aur_reals x) {
    return (aur_reals)((aur_words)x & ~(UINT64_C(1) << 63));
}

static inline aur_reals aur_lanes_sqrt(aur_reals x) {
#if defined(__AVX512F__)
    return (aur_reals)_mm512_sqrt_pd((__m512d)x);
#elif defined(__AVX2__)
    return (aur_reals)_mm256_sqrt_pd((__m256d)x);
#else
    double roots[AUR_LANES]; /* gcc vectorises only a loop over an array */
    memcpy(roots, &x, sizeof roots);
    for (unsigned l = 0; l < AUR_LANES; ++l)
        roots[l] = sqrt(roots[l]);
    memcpy(&x, roots, sizeof x);
    return x;
#endif
}

static inline aur_reals aur_lanes_floor(aur_reals x) {
#if defined(__AVX512F__)
    return (aur_reals)_mm512_floor_pd((__m512d)x);
#elif defined(__AVX2__)
    return (aur_reals)_mm256_floor_pd((__m256d)x);
#else
    for (unsigned l = 0; l < AUR_LANES; ++l)
        x[l] = floor(x[l]);
    return x;
#endif
}

/* Integers from 0 to 2^52 as words: the mantissa of 2^52 + x is x. */
static inline aur_words aur_lanes_from_whole(aur_reals x) {
    return (aur_words)(x + 0x1p52) ^ UINT64_C(0x4330000000000000);
}

/* Signed 64-bit integers to doubles, rounded once. Without such an instruction the halves become the
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
static inline aur_reals aur_lanes_load(const double *from) {
    aur_reals values;
    memcpy(&values, from, sizeof values);
    return values;
}

/* Writes the lanes; `stream` bypasses the caches, if the processor supports it and `to` is aligned to the
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
/* The inverse of aur_lanes_store3. */
static inline void aur_lanes_load3(const double *from, aur_reals *x, aur_reals *y, aur_reals *z) {
#if defined(__AVX2__)
    aur_reals a, b, c;
    memcpy(&a, from, sizeof a);
    memcpy(&b, from + AUR_LANES, sizeof b);
    memcpy(&c, from + 2 * AUR_LANES, sizeof c);
#endif
#if defined(__AVX512F__)
    *x = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0), c, 0, 1, 2, 3, 4, 5,
                                 10, 13);
    *y = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0), c, 0, 1, 2, 3, 4, 8,
                                 11, 14);
    *z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0), c, 0, 1, 2, 3, 4, 9,
                                 12, 15);
#elif defined(__AVX2__)
    *x = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 0), c, 0, 1, 2, 5);
    *y = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 0), c, 0, 1, 2, 6);
    *z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 0, 0), c, 0, 1, 4, 7);
#else
    for (unsigned l = 0; l < AUR_LANES; ++l) {
        (*x)[l] = from[3 * l];
        (*y)[l] = from[3 * l + 1];
        (*z)[l] = from[3 * l + 2];
    }
#endif
}

/* table[at] of each lane. */
static inline aur_reals aur_lanes_look_up(const double *table, aur_words at) {
#if defined(__AVX512F__)
    return (aur_reals)_mm512_i64gather_pd((__m512i)at, table, 8);
#else
    aur_reals found;
    for (unsigned l = 0; l < AUR_LANES; ++l)
        found[l] = table[at[l]];
    return found;
#endif
}

/* Writes x0, y0, x1, y1, ..., as aur_lanes_put does. */
static inline void aur_lanes_store2(double *to, aur_reals x, aur_reals y, bool stream) {
#if defined(__AVX512F__)
    aur_lanes_put(to, __builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11), stream);
    aur_lanes_put(to + 8, __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15), stream);
#elif defined(__AVX2__)
    const aur_reals even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const aur_reals odd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    aur_lanes_put(to, __builtin_shufflevector(even, odd, 0, 1, 4, 5), stream);
    aur_lanes_put(to + 4, __builtin_shufflevector(even, odd, 2, 3, 6, 7), stream);
#else
    aur_lanes_put(to, __builtin_shufflevector(x, y, 0, 2), stream);
    aur_lanes_put(to + 2, __builtin_shufflevector(x, y, 1, 3), stream);
#endif
}

#if defined(__AVX2__)
/* Writes the lanes whose mask is set contiguously, and arbitrary values up to AUR_LANES numbers; returns the
 * number of lanes set. */
static inline size_t aur_lanes_compress(double *to, aur_words mask, aur_reals values) {
#if defined(__AVX512F__)
    const __mmask8 selected = _mm512_movepi64_mask((__m512i)mask);
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(selected, (__m512d)values));
    return (size_t)__builtin_popcount(selected);
#else
    /* For each mask the halves of its set lanes. */
    static const uint8_t halves[16][8] = {{0},
                                          {0, 1},
                                          {2, 3},
                                          {0, 1, 2, 3},
                                          {4, 5},
                                          {0, 1, 4, 5},
                                          {2, 3, 4, 5},
                                          {0, 1, 2, 3, 4, 5},
                                          {6, 7},
                                          {0, 1, 6, 7},
                                          {2, 3, 6, 7},
                                          {0, 1, 2, 3, 6, 7},
                                          {4, 5, 6, 7},
                                          {0, 1, 4, 5, 6, 7},
                                          {2, 3, 4, 5, 6, 7},
                                          {0, 1, 2, 3, 4, 5, 6, 7}};
    const unsigned selected = (unsigned)_mm256_movemask_pd((__m256d)mask);
    const __m256i order =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)halves[selected]));
    _mm256_storeu_pd(to, (__m256d)_mm256_permutevar8x32_epi32((__m256i)values, order));
    return (size_t)__builtin_popcount(selected);
#endif
}

/* Products of the lower halves of words. */
static inline aur_words aur_lanes_multiply_low(aur_words a, aur_words b) {
#if defined(__AVX512F__)
    return (aur_words)_mm512_mul_epu32((__m512i)a, (__m512i)b);
#else
    return (aur_words)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#endif
}

/* Integers below b, 0 < b <= 2^48, divided by b, whose rounded inverse is `inverse`: rounded as a division
 * is. The relative error of the first quotient q is at most 2^-52, so the remainder a - q b is an integer
 * multiple, below 2^53, of q's last place, and exact. The error of its correction is 2^-52 of a last place,
 * whereas a quotient of such numbers is at least 2^-49 of one away from a rounding boundary (after Markstein
 * 1990). */
static inline aur_reals aur_lanes_quotient(aur_reals a, aur_reals b, aur_reals inverse) {
#if defined(__AVX512F__)
    const __m512d q = (__m512d)(a * inverse);
    const __m512d rest = _mm512_fnmadd_pd(q, (__m512d)b, (__m512d)a);
    return (aur_reals)_mm512_fmadd_pd(rest, (__m512d)inverse, q);
#else
    const __m256d q = (__m256d)(a * inverse);
    const __m256d rest = _mm256_fnmadd_pd(q, (__m256d)b, (__m256d)a);
    return (aur_reals)_mm256_fmadd_pd(rest, (__m256d)inverse, q);
#endif
}
#endif

/* a, b, a, b, ... */
static inline aur_words aur_lanes_of_pair(const uint64_t pair[2]) {
#if defined(__AVX512F__)
    return (aur_words)_mm512_broadcast_i32x4(_mm_loadu_si128((const __m128i *)(const void *)pair));
#elif defined(__AVX2__)
    return (aur_words)_mm256_broadcastsi128_si256(_mm_loadu_si128((const __m128i *)(const void *)pair));
#else
    return (aur_words){pair[0], pair[1]};
#endif
}

/* The upper 53 bits as numbers in [0,1). Without such an instruction 21 and 32 of them become the mantissas
 * of 2^31 and 1/2, whose difference and sum are exact. */
static inline aur_reals aur_lanes_unit(aur_words x) {
#if defined(__AVX512DQ__)
    return (aur_reals)_mm512_cvtepi64_pd((__m512i)(x >> 11)) * 0x1p-53;
#else
    const aur_words high = x >> 43 | UINT64_C(0x41e0000000000000);
#if defined(__AVX2__)
    const aur_words low = (aur_words)_mm256_blend_epi32(
        (__m256i)(x >> 11), _mm256_set1_epi64x(INT64_C(0x3fe0000000000000)), 0xaa);
#else
    const aur_words low = (x >> 11 & 0xffffffff) | UINT64_C(0x3fe0000000000000);
#endif
    return ((aur_reals)high - (0x1p31 + 0.5)) + (aur_reals)low;
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
    static const uint8_t lower[16] = {0x0, 0x8, 0x4, 0xc, 0x2, 0xa, 0x6, 0xe,
                                      0x1, 0x9, 0x5, 0xd, 0x3, 0xb, 0x7, 0xf};
    static const uint8_t upper[16] = {0x00, 0x80, 0x40, 0xc0, 0x20, 0xa0, 0x60, 0xe0,
                                      0x10, 0x90, 0x50, 0xd0, 0x30, 0xb0, 0x70, 0xf0};
    static const uint8_t order[16] = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    const __m128i to_lower = _mm_loadu_si128((const __m128i *)(const void *)lower);
    const __m128i to_upper = _mm_loadu_si128((const __m128i *)(const void *)upper);
    const __m128i bytes = _mm_loadu_si128((const __m128i *)(const void *)order);
    const aur_halves low = x & 0x0f0f0f0f;
    const aur_halves high = x >> 4 & 0x0f0f0f0f;
#if defined(__AVX512BW__)
    const __m512i swapped =
        _mm512_or_si512(_mm512_shuffle_epi8(_mm512_broadcast_i32x4(to_upper), (__m512i)low),
                        _mm512_shuffle_epi8(_mm512_broadcast_i32x4(to_lower), (__m512i)high));
    return (aur_halves)_mm512_shuffle_epi8(swapped, _mm512_broadcast_i32x4(bytes));
#else
    const __m256i swapped =
        _mm256_or_si256(_mm256_shuffle_epi8(_mm256_broadcastsi128_si256(to_upper), (__m256i)low),
                        _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(to_lower), (__m256i)high));
    return (aur_halves)_mm256_shuffle_epi8(swapped, _mm256_broadcastsi128_si256(bytes));
#endif
#else
    x = (x >> 1 & 0x55555555) | (x & 0x55555555) << 1;
    x = (x >> 2 & 0x33333333) | (x & 0x33333333) << 2;
    x = (x >> 4 & 0x0f0f0f0f) | (x & 0x0f0f0f0f) << 4;
    x = (x >> 8 & 0x00ff00ff) | (x & 0x00ff00ff) << 8;
    return x >> 16 | x << 16;
#endif
}

/* Ends a run of streaming stores (any instruction set): other threads then see them in order. */
static inline void aur_lanes_end_stream(void) {
#if defined(__x86_64__)
    _mm_sfence();
#endif
}
