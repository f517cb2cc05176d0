#include "pointset/digits/digital_kernels.h"

#if defined(__AVX2__)
#include <immintrin.h>

#define BITS 3

typedef __m256i integers;
typedef __m256d reals;

static inline integers load(const void *from) {
    return _mm256_loadu_si256(from);
}

static inline integers every32(uint32_t word) {
    return _mm256_set1_epi32((int)word);
}

static inline integers every64(uint64_t word) {
    return _mm256_set1_epi64x((long long)word);
}

static inline integers exclusive_or(integers a, integers b) {
    return _mm256_xor_si256(a, b);
}

static inline integers and_bits(integers a, integers b) {
    return _mm256_and_si256(a, b);
}

static inline integers or_bits(integers a, integers b) {
    return _mm256_or_si256(a, b);
}

static inline integers choose(integers mask, integers a, integers b) {
    return _mm256_blendv_epi8(b, a, mask);
}

static inline integers add32(integers a, integers b) {
    return _mm256_add_epi32(a, b);
}

static inline integers multiply32(integers a, integers b) {
    return _mm256_mullo_epi32(a, b);
}

static inline integers left32(integers x, int n) {
    return _mm256_slli_epi32(x, n);
}

static inline integers right32(integers x, int n) {
    return _mm256_srli_epi32(x, n);
}

static inline integers table16(const uint8_t bytes[16]) {
    return _mm256_broadcastsi128_si256(_mm_loadu_si128((const __m128i *)(const void *)bytes));
}

static inline integers shuffle_bytes(integers table, integers x) {
    return _mm256_shuffle_epi8(table, x);
}

static inline integers unpack_low32(integers a, integers b) {
    return _mm256_unpacklo_epi32(a, b);
}

static inline integers unpack_high32(integers a, integers b) {
    return _mm256_unpackhi_epi32(a, b);
}

static inline reals unpack_low64(reals a, reals b) {
    return _mm256_unpacklo_pd(a, b);
}

static inline reals unpack_high64(reals a, reals b) {
    return _mm256_unpackhi_pd(a, b);
}

/* Below 2^53 a word is the exact sum of two doubles, each made by putting 32 of its bits into a mantissa. */
static inline reals to_double(integers word) {
    const integers bits = _mm256_srli_epi64(word, 11);
    const integers low = _mm256_blend_epi32(bits, every64(0x4330000000000000), 0xaa); /* 2^52 + low */
    const integers high =
        or_bits(_mm256_srli_epi64(bits, 32), every64(0x4530000000000000)); /* 2^84 + 2^32 high */
    const reals sum = _mm256_add_pd(_mm256_sub_pd(_mm256_castsi256_pd(high), _mm256_set1_pd(0x1p84 + 0x1p52)),
                                    _mm256_castsi256_pd(low));
    return _mm256_mul_pd(sum, _mm256_set1_pd(0x1p-53));
}

static inline void store(double *out, reals values, bool stream) {
    if (stream)
        _mm256_stream_pd(out, values);
    else
        _mm256_store_pd(out, values);
}

#include "pointset/digits/digital_body.h"

size_t aur_digital_run_avx2(const aur_digital_run *run) {
    return run_kernel(run);
}

#else

size_t aur_digital_run_avx2(const aur_digital_run *run) {
    (void)run;
    return 0;
}

#endif
