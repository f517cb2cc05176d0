/* Sobol and random pairs, eight of one pixel or one of many pixels at once. Integer arithmetic and one exact
 * conversion: results are bit-identical for all instruction sets. */
#include "render/sampling/stream_kernels.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#if AUR_KERNEL_WIDE && defined(__AVX512F__)

/* Eight pairs fill a register, which halves the time of the compiler's code for the loop below. */

static inline __m512i every64(uint64_t word) {
    return _mm512_set1_epi64((long long)word);
}

static inline __m512i every32(uint32_t word) {
    return _mm512_set1_epi32((int)word);
}

/* aur_mix64. */
static inline __m512i mix64(__m512i x) {
    x = _mm512_xor_si512(x, _mm512_srli_epi64(x, 30));
    x = _mm512_mullo_epi64(x, every64(UINT64_C(0xbf58476d1ce4e5b9)));
    x = _mm512_xor_si512(x, _mm512_srli_epi64(x, 27));
    x = _mm512_mullo_epi64(x, every64(UINT64_C(0x94d049bb133111eb)));
    return _mm512_xor_si512(x, _mm512_srli_epi64(x, 31));
}

/* Bits of every 32-bit lane, by bytes and a table of halves of bytes. */
static inline __m512i reverse_bits(__m512i x) {
    const __m512i nibble = every32(0x0f0f0f0fu);
    const __m512i low = _mm512_broadcast_i32x4(
        _mm_setr_epi32((int)0xc0408000u, (int)0xe060a020u, (int)0xd0509010u, (int)0xf070b030u));
    const __m512i high =
        _mm512_broadcast_i32x4(_mm_setr_epi32(0x0c040800, 0x0e060a02, 0x0d050901, 0x0f070b03));
    const __m512i bytes =
        _mm512_broadcast_i32x4(_mm_setr_epi32(0x00010203, 0x04050607, 0x08090a0b, 0x0c0d0e0f));
    const __m512i first = _mm512_shuffle_epi8(low, _mm512_and_si512(x, nibble));
    const __m512i second = _mm512_shuffle_epi8(high, _mm512_and_si512(_mm512_srli_epi16(x, 4), nibble));
    return _mm512_shuffle_epi8(_mm512_or_si512(first, second), bytes);
}

/* aur_nested_hash. */
static inline __m512i nested_hash(__m512i x, __m512i seed) {
    x = _mm512_xor_si512(x, _mm512_mullo_epi32(x, every32(0x3d20adeau)));
    x = _mm512_add_epi32(x, seed);
    x = _mm512_mullo_epi32(x, _mm512_or_si512(_mm512_srli_epi32(seed, 16), every32(1)));
    x = _mm512_xor_si512(x, _mm512_mullo_epi32(x, every32(0x05526c56u)));
    return _mm512_xor_si512(x, _mm512_mullo_epi32(x, every32(0x53a22864u)));
}

/* aur_sobol_second_reversed. */
static inline __m512i second_reversed(__m512i x) {
    x = _mm512_xor_si512(x, _mm512_and_si512(_mm512_srli_epi32(x, 1), every32(0x55555555u)));
    x = _mm512_xor_si512(x, _mm512_and_si512(_mm512_srli_epi32(x, 2), every32(0x33333333u)));
    x = _mm512_xor_si512(x, _mm512_and_si512(_mm512_srli_epi32(x, 4), every32(0x0f0f0f0fu)));
    x = _mm512_xor_si512(x, _mm512_and_si512(_mm512_srli_epi32(x, 8), every32(0x00ff00ffu)));
    return _mm512_xor_si512(x, _mm512_srli_epi32(x, 16));
}

/* A 64-bit lane is a pair: the first coordinate in its lower half, the second in its upper, as they are
 * stored. */
