#include "points/base/simd_lanes.h"
#include "points/pointset/digits/digital_kernels.h"

/* The number of vectors computed together, to hide latency: vectors of words, and of halves of words for
 * Owen's hashes. A group is the number of points that fill them. */
enum {
    VECTORS = 4,
    SLOTS = VECTORS * AUR_LANES,
    OWEN_VECTORS = 4,
    OWEN_SLOTS = OWEN_VECTORS * 2 * AUR_LANES
};

static inline aur_words load(const void *from) {
    aur_words vector;
    memcpy(&vector, from, sizeof vector);
    return vector;
}

typedef struct plain_groups {
    aur_words lanes[VECTORS], wrapped[VECTORS];
    aur_words now;
} plain_groups;

/* Computes a group and advances to the next one, whose number is `next`. */
static inline void step_plain(const aur_digital_group *group, plain_groups *p, uint64_t next, bool stream,
                              double *out) {
    const aur_words flip = aur_lanes_of_pair(group->flips[__builtin_ctzll(next)]);
    for (unsigned v = 0; v < VECTORS; ++v)
        aur_lanes_put(out + v * AUR_LANES, aur_lanes_unit(p->now ^ p->lanes[v] ^ (p->wrapped[v] & flip)),
                      stream);
    p->now ^= flip;
}

static inline __attribute__((always_inline)) void fill_plain(aur_digital_group *group, size_t slots,
                                                             bool stream, double *out) {
    plain_groups p = {.now = aur_lanes_of_pair(group->words)};
    for (unsigned v = 0; v < VECTORS; ++v) {
        p.lanes[v] = load(group->lanes + v * AUR_LANES);
        p.wrapped[v] = load(group->wrapped + v * AUR_LANES);
    }
    uint64_t next = group->next;
    for (; slots >= SLOTS; slots -= SLOTS, out += SLOTS)
        step_plain(group, &p, next++, stream, out);
    if (slots > 0) {
        double rest[SLOTS];
        step_plain(group, &p, next, false, rest);
        memcpy(out, rest, slots * sizeof *out);
    }
    group->next = next;
    memcpy(group->words, &p.now, sizeof group->words);
}

/* Owen's words in two parts: heads are the upper 32 digits reversed, tails the lower ones. A vector has two
 * halves of each 128 bits for its first doubles, and two for its last ones. */
typedef struct owen_groups {
    aur_halves heads[OWEN_VECTORS], tails[OWEN_VECTORS], wrapped[OWEN_VECTORS];
    aur_halves head_now, tail_now;
    aur_halves key_low, key_high, factor;
} owen_groups;

static void prepare_owen(const aur_digital_run *run, const aur_digital_group *group, owen_groups *o) {
    for (unsigned v = 0; v < OWEN_VECTORS; ++v) {
        enum { HALVES = 2 * AUR_LANES };
        uint32_t heads[HALVES];
        uint32_t tails[HALVES];
        uint32_t wrapped[HALVES];
        for (unsigned h = 0; h < HALVES; ++h) {
            const unsigned slot = v * HALVES + h / 4 * 2 + h % 2 + h % 4 / 2 * AUR_LANES;
            heads[h] = aur_reverse_bits((uint32_t)(group->lanes[slot] >> 32));
            tails[h] = (uint32_t)group->lanes[slot];
            wrapped[h] = (uint32_t)group->wrapped[slot];
        }
        o->heads[v] = (aur_halves)load(heads);
        o->tails[v] = (aur_halves)load(tails);
        o->wrapped[v] = (aur_halves)load(wrapped);
    }
    const uint64_t *const keys = run->keys;
    const size_t last = run->dimension_count - 1;
    const aur_words zero = {0};
    o->head_now = (aur_halves)(zero + group->words[0]);
    o->tail_now = (aur_halves)(zero + group->words[1]);
    o->key_low = (aur_halves)(zero + ((uint32_t)keys[0] | keys[last] << 32));
    o->key_high = (aur_halves)(zero + (keys[0] >> 32 | keys[last] >> 32 << 32));
    o->factor = o->key_low >> 16 | 1;
}

/* A head is the mantissa of 2^20, the upper 21 digits of a tail are the mantissa of 1/2; difference and sum
 * are exact. */
