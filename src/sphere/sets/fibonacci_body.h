/* Spherical Fibonacci points, compiled for one instruction set by the file that includes this. */
#pragma once

#include "sphere/phase_lanes.h"
#include "sphere/sets/fibonacci.h"

static inline void fill_one_by_one(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const uint64_t j = first + i;
        const double depth = ((double)(int64_t)j + set->offset) * set->step;
        const double radius = sqrt(depth * (2.0 - depth));
        double sine, cosine;
        aur_phase_sincos(set->phase + j * AUR_GOLDEN_PHASE, &sine, &cosine);
        xyz[3 * i] = radius * cosine;
        xyz[3 * i + 1] = radius * sine;
        xyz[3 * i + 2] = 1.0 - depth;
    }
}

/* As many points as fill whole vectors; returns how many. */
static inline __attribute__((always_inline)) size_t fill_lanes(const aur_fibonacci *set, uint64_t first,
                                                               size_t count, bool stream, double *xyz) {
    const aur_words start = first + aur_lanes_count();
    aur_words phase = set->phase + start * AUR_GOLDEN_PHASE;
    aur_reals index = aur_lanes_from_signed(start);
    size_t i = 0;
    for (; i + AUR_LANES <= count; i += AUR_LANES) {
        const aur_reals depth = (index + set->offset) * set->step;
        const aur_reals radius = aur_lanes_sqrt(depth * (2.0 - depth));
        aur_reals sine, cosine;
        aur_phase_sincos_lanes(phase, &sine, &cosine);
        aur_lanes_store3(xyz + 3 * i, radius * cosine, radius * sine, 1.0 - depth, stream);
        phase += AUR_LANES * AUR_GOLDEN_PHASE;
        index += (double)AUR_LANES;
    }
    return i;
}

/* Many points go past the caches, from the first address on at which vectors lie on their multiples: every
 * eighth point begins where the first does, modulo 64 bytes. */
static inline void fill_points(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    size_t done = 0;
    while (done < 8 && done < count && ((uintptr_t)(xyz + 3 * done) & 63) != 0)
        ++done;
    if (count >= AUR_FIBONACCI_STREAM_BYTES / (3 * sizeof *xyz) && done < 8) {
        fill_one_by_one(set, first, done, xyz);
        done += fill_lanes(set, first + done, count - done, true, xyz + 3 * done);
        aur_lanes_end_stream();
    } else {
        done = fill_lanes(set, first, count, false, xyz);
    }
    fill_one_by_one(set, first + done, count - done, xyz + 3 * done);
}
