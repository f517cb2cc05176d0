/* Runs of one coordinate, and two of them side by side: a plain form and one for wide registers,
 * which write the same bits. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "points/pointset/fraction128.h"

/* A golden set's coordinate in ascending order: the values start + aur_phase(aur_golden_fraction, i) of the
 * indices i < count of the series i, i + step, ... modulo `modulus`. */
typedef struct aur_ascent {
    uint64_t start, count, step, modulus;
    uint64_t index; /* where the series goes on */
} aur_ascent;

enum {
    AUR_RUN_SLACK = 16, /* numbers behind those of a run of an ascent that it may write, too */
    AUR_RUN_GROUP = 32  /* a run that goes on later stops after a multiple of it */
};

/* The fractions (position + i step) modulo size, / size, rounded; position, step < size <= 2^48. */
typedef struct aur_multiples {
    uint64_t position, step, size;
    bool started; /* the kernel's own from here on */
    double jump, inverse;
    double positions[AUR_RUN_GROUP];
} aur_multiples;

/* The values aur_word_to_double(start + aur_phase(step, first + i)). */
typedef struct aur_multiples_of_fraction {
    aur_fraction128 step;
    uint64_t start, first;
    bool started; /* the kernel's own from here on */
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
    /* Values of the ascent, until there is no room for as many as may come at once (AUR_RUN_SLACK); returns
     * how many it wrote. */
    size_t (*ascent)(aur_ascent *ascent, size_t capacity, double *out);
    /* out[i] = (base + numerators[i]) / divisor, rounded; whole numbers, base + numerators[i] < divisor <=
     * 2^53. */
    void (*quotients)(double base, const double *numerators, double divisor, size_t count, double *out);
    /* out[2 i] = x[i], out[2 i + 1] = y[i]; `stream` goes past the caches, for which `out` is a multiple of
     * 64 bytes, and end_stream() is called after the last ones. */
    void (*pairs)(size_t count, const double *x, const double *y, bool stream, double *out);
    void (*end_stream)(void);
} aur_run_kernels;

AUR_KERNELS(const aur_run_kernels, aur_runs);

/* The kernels for runs that have `count` values in all. */
static inline const aur_run_kernels *aur_runs(size_t count) {
    return count < AUR_RUN_GROUP / 2 ? &aur_runs_portable : &AUR_KERNEL_HERE(aur_runs);
}
