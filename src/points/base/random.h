/* Counter-based random numbers: every number is a hash of its purpose and index, so there is no state and no
 * order.
 *
 * The mixer is the 64-bit finalizer of SplitMix (Steele, Lea, Flood 2014, with Stafford's "Mix13" constants).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

static inline uint64_t aur_mix64(uint64_t x) {
    x ^= x >> 30;
    x *= UINT64_C(0xbf58476d1ce4e5b9);
    x ^= x >> 27;
    x *= UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return x;
}

/* A hash of a pair. Chain it for more: aur_hash2(aur_hash2(a, b), c). The order matters. */
static inline uint64_t aur_hash2(uint64_t a, uint64_t b) {
    return aur_mix64(aur_mix64(a + UINT64_C(0x9e3779b97f4a7c15)) ^ (b * UINT64_C(0xd6e8feb86659fd93)));
}

static inline uint64_t aur_hash3(uint64_t a, uint64_t b, uint64_t c) {
    return aur_hash2(aur_hash2(a, b), c);
}

static inline uint64_t aur_hash4(uint64_t a, uint64_t b, uint64_t c, uint64_t d) {
    return aur_hash2(aur_hash3(a, b, c), d);
}

/* The top 53 bits as a double in [0,1). */
static inline double aur_unit_double(uint64_t hash) {
    return (double)(hash >> 11) * 0x1p-53;
}

/* 24 bits as a float in [0,1). */
static inline float aur_unit_float(uint32_t bits) {
    return (float)(bits >> 8) * 0x1p-24f;
}

/* The next number in [0, 1) of a sequence of hashes; advances the sequence. */
static inline float aur_draw_unit(uint64_t *hash) {
    *hash = aur_mix64(*hash + 1);
    return aur_unit_float((uint32_t)(*hash >> 32));
}

static inline void aur_draw_units(uint64_t *hash, float u[3]) {
    for (size_t i = 0; i < 3; ++i)
        u[i] = aur_draw_unit(hash);
}

/* Puts items into a random order, by hashes (Fisher and Yates). */
static inline void aur_shuffle(size_t count, uint32_t *items, uint64_t seed) {
    for (size_t i = count; i > 1; --i) {
        const size_t j = (size_t)(aur_hash3(seed, 0x6f72646572, i) % i);
        const uint32_t swap = items[i - 1];
        items[i - 1] = items[j];
        items[j] = swap;
    }
}
