/* The plain form of the kernels. */
#include "points/pointset/runs.h"

#include "points/pointset/words.h"

static void multiples(aur_multiples *run, size_t count, double *out) {
    const double divisor = (double)(int64_t)run->size;
    uint64_t position = run->position;
    for (size_t i = 0; i < count; ++i) {
        out[i] = (double)(int64_t)position / divisor;
        position += run->step;
        position -= position >= run->size ? run->size : 0;
    }
    run->position = position;
}

static void fractions(aur_multiples_of_fraction *run, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = aur_word_to_double(run->start + aur_phase(run->step, run->first + i));
    run->first += count;
}

static void hashes(aur_hashes *run, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = aur_word_to_double(aur_hash2(run->stream, run->first + i));
    run->first += count;
}

static void quotients(double base, const double *numerators, double divisor, size_t count, double *out) {
    for (size_t i = 0; i < count; ++i)
        out[i] = (base + numerators[i]) / divisor;
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

static void end_stream(void) {
}

const aur_run_kernels aur_runs_portable = AUR_RUN_KERNELS;
