/* The inner loops of the samplers that need no table, for each instruction set; all give the same bits. */
#pragma once

#include "points/base/simd.h"
#include "points/pointset/net_2d.h"
#include "render/sampling/stream.h"

struct aur_stream_kernels {
    /* The pairs first .. first + AUR_STREAM_BLOCK - 1. */
    void (*pairs)(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]);
    /* One pair for sample `index` of `count` pixels. */
    void (*pixels)(size_t count, const uint64_t *pixels, uint32_t index, uint32_t pair, float *u, float *v);
    /* The same for sample indices[k] of pixel k. */
    void (*samples)(size_t count, const uint64_t *pixels, const uint32_t *indices, uint32_t pair, float *u,
                    float *v);
    /* One pair, with its hash of pixel and dimension, for `count` samples. */
    void (*indices)(uint64_t hash, size_t count, const uint32_t *indices, float *u, float *v);
};

typedef struct aur_stream_kernel_sets {
    aur_stream_kernels sobol, random;
} aur_stream_kernel_sets;

AUR_KERNELS(const aur_stream_kernel_sets, aur_stream_kernels);

/* The pair of floats in [0,1) of a sample, from its bit-reversed index and a hash of pixel and dimension. The
 * index is scrambled so that aligned blocks of a power of two are shuffled: every such block remains a net
 * (Burley 2020). In bit-reversed form the first coordinate is the index itself. */
static inline void aur_sobol_pair(uint32_t reversed_index, uint64_t hash, float *u, float *v) {
    const uint32_t index = aur_reverse_bits(aur_nested_hash(reversed_index, (uint32_t)aur_mix64(hash + 1)));
    const uint32_t x = aur_nested_hash(index, (uint32_t)hash);
    const uint32_t y = aur_nested_hash(aur_sobol_second_reversed(index), (uint32_t)(hash >> 32));
    *u = aur_unit_float(aur_reverse_bits(x));
    *v = aur_unit_float(aur_reverse_bits(y));
}

static inline void aur_random_pair(uint32_t index, uint64_t hash, float *u, float *v) {
    const uint64_t number = aur_hash2(hash, index);
    *u = aur_unit_float((uint32_t)number);
    *v = aur_unit_float((uint32_t)(number >> 32));
}
