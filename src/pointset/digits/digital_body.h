/* The kernel of digital_kernels.h, compiled for one instruction set by the file that includes this. */
#pragma once

#include "core/simd_lanes.h"
#include "pointset/digits/digital_kernels.h"

/* A group is 2^BITS points: two vectors of doubles. */
enum { HALF = AUR_LANES, GROUP = 2 * AUR_LANES, BITS = AUR_LANES == 8 ? 4 : AUR_LANES == 4 ? 3 : 2 };

/* The words of a group in one coordinate. Plain: its first half in `a`, the second in `b`. Owen: the lower
 * halves of all words in `a`, the upper halves in `b`. */
typedef struct words {
    aur_words a, b;
} words;

typedef struct coordinate {
    aur_digital_group group;
    words now;     /* the lanes, as if all of them belonged to the group that begins the vector */
    words wrapped; /* all ones in lanes that belong to the next group */
    uint32_t key_low, key_high;
} coordinate;

/* Which point each lane holds, so that unpacking leaves the points in order. Pairs of doubles: the even lanes
 * of a half make its first points. Owen words: each 128 bits give two words to either half. */
static void make_order(bool owen, bool pairs, unsigned char order[GROUP]) {
    unsigned char doubles[GROUP];
    for (unsigned p = 0; p < GROUP; ++p) {
        const unsigned within = p % HALF;
        const unsigned point = pairs ? within / 2 + (within % 2) * (HALF / 2) : within;
        doubles[p] = (unsigned char)(p - within + point);
    }
    for (unsigned p = 0; p < GROUP; ++p)
        order[p] = owen ? doubles[p / 4 * 2 + p % 2 + (p % 4 / 2) * HALF] : doubles[p];
}

static inline words broadcast(uint64_t word, bool owen) {
    const aur_words zero = {0};
    if (!owen)
        return (words){zero + word, zero + word};
    return (words){zero + (uint32_t)word * UINT64_C(0x100000001),
                   zero + (word >> 32) * UINT64_C(0x100000001)};
}

static inline aur_words load(const void *from) {
    aur_words vector;
    memcpy(&vector, from, sizeof vector);
    return vector;
}

static void prepare(const aur_digital_run *run, size_t dimension, bool owen, coordinate *c) {
    unsigned char order[GROUP];
    make_order(owen, run->dimension_count == 2, order);
    aur_digital_group_prepare(run, dimension, BITS, order, &c->group);
    const unsigned start = (unsigned)(run->first % GROUP);
    uint32_t low[GROUP];
    uint32_t high[GROUP];
    uint32_t wrapped[GROUP];
    uint64_t wide_wrapped[GROUP];
    for (unsigned l = 0; l < GROUP; ++l) {
        low[l] = (uint32_t)c->group.lanes[l];
        high[l] = (uint32_t)(c->group.lanes[l] >> 32);
        wide_wrapped[l] = start + order[l] >= GROUP ? UINT64_MAX : 0;
        wrapped[l] = (uint32_t)wide_wrapped[l];
    }
    if (owen) {
        c->wrapped = (words){load(wrapped), load(wrapped)};
        c->now = (words){load(low), load(high)};
    } else {
        c->wrapped = (words){load(wide_wrapped), load(wide_wrapped + HALF)};
        c->now = (words){load(c->group.lanes), load(c->group.lanes + HALF)};
    }
    const words first = broadcast(c->group.word, owen);
    c->now = (words){c->now.a ^ first.a, c->now.b ^ first.b};
    c->key_low = (uint32_t)run->keys[dimension];
    c->key_high = (uint32_t)(run->keys[dimension] >> 32);
}

/* The words of the group, and on to the next one, whose number is `next`. */
static inline words step(coordinate *c, uint64_t next, bool owen) {
    const words flip = broadcast(c->group.flips[__builtin_ctzll(next)], owen);
    const words result = {c->now.a ^ (c->wrapped.a & flip.a), c->now.b ^ (c->wrapped.b & flip.b)};
    c->now = (words){c->now.a ^ flip.a, c->now.b ^ flip.b};
    return result;
}

/* aur_owen_word of a group, back to plain words. */
static inline words owen_words(const coordinate *c, words w) {
    aur_halves x = (aur_halves)w.a;
    x ^= x * 0x3d20adeau;
    x = (x + c->key_low) * (c->key_low >> 16 | 1u);
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    aur_halves tail = x ^ c->key_high;
    tail = (tail ^ tail >> 16) * 0x7feb352du;
    tail = (tail ^ tail >> 15) * 0x846ca68bu;
    tail = tail ^ tail >> 16 ^ (aur_halves)w.b;
    const aur_halves head = aur_lanes_reverse_bits(x);
    return (words){aur_lanes_first_words(tail, head), aur_lanes_last_words(tail, head)};
}

/* aur_word_to_double */
static inline aur_reals to_double(aur_words word) {
    return aur_lanes_from_signed(word >> 11) * 0x1p-53;
}

static inline __attribute__((always_inline)) size_t fill_groups(const aur_digital_run *run, bool owen,
                                                                bool pairs, bool stream) {
    coordinate c[2];
    prepare(run, 0, owen, &c[0]);
    if (pairs)
        prepare(run, 1, owen, &c[1]);
    const size_t groups = run->count / GROUP;
    uint64_t next = run->first / GROUP + 1;
    double *out = run->out;
    for (size_t g = 0; g < groups; ++g, ++next) {
        words x = step(&c[0], next, owen);
        if (owen)
            x = owen_words(&c[0], x);
        const aur_reals xa = to_double(x.a);
        const aur_reals xb = to_double(x.b);
        if (!pairs) {
            aur_lanes_put(out, xa, stream);
            aur_lanes_put(out + HALF, xb, stream);
            out += GROUP;
            continue;
        }
        words y = step(&c[1], next, owen);
        if (owen)
            y = owen_words(&c[1], y);
        const aur_reals ya = to_double(y.a);
        const aur_reals yb = to_double(y.b);
        aur_lanes_put(out, aur_lanes_even(xa, ya), stream);
        aur_lanes_put(out + HALF, aur_lanes_odd(xa, ya), stream);
        aur_lanes_put(out + GROUP, aur_lanes_even(xb, yb), stream);
        aur_lanes_put(out + GROUP + HALF, aur_lanes_odd(xb, yb), stream);
        out += 2 * GROUP;
    }
    if (stream)
        aur_lanes_end_stream();
    return groups * GROUP;
}

static size_t run_kernel(const aur_digital_run *run) {
    const bool pairs = run->dimension_count == 2;
    if (run->scramble == AUR_SCRAMBLE_OWEN) {
        if (pairs)
            return run->stream ? fill_groups(run, true, true, true) : fill_groups(run, true, true, false);
        return run->stream ? fill_groups(run, true, false, true) : fill_groups(run, true, false, false);
    }
    if (pairs)
        return run->stream ? fill_groups(run, false, true, true) : fill_groups(run, false, true, false);
    return run->stream ? fill_groups(run, false, false, true) : fill_groups(run, false, false, false);
}
