#include "pointset/digits/digital_kernels.h"

#if defined(__AVX512F__)
#include <immintrin.h>

#define BITS 4

typedef __m512i integers;
typedef __m512d reals;

static inline integers load(const void *from) {
    return _mm512_loadu_si512(from);
}

static inline integers every32(uint32_t word) {
    return _mm512_set1_epi32((int)word);
}

static inline integers every64(uint64_t word) {
    return _mm512_set1_epi64((long long)word);
}

static inline integers exclusive_or(integers a, integers b) {
    return _mm512_xor_si512(a, b);
}

static inline integers and_bits(integers a, integers b) {
    return _mm512_and_si512(a, b);
}

static inline integers or_bits(integers a, integers b) {
    return _mm512_or_si512(a, b);
}

static inline integers choose(integers mask, integers a, integers b) {
    return _mm512_ternarylogic_epi64(mask, a, b, 0xca);
}

static inline integers add32(integers a, integers b) {
    return _mm512_add_epi32(a, b);
}

static inline integers multiply32(integers a, integers b) {
    return _mm512_mullo_epi32(a, b);
}

static inline integers left32(integers x, unsigned n) {
    return _mm512_slli_epi32(x, n);
}

static inline integers right32(integers x, unsigned n) {
    return _mm512_srli_epi32(x, n);
}

static inline integers table16(const uint8_t bytes[16]) {
    return _mm512_broadcast_i32x4(_mm_loadu_si128((const __m128i *)(const void *)bytes));
}

static inline integers shuffle_bytes(integers table, integers x) {
    return _mm512_shuffle_epi8(table, x);
}

static inline integers unpack_low32(integers a, integers b) {
    return _mm512_unpacklo_epi32(a, b);
}

static inline integers unpack_high32(integers a, integers b) {
    return _mm512_unpackhi_epi32(a, b);
}

static inline reals unpack_low64(reals a, reals b) {
    return _mm512_unpacklo_pd(a, b);
}

static inline reals unpack_high64(reals a, reals b) {
    return _mm512_unpackhi_pd(a, b);
}

static inline reals to_double(integers word) {
    return _mm512_mul_pd(_mm512_cvtepu64_pd(_mm512_srli_epi64(word, 11)), _mm512_set1_pd(0x1p-53));
}

static inline void store(double *out, reals values, bool stream) {
    if (stream)
        _mm512_stream_pd(out, values);
    else
        _mm512_store_pd(out, values);
}

#include "pointset/digits/digital_body.h"

size_t aur_digital_run_avx512(const aur_digital_run *run) {
    return run_kernel(run);
}

#else

size_t aur_digital_run_avx512(const aur_digital_run *run) {
    (void)run;
    return 0;
}

#endif
