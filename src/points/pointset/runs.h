/* Runs of one coordinate, and interleaving of two: a plain form and vector kernels, which are bit-identical.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "points/pointset/fraction128.h"

/* A golden set's coordinate in ascending order: the values start + aur_phase(aur_golden_fraction, i) of the
 * indices i < count of the series i, i + step, ... modulo `modulus`. */
typedef struct aur_ascent {
    uint64_t start, count, step, modulus;
    uint64_t index; /* the next index of the series */
} aur_ascent;

enum {
    AUR_RUN_SLACK = 16, /* numbers that a run of an ascent may write beyond its end */
    AUR_RUN_GROUP = 32  /* a run that is continued stops at a multiple of it */
};

/* The fractions (position + i step) modulo size, / size, rounded; position, step < size <= 2^48. */
typedef struct aur_multiples {
    uint64_t position, step, size;
    bool started; /* private to the kernel from here on */
    double jump, inverse;
    double positions[AUR_RUN_GROUP];
} aur_multiples;

/* The values aur_word_to_double(start + aur_phase(step, first + i)). */
typedef struct aur_multiples_of_fraction {
    aur_fraction128 step;
    uint64_t start, first;
    bool started; /* private to the kernel from here on */
    uint64_t low[AUR_RUN_GROUP], high[AUR_RUN_GROUP];
} aur_multiples_of_fraction;

/* The values aur_word_to_double(aur_hash2(stream, first + i)). */
typedef struct aur_hashes {
    uint64_t stream, first;
} aur_hashes;

typedef struct aur_run_kernels {
    /* The next `count` values. */
    void (*multiples)(aur_multiples *run, size_t count, double *out);
    void (*fractions)(aur_multiples_of_fraction *run, size_t count, double *out);
    void (*hashes)(aur_hashes *run, size_t count, double *out);
    /* Writes values of the ascent, until fewer than AUR_RUN_SLACK fit; returns their number. */
    size_t (*ascent)(aur_ascent *ascent, size_t capacity, double *out);
    /* out[i] = (base + numerators[i]) / divisor, rounded; integers, base + numerators[i] < divisor <= 2^53.
     */
    void (*quotients)(double base, const double *numerators, double divisor, size_t count, double *out);
    /* out[2 i] = x[i], out[2 i + 1] = y[i]; `stream` bypasses the caches; `out` is then aligned to 64 bytes,
     * and end_stream() is called after the last pairs. */
    void (*pairs)(size_t count, const double *x, const double *y, bool stream, double *out);
    void (*end_stream)(void);
} aur_run_kernels;

AUR_KERNELS(const aur_run_kernels, aur_runs);

/* The kernels for runs of `count` values in total. */
static inline const aur_run_kernels *aur_runs(size_t count) {
    return count < AUR_RUN_GROUP / 2 ? &aur_runs_portable : &AUR_KERNEL_HERE(aur_runs);
}
