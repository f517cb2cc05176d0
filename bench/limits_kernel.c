/* Compiled once for each instruction set. */
#include <math.h>

#include "limits_kernels.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
enum { WIDTH = 64 };
#elif defined(__AVX2__)
enum { WIDTH = 32 };
#else
enum { WIDTH = 16 };
#endif

typedef double wide_f64 __attribute__((vector_size(WIDTH)));
typedef float wide_f32 __attribute__((vector_size(WIDTH)));
enum { LANES_F64 = WIDTH / sizeof(double), LANES_F32 = WIDTH / sizeof(float) };

static inline void store_stream(double *to, wide_f64 value) {
#if defined(__AVX512F__)
    _mm512_stream_pd(to, value);
#elif defined(__AVX2__)
    _mm256_stream_pd(to, value);
#elif defined(__SSE2__)
    _mm_stream_pd(to, value);
#else
    *(wide_f64 *)to = value;
#endif
}

static inline void end_stream(void) {
#if defined(__SSE2__)
    _mm_sfence();
#endif
}

static void fill(size_t count, double *values) {
    const wide_f64 value = (wide_f64){0} + 0.3;
    for (size_t i = 0; i < count; i += LANES_F64)
        *(wide_f64 *)(values + i) = value;
}

static void fill_stream(size_t count, double *values) {
    const wide_f64 value = (wide_f64){0} + 0.3;
    for (size_t i = 0; i < count; i += LANES_F64)
        store_stream(values + i, value);
    end_stream();
}

static void copy(size_t count, const double *from, double *to) {
    for (size_t i = 0; i < count; i += LANES_F64)
        *(wide_f64 *)(to + i) = *(const wide_f64 *)(from + i);
}

static void copy_stream(size_t count, const double *from, double *to) {
    for (size_t i = 0; i < count; i += LANES_F64)
        store_stream(to + i, *(const wide_f64 *)(from + i));
    end_stream();
}

/* Eight independent sums: enough to saturate the loads. */
static double read(size_t count, const double *values) {
    wide_f64 sums[8] = {0};
    for (size_t i = 0; i < count; i += 8 * LANES_F64)
        for (size_t k = 0; k < 8; ++k)
            sums[k] += *(const wide_f64 *)(values + i + k * LANES_F64);
    double sum = 0.0;
    for (size_t k = 0; k < 8; ++k)
        for (size_t lane = 0; lane < LANES_F64; ++lane)
            sum += sums[k][lane];
    return sum;
}

/* x <- 0.5 x + c in independent chains; each converges to 2 c. */
static double fma_f32(size_t rounds) {
    wide_f32 chains[BENCH_FMA_ACCUMULATORS] = {0};
    const wide_f32 half = (wide_f32){0} + 0.5f;
    wide_f32 offset = {0};
    for (size_t lane = 0; lane < LANES_F32; ++lane)
        offset[lane] = (float)(lane + 1);
    for (size_t i = 0; i < rounds; ++i)
        for (size_t k = 0; k < BENCH_FMA_ACCUMULATORS; ++k)
            chains[k] = chains[k] * half + offset;
    wide_f32 sum = {0};
    for (size_t k = 0; k < BENCH_FMA_ACCUMULATORS; ++k)
        sum += chains[k];
    return (double)sum[LANES_F32 - 1];
}

static double fma_f64(size_t rounds) {
    wide_f64 chains[BENCH_FMA_ACCUMULATORS] = {0};
    const wide_f64 half = (wide_f64){0} + 0.5;
    wide_f64 offset = {0};
    for (size_t lane = 0; lane < LANES_F64; ++lane)
        offset[lane] = (double)(lane + 1);
    for (size_t i = 0; i < rounds; ++i)
        for (size_t k = 0; k < BENCH_FMA_ACCUMULATORS; ++k)
            chains[k] = chains[k] * half + offset;
    wide_f64 sum = {0};
    for (size_t k = 0; k < BENCH_FMA_ACCUMULATORS; ++k)
        sum += chains[k];
    return sum[LANES_F64 - 1];
}

static double pairs_f32(size_t count, const float *xyz) {
    const float *const x = xyz, *const y = xyz + count, *const z = xyz + 2 * count;
    double total = 0.0;
    for (size_t i = 0; i < count; ++i) {
        float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
        for (size_t j = 0; j < count; ++j) {
            const float dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
            sum += sqrtf(dx * dx + dy * dy + dz * dz);
        }
        total += (double)sum;
    }
    return total;
}

static double pairs_f64(size_t count, const double *xyz) {
    const double *const x = xyz, *const y = xyz + count, *const z = xyz + 2 * count;
    double total = 0.0;
    for (size_t i = 0; i < count; ++i) {
        double sum = 0.0;
#pragma omp simd reduction(+ : sum)
        for (size_t j = 0; j < count; ++j) {
            const double dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
            sum += sqrt(dx * dx + dy * dy + dz * dz);
        }
        total += sum;
    }
    return total;
}

const bench_kernels AUR_KERNEL(bench_kernels) = {fill,    fill_stream, copy,      copy_stream, read,
                                                 fma_f32, fma_f64,     pairs_f32, pairs_f64,   WIDTH};
