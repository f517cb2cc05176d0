#include "points/base/random.h"
#include "points/base/simd_lanes.h"
#include "points/pointset/runs.h"
#include "points/pointset/words.h"

#if AUR_KERNEL_WIDE

/* The number of vectors computed together, to hide latency. */
enum { VECTORS = 4, GROUP = VECTORS * AUR_LANES };

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

/* Integers below 2^53 are added exactly. */
static void start_multiples(aur_multiples *run) {
    uint64_t next = run->position;
    for (unsigned k = 0; k < GROUP; ++k) {
        run->positions[k] = (double)(int64_t)next;
        next += run->step;
        next -= next >= run->size ? run->size : 0;
    }
    /* The step between groups, minus the size: at most 0. */
    const double size = (double)(int64_t)run->size;
    run->jump = next >= run->position ? (double)(int64_t)(next - run->position) - size
                                      : -(double)(int64_t)(run->position - next);
    run->inverse = 1.0 / size;
    run->started = true;
}

static void multiples(aur_multiples *run, size_t count, double *out) {
    if (!run->started)
        start_multiples(run);
    const aur_reals zero = {0};
    const aur_reals size = zero + (double)(int64_t)run->size;
    const aur_reals inverse = zero + run->inverse;
    const aur_reals jump = zero + run->jump;
    aur_reals positions[VECTORS];
    for (unsigned v = 0; v < VECTORS; ++v)
        positions[v] = aur_lanes_load(run->positions + v * AUR_LANES);
    for (size_t i = 0; i < count; i += GROUP) {
        aur_reals values[VECTORS];
        for (unsigned v = 0; v < VECTORS; ++v) {
            values[v] = aur_lanes_quotient(positions[v], size, inverse);
            const aur_reals moved = positions[v] + jump;
            positions[v] = moved + (aur_reals)((aur_words)(moved < zero) & (aur_words)size);
        }
        put_group(values, count - i, out + i);
    }
    for (unsigned v = 0; v < VECTORS; ++v)
        aur_lanes_put(run->positions + v * AUR_LANES, positions[v], false);
}

static void quotients(double base, const double *numerators, double divisor, size_t count, double *out) {
    const aur_reals zero = {0};
    const double inverse = 1.0 / divisor;
    size_t i = 0;
    if (divisor <= 0x1p48)
        for (; i + AUR_LANES <= count; i += AUR_LANES)
            aur_lanes_put(
                out + i,
                aur_lanes_quotient(base + aur_lanes_load(numerators + i), zero + divisor, zero + inverse),
                false);
    for (; i < count; ++i)
        out[i] = (base + numerators[i]) / divisor;
}

/* Phases in two words; the sign of the lower one is flipped, so that signed comparisons detect its overflow.
 */
static void fractions(aur_multiples_of_fraction *run, size_t count, double *out) {
    typedef int64_t signed_words __attribute__((vector_size(sizeof(aur_words))));
    const uint64_t sign = UINT64_C(1) << 63;
    if (!run->started) {
        aur_wide phase = aur_phase128(run->step, run->first);
        for (unsigned k = 0; k < GROUP; ++k, phase += aur_phase128(run->step, 1)) {
            run->low[k] = (uint64_t)phase ^ sign;
            run->high[k] = (uint64_t)(phase >> 64) + run->start;
        }
        run->started = true;
    }
    aur_words low[VECTORS];
    aur_words high[VECTORS];
    memcpy(low, run->low, sizeof low);
    memcpy(high, run->high, sizeof high);
    const aur_wide jump = aur_phase128(run->step, GROUP);
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
    memcpy(run->low, low, sizeof low);
    memcpy(run->high, high, sizeof high);
}

static void hashes(aur_hashes *run, size_t count, double *out) {
    const uint64_t key = aur_mix64(run->stream + UINT64_C(0x9e3779b97f4a7c15));
    const uint64_t factor = UINT64_C(0xd6e8feb86659fd93);
    aur_words spread = (run->first + aur_lanes_count()) * factor;
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
    run->first += count;
}

/* Valid indices are below 2^32 and are multiplied by the four quarters of the golden fraction. */
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
    size_t written = 0;
    for (; written + AUR_RUN_SLACK <= capacity;) {
        const aur_words a = aur_lanes_multiply_low(index, zero + (AUR_GOLDEN_HIGH >> 32));
        const aur_words b = aur_lanes_multiply_low(index, zero + (uint32_t)AUR_GOLDEN_HIGH);
        const aur_words c = aur_lanes_multiply_low(index, zero + (AUR_GOLDEN_LOW >> 32));
        const aur_words d = aur_lanes_multiply_low(index, zero + (uint32_t)AUR_GOLDEN_LOW);
        const aur_words phase = (a << 32) + b + ((c + (d >> 32)) >> 32);
        written += aur_lanes_compress(out + written, (aur_words)((signed_words)index < count),
                                      aur_lanes_unit(ascent->start + phase));
        const signed_words moved = (signed_words)(index + jump - ascent->modulus);
        index = (aur_words)moved + ((aur_words)(moved < 0) & ascent->modulus);
    }
    ascent->index = index[0];
    return written;
}

static void pairs(size_t count, const double *x, const double *y, bool stream, double *out) {
    size_t i = 0;
    if (stream)
        for (; i + AUR_LANES <= count; i += AUR_LANES)
            aur_lanes_store2(out + 2 * i, aur_lanes_load(x + i), aur_lanes_load(y + i), true);
    for (; i + AUR_LANES <= count; i += AUR_LANES)
        aur_lanes_store2(out + 2 * i, aur_lanes_load(x + i), aur_lanes_load(y + i), false);
    for (; i < count; ++i) {
        out[2 * i] = x[i];
        out[2 * i + 1] = y[i];
    }
}

static void end_stream(void) {
    aur_lanes_end_stream();
}

#else

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
    size_t written = 0;
    while (written + AUR_RUN_SLACK <= capacity) {
        out[written] = aur_word_to_double(ascent->start + aur_phase(aur_golden_fraction, index));
        written += index < ascent->count;
        index += ascent->step;
        index -= index >= ascent->modulus ? ascent->modulus : 0;
    }
    ascent->index = index;
    return written;
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

#endif

const aur_run_kernels AUR_KERNEL(aur_runs) = {multiples, fractions, hashes,    ascent,
                                              quotients, pairs,     end_stream};
