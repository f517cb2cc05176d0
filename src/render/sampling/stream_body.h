/* Sobol and random pairs, eight of one pixel or one of many pixels at once, compiled once for each
 * instruction set. Integers only, and one exact conversion: every set gives the same bits. */
#pragma once

#include "points/pointset/net_2d.h"
#include "render/sampling/stream_kernels.h"

/* The pair of floats in [0,1) of a sample, from its index with reversed bits and a hash of all else. An index
 * is scrambled so that aligned blocks of a power of two are shuffled and moved: every such block is a net
 * (Burley 2020). In the reversed words that hashing wants, the first coordinate is the index itself. */
static inline void aur_sobol_pair(uint32_t reversed_index, uint64_t hash, float *u, float *v) {
    const uint32_t index = aur_reverse_bits(aur_nested_hash(reversed_index, (uint32_t)aur_mix64(hash + 1)));
    const uint32_t x = aur_nested_hash(index, (uint32_t)hash);
    const uint32_t y = aur_nested_hash(aur_sobol_second_reversed(index), (uint32_t)(hash >> 32));
    *u = aur_unit_float(aur_reverse_bits(x));
    *v = aur_unit_float(aur_reverse_bits(y));
}

static inline void sobol_pairs(const aur_stream *stream, uint32_t first, float pairs[AUR_STREAM_BLOCK][2]) {
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

static inline void sobol_pixels(size_t count, const uint64_t *restrict pixels, uint32_t index, uint32_t pair,
                                float *restrict u, float *restrict v) {
    const uint32_t reversed = aur_reverse_bits(index);
    for (size_t k = 0; k < count; ++k)
        aur_sobol_pair(reversed, aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

static inline void random_pair(uint32_t index, uint64_t hash, float *u, float *v) {
    const uint64_t number = aur_hash2(hash, index);
    *u = aur_unit_float((uint32_t)number);
    *v = aur_unit_float((uint32_t)(number >> 32));
}

static inline void random_pairs(const aur_stream *stream, uint32_t first, float pairs[AUR_STREAM_BLOCK][2]) {
    const uint32_t index = stream->index;
    const uint64_t pixel = stream->pixel;
    float u[AUR_STREAM_BLOCK], v[AUR_STREAM_BLOCK];
    for (uint32_t i = 0; i < AUR_STREAM_BLOCK; ++i)
        random_pair(index, aur_hash2(pixel, first + i), &u[i], &v[i]);
    for (size_t i = 0; i < AUR_STREAM_BLOCK; ++i) {
        pairs[i][0] = u[i];
        pairs[i][1] = v[i];
    }
}

static inline void random_pixels(size_t count, const uint64_t *restrict pixels, uint32_t index, uint32_t pair,
                                 float *restrict u, float *restrict v) {
    for (size_t k = 0; k < count; ++k)
        random_pair(index, aur_hash2(pixels[k], pair), &u[k], &v[k]);
}

/* What a file that is compiled for an instruction set has. */
#define AUR_STREAM_KERNELS                                                                                   \
    {                                                                                                        \
        {sobol_pairs, sobol_pixels}, {                                                                       \
            random_pairs, random_pixels                                                                      \
        }                                                                                                    \
    }