static void sobol_pairs(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]) {
    /* aur_hash2(stream->pixel, pair) for each lane. */
    const uint64_t pixel = aur_mix64(stream->pixel + UINT64_C(0x9e3779b97f4a7c15));
    const __m512i pairs = _mm512_add_epi64(every64(first), _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7));
    const __m512i spread = _mm512_mullo_epi64(pairs, every64(UINT64_C(0xd6e8feb86659fd93)));
    const __m512i seeds = mix64(_mm512_xor_si512(every64(pixel), spread));
    const __m512i other = mix64(_mm512_add_epi64(seeds, every64(1)));
    /* Both halves need the index. */
    const __m512i seed_indices = _mm512_shuffle_epi32(other, _MM_PERM_CCAA);
    const __m512i reversed = reverse_bits(every32(stream->index));
    const __m512i index = reverse_bits(nested_hash(reversed, seed_indices));
    const __m512i coordinates = _mm512_mask_mov_epi32(index, 0xaaaa, second_reversed(index));
    const __m512i words = reverse_bits(nested_hash(coordinates, seeds));
    const __m512 values =
        _mm512_mul_ps(_mm512_cvtepi32_ps(_mm512_srli_epi32(words, 8)), _mm512_set1_ps(0x1p-24f));
    _mm512_storeu_ps(u, values);
}

#else

static void sobol_pairs(const aur_stream *stream, uint32_t first, float pairs[AUR_STREAM_BLOCK][2]) {
    const uint32_t reversed = aur_reverse_bits(stream->index);
    const uint64_t pixel = stream->pixel;
    float u[AUR_STREAM_BLOCK], v[AUR_STREAM_BLOCK];
    for (uint32_t i = 0; i < AUR_STREAM_BLOCK; ++i)
        aur_sobol_pair(reversed, aur_hash2(pixel, first + i), &u[i], &v[i]);
    for (size_t i = 0; i < AUR_STREAM_BLOCK; ++i) {
        pairs[i][0] = u[i];
        pairs[i][1] = v[i];
    }
}

#endif

static void sobol_pixels(size_t count, const uint64_t *restrict pixels, uint32_t index, uint32_t pair,
                         float *restrict u, float *restrict v) {
    const uint32_t reversed = aur_reverse_bits(index);
    for (size_t k = 0; k < count; ++k)
        aur_sobol_pair(reversed, aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

static void sobol_samples(size_t count, const uint64_t *restrict pixels, const uint32_t *restrict indices,
                          uint32_t pair, float *restrict u, float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        aur_sobol_pair(aur_reverse_bits(indices[k]), aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

static void sobol_indices(uint64_t hash, size_t count, const uint32_t *restrict indices, float *restrict u,
                          float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        aur_sobol_pair(aur_reverse_bits(indices[k]), hash, &u[k], &v[k]);
}

static void random_pairs(const aur_stream *stream, uint32_t first, float pairs[AUR_STREAM_BLOCK][2]) {
    const uint32_t index = stream->index;
    const uint64_t pixel = stream->pixel;
    float u[AUR_STREAM_BLOCK], v[AUR_STREAM_BLOCK];
    for (uint32_t i = 0; i < AUR_STREAM_BLOCK; ++i)
        aur_random_pair(index, aur_hash2(pixel, first + i), &u[i], &v[i]);
    for (size_t i = 0; i < AUR_STREAM_BLOCK; ++i) {
        pairs[i][0] = u[i];
        pairs[i][1] = v[i];
    }
}

static void random_pixels(size_t count, const uint64_t *restrict pixels, uint32_t index, uint32_t pair,
                          float *restrict u, float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        aur_random_pair(index, aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

static void random_samples(size_t count, const uint64_t *restrict pixels, const uint32_t *restrict indices,
                           uint32_t pair, float *restrict u, float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        aur_random_pair(indices[k], aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

static void random_indices(uint64_t hash, size_t count, const uint32_t *restrict indices, float *restrict u,
                           float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        aur_random_pair(indices[k], hash, &u[k], &v[k]);
}

const aur_stream_kernel_sets AUR_KERNEL(aur_stream_kernels) = {
    {sobol_pairs, sobol_pixels, sobol_samples, sobol_indices},
    {random_pairs, random_pixels, random_samples, random_indices}};
