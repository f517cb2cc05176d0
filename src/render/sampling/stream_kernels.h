/* The inner loops of the samplers that need no table, for each instruction set; all give the same bits. */
#pragma once

#include "render/sampling/stream.h"

struct aur_stream_kernels {
    /* The pairs first .. first + AUR_STREAM_BLOCK - 1. */
    void (*pairs)(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]);
    /* One pair for sample `index` of `count` pixels. */
    void (*pixels)(size_t count, const uint64_t *pixels, uint32_t index, uint32_t pair, float *u, float *v);
};

typedef struct aur_stream_kernel_sets {
    aur_stream_kernels sobol, random;
} aur_stream_kernel_sets;

/* In plain C; in stream.c. */
extern const aur_stream_kernel_sets aur_stream_kernels_portable;
extern const aur_stream_kernel_sets aur_stream_kernels_avx2;
extern const aur_stream_kernel_sets aur_stream_kernels_avx512;
