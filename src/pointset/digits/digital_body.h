/* The kernel of digital_kernels.h over the operations of one instruction set. The including file has defined
 *     BITS                     a group is 2^BITS points
 *     integers, reals          a register of bits, and of 2^BITS / 2 doubles
 *     load, every32, every64   registers from memory and from one word
 *     exclusive_or, choose(mask, a, b), add32, multiply32, right32(x, n)
 *     and_bits, or_bits, left32(x, n), table16(bytes), shuffle_bytes(table, x)
 *     unpack_low32, unpack_high32, unpack_low64, unpack_high64, to_double, store(out, values, stream)
 * where unpacking works within each 128 bits of a register. */
#ifndef BITS
#error "to be included by the file of an instruction set"
#endif

enum { GROUP = 1 << BITS, HALF = GROUP / 2 };

/* The words of a group in one coordinate. Plain: its first half in `a`, the second in `b`. Owen: the lower
 * halves of all words in `a`, the upper halves in `b`. */
typedef struct words {
    integers a, b;
} words;

typedef struct coordinate {
    aur_digital_group group;
    words lanes;
    words now;     /* the word of the group, in every lane */
    words wrapped; /* all ones in lanes that belong to the next group */
    integers key_low, key_high, key_odd;
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
    if (!owen)
        return (words){every64(word), every64(word)};
    return (words){every32((uint32_t)word), every32((uint32_t)(word >> 32))};
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
        c->lanes = (words){load(low), load(high)};
    } else {
        c->wrapped = (words){load(wide_wrapped), load(wide_wrapped + HALF)};
        c->lanes = (words){load(c->group.lanes), load(c->group.lanes + HALF)};
    }
    c->now = broadcast(c->group.word, owen);
    const uint32_t key = (uint32_t)run->keys[dimension];
    c->key_low = every32(key);
    c->key_odd = every32(key >> 16 | 1u);
    c->key_high = every32((uint32_t)(run->keys[dimension] >> 32));
}

/* The words of the group, and on to the next one, whose number is `next`. */
static inline words step(coordinate *c, uint64_t next, bool owen) {
    c->group.word ^= c->group.flips[__builtin_ctzll(next)];
    const words after = broadcast(c->group.word, owen);
    const words result = {exclusive_or(c->lanes.a, choose(c->wrapped.a, after.a, c->now.a)),
                          exclusive_or(c->lanes.b, choose(c->wrapped.b, after.b, c->now.b))};
    c->now = after;
    return result;
}

/* aur_reverse_bits: nibbles by a table, then bytes. */
static inline integers reverse_bits(integers x) {
    static const uint8_t reversed[16] = {0x0, 0x8, 0x4, 0xc, 0x2, 0xa, 0x6, 0xe,
                                         0x1, 0x9, 0x5, 0xd, 0x3, 0xb, 0x7, 0xf};
    static const uint8_t bytes[16] = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    const integers nibble = every32(0x0f0f0f0fu);
    const integers table = table16(reversed);
    const integers low = shuffle_bytes(table, and_bits(x, nibble));
    const integers high = shuffle_bytes(table, and_bits(right32(x, 4), nibble));
    return shuffle_bytes(or_bits(left32(low, 4), high), table16(bytes));
}

static inline integers hash_round(integers x, uint32_t factor) {
    return exclusive_or(x, multiply32(x, every32(factor)));
}

/* aur_owen_word of a group, back to plain words. */
static inline words owen_words(const coordinate *c, words w) {
    integers x = hash_round(w.a, 0x3d20adeau);
    x = multiply32(add32(x, c->key_low), c->key_odd);
    x = hash_round(hash_round(x, 0x05526c56u), 0x53a22864u);
    integers tail = exclusive_or(x, c->key_high);
    tail = multiply32(exclusive_or(tail, right32(tail, 16)), every32(0x7feb352du));
    tail = multiply32(exclusive_or(tail, right32(tail, 15)), every32(0x846ca68bu));
    tail = exclusive_or(exclusive_or(tail, right32(tail, 16)), w.b);
    const integers head = reverse_bits(x);
    return (words){unpack_low32(tail, head), unpack_high32(tail, head)};
}

static inline __attribute__((always_inline)) size_t make(const aur_digital_run *run, bool owen, bool pairs,
                                                         bool stream) {
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
        const reals xa = to_double(x.a);
        const reals xb = to_double(x.b);
        if (!pairs) {
            store(out, xa, stream);
            store(out + HALF, xb, stream);
            out += GROUP;
            continue;
        }
        words y = step(&c[1], next, owen);
        if (owen)
            y = owen_words(&c[1], y);
        const reals ya = to_double(y.a);
        const reals yb = to_double(y.b);
        store(out, unpack_low64(xa, ya), stream);
        store(out + HALF, unpack_high64(xa, ya), stream);
        store(out + GROUP, unpack_low64(xb, yb), stream);
        store(out + GROUP + HALF, unpack_high64(xb, yb), stream);
        out += 2 * GROUP;
    }
    if (stream)
        _mm_sfence();
    return groups * GROUP;
}

static size_t run_kernel(const aur_digital_run *run) {
    const bool pairs = run->dimension_count == 2;
    if (run->scramble == AUR_SCRAMBLE_OWEN) {
        if (pairs)
            return run->stream ? make(run, true, true, true) : make(run, true, true, false);
        return run->stream ? make(run, true, false, true) : make(run, true, false, false);
    }
    if (pairs)
        return run->stream ? make(run, false, true, true) : make(run, false, true, false);
    return run->stream ? make(run, false, false, true) : make(run, false, false, false);
}
