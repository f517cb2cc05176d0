/* The kernels of runs.h for wide registers, compiled for one instruction set by the file that includes this.
 */
#pragma once

#include "core/random.h"
#include "core/simd_lanes.h"
#include "pointset/runs.h"

/* Vectors that are made at once, so that what each waits for is hidden by the others. */
enum { VECTORS = 4, GROUP = VECTORS * AUR_LANES };

static inline aur_reals load(const double *from) {
    aur_reals vector;
    memcpy(&vector, from, sizeof vector);
    return vector;
}

static inline void put_group(const aur_reals values[VECTORS], size_t count, double *out) {
    if (count >= GROUP) {
        for (unsigned v = 0; v < VECTORS; ++v)
            aur_lanes_put(out + v * AUR_LANES, values[v], false);
        return;
    }
    double rest[GROUP];
    for (unsigned v = 0; v < VECTORS; ++v)
        aur_lanes_put(rest + v * AUR_LANES, values[v], false);
    memcpy(out, rest, count * sizeof *out);
}

/* Whole numbers below 2^53 are added exactly. */
static void multiples(uint64_t position, uint64_t step, uint64_t size, size_t count, double *out) {
    const aur_reals zero = {0};
    const double modulus = (double)(int64_t)size;
    const double inverse = 1.0 / modulus;
    double starts[GROUP];
    uint64_t next = position;
    for (unsigned k = 0; k < GROUP; ++k) {
        starts[k] = (double)(int64_t)next;
        next += step;
        next -= next >= size ? size : 0;
    }
    /* From group to group, less the size: at most 0. */
    const double jump =
        next >= position ? (double)(int64_t)(next - position) - modulus : -(double)(int64_t)(position - next);
    aur_reals positions[VECTORS];
    for (unsigned v = 0; v < VECTORS; ++v)
        positions[v] = load(starts + v * AUR_LANES);
    for (size_t i = 0; i < count; i += GROUP) {
        aur_reals values[VECTORS];
        for (unsigned v = 0; v < VECTORS; ++v) {
            values[v] = aur_lanes_quotient(positions[v], zero + modulus, zero + inverse);
            const aur_reals moved = positions[v] + jump;
            positions[v] = moved + (aur_reals)((aur_words)(moved < zero) & (aur_words)(zero + modulus));
        }
        put_group(values, count - i, out + i);
    }
}

static void quotients(double base, const double *numerators, double divisor, size_t count, double *out) {
    const aur_reals zero = {0};
    const double inverse = 1.0 / divisor;
    size_t i = 0;
    if (divisor <= 0x1p48)
        for (; i + AUR_LANES <= count; i += AUR_LANES)
            aur_lanes_put(out + i,
                          aur_lanes_quotient(base + load(numerators + i), zero + divisor, zero + inverse),
                          false);
    for (; i < count; ++i)
        out[i] = (base + numerators[i]) / divisor;
}

/* Phases in two words, whose lower one has its sign flipped: whether it overflows, signed numbers tell. */
static void recurrence(uint64_t start, aur_fraction128 step, uint64_t first, size_t count, double *out) {
    typedef int64_t signed_words __attribute__((vector_size(sizeof(aur_words))));
    const uint64_t sign = UINT64_C(1) << 63;
    aur_words low[VECTORS];
    aur_words high[VECTORS];
    for (unsigned k = 0; k < GROUP; ++k) {
        const aur_wide phase = aur_phase128(step, first + k);
        low[k / AUR_LANES][k % AUR_LANES] = (uint64_t)phase ^ sign;
        high[k / AUR_LANES][k % AUR_LANES] = (uint64_t)(phase >> 64) + start;
    }
    const aur_wide jump = aur_phase128(step, GROUP);
    const aur_words zero = {0};
    const aur_words jump_low = zero + (uint64_t)jump;
    const aur_words jump_high = zero + (uint64_t)(jump >> 64);
    const signed_words least = (signed_words)(jump_low ^ sign);
    for (size_t i = 0; i < count; i += GROUP) {
        aur_reals values[VECTORS];
        for (unsigned v = 0; v < VECTORS; ++v) {
            values[v] = aur_lanes_unit(high[v]);
            low[v] += jump_low;
            high[v] += jump_high - (aur_words)((signed_words)low[v] < least);
        }
        put_group(values, count - i, out + i);
    }
}

static void hashes(uint64_t stream, uint64_t first, size_t count, double *out) {
    const uint64_t key = aur_mix64(stream + UINT64_C(0x9e3779b97f4a7c15));
    const uint64_t factor = UINT64_C(0xd6e8feb86659fd93);
    aur_words spread = (first + aur_lanes_count()) * factor;
    for (size_t i = 0; i < count; i += GROUP) {
        aur_reals values[VECTORS];
        for (unsigned v = 0; v < VECTORS; ++v) {
            aur_words x = spread ^ key;
            x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
            x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
            values[v] = aur_lanes_unit(x ^ x >> 31);
            spread += AUR_LANES * factor;
        }
        put_group(values, count - i, out + i);
    }
}

/* Indices that count are below 2^32, and the golden fraction's four quarters are multiplied by them. */
static size_t ascent(aur_ascent *ascent, size_t capacity, double *out) {
    typedef int64_t signed_words __attribute__((vector_size(sizeof(aur_words))));
    const aur_words zero = {0};
    aur_words index;
    uint64_t next = ascent->index;
    for (unsigned l = 0; l < AUR_LANES; ++l) {
        index[l] = next;
        next = (next + ascent->step) % ascent->modulus;
    }
    const uint64_t jump = AUR_LANES * ascent->step % ascent->modulus;
    const signed_words count = (signed_words)(zero + ascent->count);
    size_t made = 0;
    for (; made + AUR_RUN_SLACK <= capacity;) {
        const aur_words a = aur_lanes_multiply_low(index, zero + (AUR_GOLDEN_HIGH >> 32));
        const aur_words b = aur_lanes_multiply_low(index, zero + (uint32_t)AUR_GOLDEN_HIGH);
        const aur_words c = aur_lanes_multiply_low(index, zero + (AUR_GOLDEN_LOW >> 32));
        const aur_words d = aur_lanes_multiply_low(index, zero + (uint32_t)AUR_GOLDEN_LOW);
        const aur_words phase = (a << 32) + b + ((c + (d >> 32)) >> 32);
        made += aur_lanes_keep(out + made, (aur_words)((signed_words)index < count),
                               aur_lanes_unit(ascent->start + phase));
        const signed_words moved = (signed_words)(index + jump - ascent->modulus);
        index = (aur_words)moved + ((aur_words)(moved < 0) & ascent->modulus);
    }
    ascent->index = index[0];
    return made;
}

static void pairs(size_t count, const double *x, const double *y, bool stream, double *out) {
    size_t i = 0;
    if (stream) {
        for (; i + AUR_LANES <= count; i += AUR_LANES)
            aur_lanes_store2(out + 2 * i, load(x + i), load(y + i), true);
        aur_lanes_end_stream();
    }
    for (; i + AUR_LANES <= count; i += AUR_LANES)
        aur_lanes_store2(out + 2 * i, load(x + i), load(y + i), false);
    for (; i < count; ++i) {
        out[2 * i] = x[i];
        out[2 * i + 1] = y[i];
    }
}
