/* A .vol file in Mitsuba 3's format, created in memory. */
#pragma once

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { VOL_HEAD = 48 };

/* `values` has x * y * z * channels floats, x fastest. Returns the bytes, allocated with malloc. */
static inline char *vol_bytes(int32_t x, int32_t y, int32_t z, int32_t channels, const float *values,
                              size_t *size) {
    const size_t count = (size_t)x * (size_t)y * (size_t)z * (size_t)channels;
    const int32_t numbers[] = {1, x, y, z, channels};
    const float box[] = {0.0f, 0.0f, 0.0f, 2.0f, 4.0f, 8.0f};
    *size = VOL_HEAD + count * sizeof(float);
    char *const bytes = malloc(*size);
    memcpy(bytes, "VOL\3", 4);
    memcpy(bytes + 4, numbers, sizeof numbers);
    memcpy(bytes + 24, box, sizeof box);
    memcpy(bytes + VOL_HEAD, values, count * sizeof(float));
    return bytes;
}
