#include "points/pointset/digits/run.h"

#include <string.h>

static void next_multiples(aur_run *run, size_t count, double *out) {
    aur_runs(SIZE_MAX)->multiples(&run->of.multiples, count, out);
}

void aur_run_of_multiples(uint64_t position, uint64_t step, uint64_t size, aur_run *run) {
    run->next = next_multiples;
    run->of.multiples = (aur_multiples){.position = position, .step = step, .size = size};
}

static void next_fractions(aur_run *run, size_t count, double *out) {
    aur_runs(SIZE_MAX)->fractions(&run->of.fractions, count, out);
}

void aur_run_of_fraction(uint64_t start, aur_fraction128 step, uint64_t first, aur_run *run) {
    run->next = next_fractions;
    run->of.fractions = (aur_multiples_of_fraction){.step = step, .start = start, .first = first};
}

static void next_hashes(aur_run *run, size_t count, double *out) {
    aur_runs(SIZE_MAX)->hashes(&run->of.hashes, count, out);
}

void aur_run_of_hashes(uint64_t stream, uint64_t first, aur_run *run) {
    run->next = next_hashes;
    run->of.hashes = (aur_hashes){stream, first};
}

static void next_digits(aur_run *run, size_t count, double *out) {
    AUR_KERNEL_HERE(aur_digital_run)(&run->of.digital.run, count, false, out);
}

void aur_run_of_digits(const uint64_t columns[AUR_DIGITAL_COLUMNS], aur_scramble scramble, uint64_t key,
                       uint64_t first, uint64_t last, aur_run *run) {
    run->next = next_digits;
    memcpy(run->of.digital.columns, columns, sizeof run->of.digital.columns);
    run->of.digital.run = (aur_digital_run){.dimension_count = 1,
                                            .columns = {run->of.digital.columns},
                                            .keys = {key},
                                            .scramble = scramble,
                                            .first = first,
                                            .last = last};
}

static void make_table(aur_radical_run *r, uint64_t count) {
    for (r->span = r->base; r->span * r->base <= AUR_RUN_TABLE && r->span < count;)
        r->span *= r->base;
    r->width = r->span < AUR_RUN_TABLE ? (size_t)r->span : AUR_RUN_TABLE;
    r->table[0] = 0.0;
    uint64_t unit = r->denominator;
    for (size_t filled = 1; filled < r->width;) {
        unit /= r->base;
        const size_t before = filled;
        for (; filled < r->base * before && filled < r->width; ++filled)
            r->table[filled] = r->table[filled % before] + (double)(int64_t)(filled / before * unit);
    }
}

/* A quotient of two integers below 2^53 is rounded correctly, so it is bit-identical to random access. */
static void next_radical(aur_run *run, size_t count, double *out) {
    aur_radical_run *const r = &run->of.radical;
    while (count > 0) {
        const uint64_t lower = r->index % r->span;
        const size_t within = (size_t)(lower % r->width);
        uint64_t unit = r->denominator / r->span;
        /* If the table is too short for the lowest digit, it restarts. */
        uint64_t shared = (lower - within) * unit;
        for (uint64_t rest = r->index / r->span; rest > 0; rest /= r->base) {
            unit /= r->base;
            shared += rest % r->base * unit;
        }
        const uint64_t left = r->span - lower;
        const size_t here = left < r->width - within ? (size_t)left : r->width - within;
        const size_t part = here < count ? here : count;
        aur_runs(SIZE_MAX)->quotients((double)(int64_t)shared, r->table + within,
                                      (double)(int64_t)r->denominator, part, out);
        r->index += part;
        out += part;
        count -= part;
    }
}

bool aur_run_of_radical_inverse(uint32_t base, uint64_t first, uint64_t last, aur_run *run) {
    aur_radical_run *const r = &run->of.radical;
    run->next = next_radical;
    r->base = r->denominator = base;
    r->index = first;
    for (uint64_t rest = (last - 1) / base; rest > 0; rest /= base) {
        r->denominator *= base;
        if (r->denominator > UINT64_C(1) << 53)
            return false;
    }
    make_table(r, last - first);
    return true;
}

static void next_ascending(aur_run *run, size_t count, double *out) {
    aur_ascending_run *const r = &run->of.ascending;
    while (count > 0) {
        if (r->taken == r->computed) {
            r->computed = aur_runs(SIZE_MAX)->ascent(&r->ascent, AUR_RUN_VALUES, r->values);
            r->taken = 0;
        }
        const size_t part = r->computed - r->taken < count ? r->computed - r->taken : count;
        memcpy(out, r->values + r->taken, part * sizeof *out);
        r->taken += part;
        out += part;
        count -= part;
    }
}

void aur_run_of_ascent(const aur_ascent *ascent, aur_run *run) {
    run->next = next_ascending;
    run->of.ascending.ascent = *ascent;
    run->of.ascending.taken = run->of.ascending.computed = 0;
}

void aur_run_pairs(aur_run *x, aur_run *y, size_t count, double *out) {
    enum { PART = 128, HELD = 8 };
    _Static_assert(PART % AUR_DIGITAL_SLOTS == 0, "parts that may go on");
    double a[PART + HELD];
    double b[PART + HELD];
    const aur_run_kernels *const kernels = aur_runs(SIZE_MAX);
    const size_t start = aur_output_stream_start(count, out);
    size_t held = 0; /* computed and not written, since they are not a multiple of 64 bytes */
    size_t done = 0;
    for (size_t written = 0; written < count;) {
        const size_t part = count - written < PART ? count - written : PART;
        x->next(x, part, a + held);
        y->next(y, part, b + held);
        written += part;
        held += part;
        const size_t before = done < start && start < held ? start - done : 0;
        kernels->pairs(before, a, b, false, out + 2 * done);
        const size_t rest = held - before;
        const size_t now = written < count && start < count ? rest / 4 * 4 : rest;
        kernels->pairs(now, a + before, b + before, start < count, out + 2 * (done + before));
        done += before + now;
        held = rest - now;
        memmove(a, a + before + now, held * sizeof a[0]);
        memmove(b, b + before + now, held * sizeof b[0]);
    }
    kernels->end_stream();
}
