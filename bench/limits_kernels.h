/* The arithmetic and memory loops of limits.c: CMake compiles limits_kernel.c for each instruction set. */
#pragma once

#include <stddef.h>

#include "points/base/simd.h"

/* `count` is a multiple of 256 and every array is aligned to 64 bytes. */
typedef struct bench_kernels {
    void (*fill)(size_t count, double *values);
    void (*fill_stream)(size_t count, double *values);
    void (*copy)(size_t count, const double *from, double *to);
    void (*copy_stream)(size_t count, const double *from, double *to);
    double (*read)(size_t count, const double *values);
    /* bench_fma_flops_*(rounds) flops. */
    double (*fma_f32)(size_t rounds);
    double (*fma_f64)(size_t rounds);
    /* All count^2 ordered pairs; xyz holds count x, then count y, then count z. */
    double (*pairs_f32)(size_t count, const float *xyz);
    double (*pairs_f64)(size_t count, const double *xyz);
    size_t bytes; /* lanes of a register */
} bench_kernels;

AUR_KERNELS(const bench_kernels, bench_kernels);

enum { BENCH_FMA_ACCUMULATORS = 12 };
