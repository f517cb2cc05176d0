#if defined(__x86_64__)

#include <stdbool.h>

#include "sphere/phase_avx512.h"
#include "sphere/sets/fibonacci_kernels.h"

/* Eight x, y and z to eight triples in three registers. */
static inline void interleave(__m512d x, __m512d y, __m512d z, __m512d out[3]) {
    const __m512i first_xy = _mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10);
    const __m512i first_z = _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7);
    const __m512i second_xy = _mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5);
    const __m512i second_z = _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7);
    const __m512i third_xy = _mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0);
    const __m512i third_z = _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15);
    out[0] = _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, first_xy, y), first_z, z);
    out[1] = _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, second_xy, y), second_z, z);
    out[2] = _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, third_xy, y), third_z, z);
}

void aur_fibonacci_points_avx512(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    const bool stream = count >= AUR_FIBONACCI_STREAM_BYTES / (3 * sizeof *xyz);
    if (stream) {
        /* to the next cache line: 24 bytes a point reach every multiple of 8 within 64 */
        size_t head = 0;
        while (head < 8 && ((uintptr_t)(xyz + 3 * head) & 63) != 0)
            ++head;
        aur_fibonacci_points_portable(set, first, head, xyz);
        first += head;
        count -= head;
        xyz += 3 * head;
    }
    const bool aligned = ((uintptr_t)xyz & 63) == 0;
    const __m512i lanes = _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7);
    __m512i phase = _mm512_add_epi64(_mm512_set1_epi64((int64_t)(set->phase + first * AUR_GOLDEN_PHASE)),
                                     _mm512_mullo_epi64(lanes, _mm512_set1_epi64((int64_t)AUR_GOLDEN_PHASE)));
    const __m512i phase_step = _mm512_set1_epi64((int64_t)(8 * AUR_GOLDEN_PHASE));
    __m512d index = _mm512_add_pd(_mm512_set1_pd((double)first), _mm512_cvtepi64_pd(lanes));
    const __m512d offset = _mm512_set1_pd(set->offset);
    const __m512d scale = _mm512_set1_pd(set->step);
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        __m512d sine, cosine, out[3];
        aur_phase_sincos8(phase, &sine, &cosine);
        const __m512d depth = _mm512_mul_pd(_mm512_add_pd(index, offset), scale);
        const __m512d radius =
            _mm512_sqrt_pd(_mm512_mul_pd(depth, _mm512_sub_pd(_mm512_set1_pd(2.0), depth)));
        interleave(_mm512_mul_pd(radius, cosine), _mm512_mul_pd(radius, sine),
                   _mm512_sub_pd(_mm512_set1_pd(1.0), depth), out);
        double *const to = xyz + 3 * i;
        if (stream && aligned) {
            _mm512_stream_pd(to, out[0]);
            _mm512_stream_pd(to + 8, out[1]);
            _mm512_stream_pd(to + 16, out[2]);
        } else {
            _mm512_storeu_pd(to, out[0]);
            _mm512_storeu_pd(to + 8, out[1]);
            _mm512_storeu_pd(to + 16, out[2]);
        }
        phase = _mm512_add_epi64(phase, phase_step);
        index = _mm512_add_pd(index, _mm512_set1_pd(8.0));
    }
    if (stream)
        _mm_sfence();
    aur_fibonacci_points_portable(set, first + i, count - i, xyz + 3 * i);
}

#else

#include "sphere/sets/fibonacci_kernels.h"

/* Never chosen on other processors. */
void aur_fibonacci_points_avx512(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    aur_fibonacci_points_portable(set, first, count, xyz);
}

#endif
