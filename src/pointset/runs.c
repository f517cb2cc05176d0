/* The plain form of the kernels. */
#include "pointset/runs.h"

#include "pointset/words.h"

static void multiples(uint64_t position, uint64_t step, uint64_t size, size_t count, double *out) {
    const double divisor = (double)(int64_t)size;
    for (size_t i = 0; i < count; ++i) {
        out[i] = (double)(int64_t)position / divisor;
        position += step;
        position -= position >= size ? size : 0;
    }
}

static void quotients(double base, const double *numerators, double divisor, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = (base + numerators[i]) / divisor;
}

static void recurrence(uint64_t start, aur_fraction128 step, uint64_t first, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = aur_word_to_double(start + aur_phase(step, first + i));
}

static void hashes(uint64_t stream, uint64_t first, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = aur_word_to_double(aur_hash2(stream, first + i));
}

static size_t ascent(aur_ascent *ascent, size_t capacity, double *out) {
    uint64_t index = ascent->index;
    size_t made = 0;
    while (made + AUR_RUN_SLACK <= capacity) {
        out[made] = aur_word_to_double(ascent->start + aur_phase(aur_golden_fraction, index));
        made += index < ascent->count;
        index += ascent->step;
        index -= index >= ascent->modulus ? ascent->modulus : 0;
    }
    ascent->index = index;
    return made;
}

static void pairs(size_t count, const double *x, const double *y, bool stream, double *out) {
    (void)stream;
    for (size_t i = 0; i < count; ++i) {
        out[2 * i] = x[i];
        out[2 * i + 1] = y[i];
    }
}

const aur_run_kernels aur_runs_portable = AUR_RUN_KERNELS;
