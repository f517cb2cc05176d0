#include "sampling/stream_kernels.h"

#if defined(__AVX2__)
#include <immintrin.h>

/* Bits of every 32-bit lane, by bytes and a table of halves of bytes. */
static inline __m256i reverse_bits(__m256i x) {
    const __m256i nibble = _mm256_set1_epi8(0x0f);
    const __m256i low = _mm256_setr_epi8(
        0, (char)0x80, 0x40, (char)0xc0, 0x20, (char)0xa0, 0x60, (char)0xe0, 0x10, (char)0x90, 0x50,
        (char)0xd0, 0x30, (char)0xb0, 0x70, (char)0xf0, 0, (char)0x80, 0x40, (char)0xc0, 0x20, (char)0xa0,
        0x60, (char)0xe0, 0x10, (char)0x90, 0x50, (char)0xd0, 0x30, (char)0xb0, 0x70, (char)0xf0);
    const __m256i high = _mm256_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15, 0, 8, 4, 12,
                                          2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
    const __m256i bytes = _mm256_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12, 3, 2, 1, 0,
                                           7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12);
    const __m256i first = _mm256_shuffle_epi8(low, _mm256_and_si256(x, nibble));
    const __m256i second = _mm256_shuffle_epi8(high, _mm256_and_si256(_mm256_srli_epi16(x, 4), nibble));
    return _mm256_shuffle_epi8(_mm256_or_si256(first, second), bytes);
}

/* aur_nested_hash. */
static inline __m256i nested_hash(__m256i x, __m256i seed) {
    x = _mm256_xor_si256(x, _mm256_mullo_epi32(x, _mm256_set1_epi32(0x3d20adea)));
    x = _mm256_add_epi32(x, seed);
    x = _mm256_mullo_epi32(x, _mm256_or_si256(_mm256_srli_epi32(seed, 16), _mm256_set1_epi32(1)));
    x = _mm256_xor_si256(x, _mm256_mullo_epi32(x, _mm256_set1_epi32(0x05526c56)));
    return _mm256_xor_si256(x, _mm256_mullo_epi32(x, _mm256_set1_epi32(0x53a22864)));
}

/* aur_sobol_second_reversed. */
static inline __m256i second_reversed(__m256i x) {
    x = _mm256_xor_si256(x, _mm256_and_si256(_mm256_srli_epi32(x, 1), _mm256_set1_epi32(0x55555555)));
    x = _mm256_xor_si256(x, _mm256_and_si256(_mm256_srli_epi32(x, 2), _mm256_set1_epi32(0x33333333)));
    x = _mm256_xor_si256(x, _mm256_and_si256(_mm256_srli_epi32(x, 4), _mm256_set1_epi32(0x0f0f0f0f)));
    x = _mm256_xor_si256(x, _mm256_and_si256(_mm256_srli_epi32(x, 8), _mm256_set1_epi32(0x00ff00ff)));
    return _mm256_xor_si256(x, _mm256_srli_epi32(x, 16));
}

/* The lower half of a register holds the first coordinate of the four pairs, the upper half the second. */
static inline void four_pairs(const aur_stream *stream, uint32_t first, float u[4][2]) {
    const aur_pair_seeds a = aur_pair_seeds_of(stream, first), b = aur_pair_seeds_of(stream, first + 1);
    const aur_pair_seeds c = aur_pair_seeds_of(stream, first + 2), d = aur_pair_seeds_of(stream, first + 3);
    const __m256i even_first = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
    const __m256i even_twice = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
    const __m256i seeds =
        _mm256_permutevar8x32_epi32(_mm256_set_epi64x((long long)d.coordinates, (long long)c.coordinates,
                                                      (long long)b.coordinates, (long long)a.coordinates),
                                    even_first);
    const __m256i seed_indices = _mm256_permutevar8x32_epi32(
        _mm256_set_epi64x((long long)d.index, (long long)c.index, (long long)b.index, (long long)a.index),
        even_twice);
    const __m256i reversed = reverse_bits(_mm256_set1_epi32((int)stream->index));
    const __m256i index = reverse_bits(nested_hash(reversed, seed_indices));
    const __m256i coordinates = _mm256_blend_epi32(index, second_reversed(index), 0xf0);
    const __m256i words = reverse_bits(nested_hash(coordinates, seeds));
    const __m256 values =
        _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_srli_epi32(words, 8)), _mm256_set1_ps(0x1p-24f));
    const __m128 x = _mm256_castps256_ps128(values), y = _mm256_extractf128_ps(values, 1);
    _mm_storeu_ps(u[0], _mm_unpacklo_ps(x, y));
    _mm_storeu_ps(u[2], _mm_unpackhi_ps(x, y));
}

void aur_sobol_pairs_avx2(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]) {
    four_pairs(stream, first, u);
    four_pairs(stream, first + 4, u + 4);
}

#else

void aur_sobol_pairs_avx2(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]) {
    aur_sobol_pairs_portable(stream, first, u);
}

#endif