static inline aur_reals owen_double(aur_words head, aur_words tail) {
    return ((aur_reals)head - (0x1p20 + 0.5)) + (aur_reals)tail;
}

/* The same for aur_owen_word. */
static inline void step_owen(const aur_digital_group *group, owen_groups *o, uint64_t next, bool tails,
                             bool stream, double *out) {
    const aur_words zero = {0};
    const uint64_t *const flip = group->flips[__builtin_ctzll(next)];
    const aur_halves head_flip = (aur_halves)(zero + flip[0]);
    const aur_halves tail_flip = (aur_halves)(zero + flip[1]);
    aur_halves heads[OWEN_VECTORS];
    aur_halves rest[OWEN_VECTORS];
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        heads[v] = o->head_now ^ o->heads[v] ^ (o->wrapped[v] & head_flip);
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        heads[v] ^= heads[v] * 0x3d20adeau;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        heads[v] = (heads[v] + o->key_low) * o->factor;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        heads[v] ^= heads[v] * 0x05526c56u;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        heads[v] ^= heads[v] * 0x53a22864u;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v) {
        rest[v] = heads[v] ^ o->key_high;
        rest[v] = (rest[v] ^ rest[v] >> 16) * 0x7feb352du;
    }
    for (unsigned v = 0; v < OWEN_VECTORS; ++v)
        rest[v] = (rest[v] ^ rest[v] >> 15) * 0x846ca68bu;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v) {
        rest[v] ^= rest[v] >> 16;
        if (tails)
            rest[v] ^= o->tail_now ^ o->tails[v] ^ (o->wrapped[v] & tail_flip);
        rest[v] >>= 11;
        heads[v] = aur_lanes_reverse_bits(heads[v]);
    }
    const aur_halves of_head = (aur_halves){0} + 0x41300000;
    const aur_halves of_rest = (aur_halves){0} + 0x3fe00000;
    for (unsigned v = 0; v < OWEN_VECTORS; ++v) {
        aur_lanes_put(
            out + 2 * v * AUR_LANES,
            owen_double(aur_lanes_first_words(heads[v], of_head), aur_lanes_first_words(rest[v], of_rest)),
            stream);
        aur_lanes_put(
            out + (2 * v + 1) * AUR_LANES,
            owen_double(aur_lanes_last_words(heads[v], of_head), aur_lanes_last_words(rest[v], of_rest)),
            stream);
    }
    o->head_now ^= head_flip;
    o->tail_now ^= tail_flip;
}

static inline __attribute__((always_inline)) void fill_owen(aur_digital_run *run, size_t slots, bool tails,
                                                            bool stream, double *out) {
    aur_digital_group *const group = &run->group;
    owen_groups o;
    prepare_owen(run, group, &o);
    uint64_t next = group->next;
    for (; slots >= OWEN_SLOTS; slots -= OWEN_SLOTS, out += OWEN_SLOTS)
        step_owen(group, &o, next++, tails, stream, out);
    if (slots > 0) {
        double rest[OWEN_SLOTS];
        step_owen(group, &o, next, tails, false, rest);
        memcpy(out, rest, slots * sizeof *out);
    }
    group->next = next;
    memcpy(&group->words[0], &o.head_now, sizeof group->words[0]);
    memcpy(&group->words[1], &o.tail_now, sizeof group->words[1]);
}

void AUR_KERNEL(aur_digital_run)(aur_digital_run *run, size_t count, bool stream, double *out) {
    const bool owen = run->scramble == AUR_SCRAMBLE_OWEN;
    const size_t slots = count * run->dimension_count;
    if (!run->started)
        aur_digital_run_start(run, owen ? OWEN_SLOTS : SLOTS);
    if (!owen) {
        if (stream)
            fill_plain(&run->group, slots, true, out);
        else
            fill_plain(&run->group, slots, false, out);
    } else if (run->group.tails) {
        if (stream)
            fill_owen(run, slots, true, true, out);
        else
            fill_owen(run, slots, true, false, out);
    } else {
        if (stream)
            fill_owen(run, slots, false, true, out);
        else
            fill_owen(run, slots, false, false, out);
    }
    if (stream)
        aur_lanes_end_stream();
}
