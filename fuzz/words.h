/* Files of words that end with a hash of themselves (points/base/words.h): it is made right before they are
 * read, so that what is damaged reaches the checks behind it. */
#pragma once

#include "fuzz.h"
#include "points/base/random.h"

static inline uint64_t fuzz_word_at(const uint8_t *bytes) {
    uint64_t word = 0;
    for (unsigned k = 0; k < 8; ++k)
        word |= (uint64_t)bytes[k] << 8 * k;
    return word;
}

/* Puts the hash of the words of bytes[size] but the last one in the place of that; a rest of less than a word
 * is left alone. */
static inline void fuzz_mend_hash(uint8_t *bytes, size_t size) {
    uint64_t hash = 0;
    size_t at = 0;
    for (; at + 16 <= size; at += 8)
        hash = aur_hash2(hash, fuzz_word_at(bytes + at));
    for (unsigned k = 0; k < 8 && at + 8 <= size; ++k)
        bytes[at + k] = (uint8_t)(hash >> 8 * k);
}

/* A copy that may be changed, from malloc. */
static inline uint8_t *fuzz_copy(const uint8_t *data, size_t size) {
    uint8_t *const copy = malloc(size + 1);
    fuzz_require(copy != NULL, "out of memory");
    if (size > 0)
        memcpy(copy, data, size);
    return copy;
}
