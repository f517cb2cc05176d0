/* Runs of one coordinate, and two of them side by side: a plain form (runs.c) and one for wide registers
 * (runs_body.h), which write the same bits. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "core/simd.h"
#include "pointset/fraction128.h"

/* A golden set's coordinate in ascending order: the values start + aur_phase(aur_golden_fraction, i) of the
 * indices i < count of the series i, i + step, ... modulo `modulus`. */
typedef struct aur_ascent {
    uint64_t start, count, step, modulus;
    uint64_t index; /* where the series goes on */
} aur_ascent;

enum { AUR_RUN_SLACK = 16 }; /* numbers behind those of a run of an ascent that it may write, too */

typedef struct aur_run_kernels {
    /* out[i] = (position + i step) modulo size, / size, rounded; position, step < size <= 2^48. */
    void (*multiples)(uint64_t position, uint64_t step, uint64_t size, size_t count, double *out);
    /* out[i] = (base + numerators[i]) / divisor, rounded; whole numbers, base + numerators[i] < divisor <=
     * 2^53. */
    void (*quotients)(double base, const double *numerators, double divisor, size_t count, double *out);
    /* out[i] = aur_word_to_double(start + aur_phase(step, first + i)) */
    void (*recurrence)(uint64_t start, aur_fraction128 step, uint64_t first, size_t count, double *out);
    /* out[i] = aur_word_to_double(aur_hash2(stream, first + i)) */
    void (*hashes)(uint64_t stream, uint64_t first, size_t count, double *out);
    /* Values of the ascent, until there is no room for as many as may come at once (AUR_RUN_SLACK); returns
     * how many it wrote. */
    size_t (*ascent)(aur_ascent *ascent, size_t capacity, double *out);
    /* out[2 i] = x[i], out[2 i + 1] = y[i]; `stream` goes past the caches, for which `out` is a multiple of
     * 64 bytes. */
    void (*pairs)(size_t count, const double *x, const double *y, bool stream, double *out);
} aur_run_kernels;

/* What a file with one form has. */
#define AUR_RUN_KERNELS                                                                                      \
    { multiples, quotients, recurrence, hashes, ascent, pairs }

extern const aur_run_kernels aur_runs_portable, aur_runs_avx2, aur_runs_avx512;

static inline const aur_run_kernels *aur_runs(void) {
    return &AUR_KERNEL_HERE(aur_runs);
}
