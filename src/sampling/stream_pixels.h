/* The body of one Sobol pair of many pixels at once, compiled once for each instruction set. Integers only,
 * and one exact conversion: every set gives the same bits, and those of aur_stream_pair. */
#ifndef AUR_SAMPLING_STREAM_PIXELS_H
#define AUR_SAMPLING_STREAM_PIXELS_H

#include "core/random.h"
#include "pointset/net_2d.h"
#include "sampling/stream.h"

static inline void sobol_pixels(size_t count, const uint64_t *restrict pixels, uint32_t index, uint32_t pair,
                                float *restrict u, float *restrict v) {
    for (size_t k = 0; k < count; ++k) {
        const uint64_t hash = aur_hash2(pixels[k], pair);
        const uint32_t shuffled = aur_owen_scramble(index, (uint32_t)aur_mix64(hash + 1));
        u[k] = aur_unit_float(aur_owen_scramble(aur_sobol_first(shuffled), (uint32_t)hash));
        v[k] = aur_unit_float(aur_owen_scramble(aur_sobol_second(shuffled), (uint32_t)(hash >> 32)));
    }
}

void aur_sobol_pixels_avx2(size_t count, const uint64_t *pixels, uint32_t index, uint32_t pair, float *u,
                           float *v);
void aur_sobol_pixels_avx512(size_t count, const uint64_t *pixels, uint32_t index, uint32_t pair, float *u,
                             float *v);

#endif
