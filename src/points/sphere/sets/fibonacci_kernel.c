#include "points/sphere/phase_lanes.h"
#include "points/sphere/sets/fibonacci.h"

enum { BASES = 8 }; /* blocks whose first azimuths are computed together, minus one */

/* The azimuths at which blocks begin. */
typedef struct bases {
    double cosines[BASES], sines[BASES];
} bases;

static inline void find_bases(const aur_fibonacci *set, uint64_t block, size_t count, bases *found) {
    for (size_t b = 0; b < count; b += AUR_LANES) {
        const aur_words start = (block + b + aur_lanes_count()) * AUR_FIBONACCI_BLOCK;
        aur_reals sine, cosine;
        aur_phase_sincos_lanes(set->phase + start * AUR_GOLDEN_PHASE, &sine, &cosine);
        memcpy(found->cosines + b, &cosine, sizeof cosine);
        memcpy(found->sines + b, &sine, sizeof sine);
    }
}

/* `value` in all lanes. Subtracting 0 preserves the sign of a zero. */
static inline aur_reals everywhere(double value) {
    return value - (aur_reals){0};
}

static inline aur_reals lanes_of(const double *from) {
    aur_reals values;
    memcpy(&values, from, sizeof values);
    return values;
}

/* AUR_LANES points from `index` on; the first is number k of its block. */
static inline __attribute__((always_inline)) void put_lanes(const aur_fibonacci *set, aur_reals index,
                                                            size_t k, aur_reals cosine, aur_reals sine,
                                                            bool stream, double *xyz) {
    const aur_reals depth = (index + set->offset) * set->step;
    const aur_reals radius = aur_lanes_sqrt(depth * (2.0 - depth));
    const aur_reals turn_cosine = lanes_of(aur_golden_cosines + k);
    const aur_reals turn_sine = lanes_of(aur_golden_sines + k);
    aur_lanes_store3(xyz, radius * (cosine * turn_cosine - sine * turn_sine),
                     radius * (sine * turn_cosine + cosine * turn_sine), 1.0 - depth, stream);
}

/* Writes the points that fill whole vectors; returns their number. A vector may span two blocks. */
static inline __attribute__((always_inline)) size_t fill_lanes(const aur_fibonacci *set, uint64_t first,
                                                               size_t count, bool stream, double *xyz) {
    const size_t vectors = count / AUR_LANES * AUR_LANES;
    aur_reals index = aur_lanes_from_signed(first + aur_lanes_count());
    size_t b = BASES - 1;
    bases base;
    for (size_t i = 0; i < vectors; ++b) {
        size_t k = (first + i) % AUR_FIBONACCI_BLOCK;
        if (b == BASES - 1) {
            const size_t blocks = (k + (vectors - i) - 1) / AUR_FIBONACCI_BLOCK + 1;
            find_bases(set, (first + i) / AUR_FIBONACCI_BLOCK, blocks < BASES ? blocks : BASES, &base);
            b = 0;
        }
        const aur_reals cosine = everywhere(base.cosines[b]), sine = everywhere(base.sines[b]);
        for (; k + AUR_LANES <= AUR_FIBONACCI_BLOCK && i < vectors; k += AUR_LANES, i += AUR_LANES) {
            put_lanes(set, index, k, cosine, sine, stream, xyz + 3 * i);
            index += (double)AUR_LANES;
        }
        if (k < AUR_FIBONACCI_BLOCK && i < vectors) {
            const aur_words here = aur_lanes_count() + k < AUR_FIBONACCI_BLOCK;
            put_lanes(set, index, k, aur_lanes_choose(here, cosine, everywhere(base.cosines[b + 1])),
                      aur_lanes_choose(here, sine, everywhere(base.sines[b + 1])), stream, xyz + 3 * i);
            index += (double)AUR_LANES;
            i += AUR_LANES;
        }
    }
    return vectors;
}

/* Points in vectors; the last may be partial, and its other lanes repeat a point. No scalar code: with -mfma
 * gcc 12 fuses the complex product in spite of -ffp-contract=off. */
static inline void fill_some(const aur_fibonacci *set, uint64_t first, size_t count, bool stream,
                             double *xyz) {
    const aur_words last = first + count - 1 + (aur_words){0};
    for (size_t i = 0; i < count; i += AUR_LANES) {
        const aur_words ahead = first + i + aur_lanes_count();
        const aur_words within = (aur_words)(ahead < last);
        const aur_words j = (ahead & within) | (last & ~within);
        aur_reals sine, cosine;
        aur_phase_sincos_lanes(set->phase + j / AUR_FIBONACCI_BLOCK * AUR_FIBONACCI_BLOCK * AUR_GOLDEN_PHASE,
                               &sine, &cosine);
        double points[3 * AUR_LANES];
        put_lanes(set, aur_lanes_from_signed(j), (first + i) % AUR_FIBONACCI_BLOCK, cosine, sine, false,
                  points);
        for (size_t d = 0; d < 3 * AUR_LANES && d < 3 * (count - i); ++d)
            aur_lanes_put_one(xyz + 3 * i + d, points[d], stream);
    }
}

/* Streaming begins at the first aligned address: every eighth point has the alignment of the first, modulo 64
 * bytes. */
void AUR_KERNEL(aur_fibonacci_points)(const aur_fibonacci *set, uint64_t first, size_t count, bool stream,
                                      double *xyz) {
    size_t done = 0;
    if (stream) {
        while (done < count && ((uintptr_t)(xyz + 3 * done) & 63) != 0)
            ++done;
        fill_some(set, first, done, true, xyz);
        done += fill_lanes(set, first + done, count - done, true, xyz + 3 * done);
    } else {
        done = fill_lanes(set, first, count, false, xyz);
    }
    fill_some(set, first + done, count - done, stream, xyz + 3 * done);
}
