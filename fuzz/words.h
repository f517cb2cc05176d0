/* Files of 64-bit words that end with a hash of themselves (points/base/words.h): the hash is corrected
 * before they are read, so that damaged data reach the later checks. */
#pragma once

#include "fuzz.h"
#include "points/base/random.h"

static inline uint64_t fuzz_word_at(const uint8_t *bytes) {
    uint64_t word = 0;
    for (unsigned k = 0; k < 8; ++k)
        word |= (uint64_t)bytes[k] << 8 * k;
    return word;
}

/* Replaces the last word of bytes[size] by the hash of the words before it; an incomplete word is unchanged.
 */
static inline void fuzz_correct_hash(uint8_t *bytes, size_t size) {
    uint64_t hash = 0;
    size_t at = 0;
    for (; at + 16 <= size; at += 8)
        hash = aur_hash2(hash, fuzz_word_at(bytes + at));
    for (unsigned k = 0; k < 8 && at + 8 <= size; ++k)
        bytes[at + k] = (uint8_t)(hash >> 8 * k);
}

/* A mutable copy, from malloc. */
static inline uint8_t *fuzz_copy(const uint8_t *data, size_t size) {
    uint8_t *const copy = malloc(size + 1);
    fuzz_require(copy != NULL, "out of memory");
    if (size > 0)
        memcpy(copy, data, size);
    return copy;
}
