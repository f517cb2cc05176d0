/* Coordinates as 64-bit fixed-point words (the first binary digit is the highest bit), and their scrambling.
 */
#pragma once

#include <aureole/pointset.h>
#include <stdbool.h>

#include "points/base/random.h"
#include "points/pointset/net_2d.h"

/* The largest double below 1. */
#define AUR_BELOW_ONE (1.0 - 0x1p-53)

/* Truncated to 53 binary digits, never rounded: a point stays in its elementary interval and below 1. */
static inline double aur_word_to_double(uint64_t word) {
    return (double)(int64_t)(word >> 11) * 0x1p-53;
}

/* The key of a scrambling: independent for each seed and dimension. */
static inline uint64_t aur_scramble_key(uint64_t seed, size_t dimension) {
    return aur_hash3(UINT64_C(0x5363726d626c6531), seed, dimension);
}

static inline uint64_t aur_reverse64(uint64_t x) {
    return (uint64_t)aur_reverse_bits((uint32_t)x) << 32 | aur_reverse_bits((uint32_t)(x >> 32));
}

/* The flips of digits beyond the 32nd: a hash of the 32 scrambled digits before them (the two rounds of
 * Wellons' lowbias32). */
static inline uint32_t aur_nested_tail(uint32_t reversed_head, uint32_t key_high) {
    uint32_t x = reversed_head ^ key_high;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/* Owen's nested uniform scrambling in base 2 by hashing: each of the first 32 binary digits is flipped by a
 * hash of the digits before it, the others by one hash of the first 32. */
static inline uint64_t aur_owen_word(uint64_t word, uint64_t key) {
    const uint32_t head = aur_nested_hash(aur_reverse_bits((uint32_t)(word >> 32)), (uint32_t)key);
    const uint32_t tail = (uint32_t)word ^ aur_nested_tail(head, (uint32_t)(key >> 32));
    return (uint64_t)aur_reverse_bits(head) << 32 | tail;
}

/* Owen's nested uniform scrambling (Owen 1995): the flips of the nodes of six levels, 63 of them, are bits of
 * one hash of the digits before these levels. */
static inline uint64_t aur_nested_word(uint64_t word, uint64_t key) {
    uint64_t flips = 0;
    for (unsigned level = 0; level < 54; level += 6) {
        const uint64_t before = level == 0 ? 0 : word >> (64 - level);
        const uint64_t nodes = aur_hash3(key, level, before);
        const uint64_t digits = word >> (58 - level) & 63;
        for (unsigned b = 0; b < 6; ++b) {
            const uint64_t node = (UINT64_C(1) << b) - 1 + (digits >> (6 - b));
            flips |= (nodes >> node & 1u) << (63 - level - b);
        }
    }
    return word ^ flips;
}

static inline bool aur_scrambles_digits(aur_scramble scramble) {
    return scramble == AUR_SCRAMBLE_DIGIT || scramble == AUR_SCRAMBLE_OWEN || scramble == AUR_SCRAMBLE_NESTED;
}

/* Applies DIGIT, OWEN and NESTED; the other scramblings do not change a word. */
static inline uint64_t aur_scramble_word(aur_scramble scramble, uint64_t word, uint64_t key) {
    switch (scramble) {
    case AUR_SCRAMBLE_DIGIT:
        return word ^ key;
    case AUR_SCRAMBLE_OWEN:
        return aur_owen_word(word, key);
    case AUR_SCRAMBLE_NESTED:
        return aur_nested_word(word, key);
    default:
        return word;
    }
}

/* index / count < 1, rounded, but never to 1. */
static inline double aur_fraction(uint64_t index, uint64_t count) {
    const double x = (double)index / (double)count;
    return x < 1.0 ? x : AUR_BELOW_ONE;
}

/* floor(index / count * 2^64) for index < count. */
static inline uint64_t aur_fraction_word(uint64_t index, uint64_t count) {
    __extension__ typedef unsigned __int128 wide;
    return (uint64_t)(((wide)index << 64) / count);
}

/* index / count with DIGIT, OWEN and NESTED applied as in base 2. */
static inline double aur_scrambled_fraction(aur_scramble scramble, uint64_t index, uint64_t count,
                                            uint64_t key) {
    if (!aur_scrambles_digits(scramble))
        return aur_fraction(index, count);
    return aur_word_to_double(aur_scramble_word(scramble, aur_fraction_word(index, count), key));
}
