#include "sampling/stream_pixels.h"

void aur_sobol_pixels_avx2(size_t count, const uint64_t *pixels, uint32_t index, uint32_t pair, float *u,
                           float *v) {
    sobol_pixels(count, pixels, index, pair, u, v);
}
