/* Numbers in files: little-endian words of 8 bytes, followed by a hash. */
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "points/base/random.h"

typedef struct aur_word_writer {
    FILE *stream;
    uint64_t hash;
} aur_word_writer;

/* A failed write sets the error flag of the stream, which aur_file_commit checks. */
static inline void aur_word_put(aur_word_writer *writer, uint64_t word) {
    unsigned char bytes[8];
    for (size_t i = 0; i < sizeof bytes; ++i)
        bytes[i] = (unsigned char)(word >> 8 * i);
    fwrite(bytes, 1, sizeof bytes, writer->stream);
    writer->hash = aur_hash2(writer->hash, word);
}

/* A hash of the bytes and of their number. */
static inline uint64_t aur_hash_bytes(size_t size, const void *bytes) {
    const unsigned char *const at = bytes;
    uint64_t hash = aur_mix64(size);
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        if (size - i >= 8) /* compilers turn this loop into a load */
            for (size_t k = 0; k < 8; ++k)
                word |= (uint64_t)at[i + k] << 8 * k;
        else
            for (size_t k = 0; i + k < size; ++k)
                word |= (uint64_t)at[i + k] << 8 * k;
        hash = aur_hash2(hash, word);
    }
    return hash;
}

static inline uint64_t aur_word_of_double(double value) {
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static inline double aur_double_of_word(uint64_t word) {
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

typedef struct aur_word_reader {
    const unsigned char *at, *end;
    uint64_t hash;
    /* The data ended before a requested word. */
    bool failed;
} aur_word_reader;

/* 0 beyond the end. */
static inline uint64_t aur_word_get(aur_word_reader *reader) {
    if (reader->end - reader->at < 8) {
        reader->failed = true;
        return 0;
    }
    uint64_t word = 0;
    for (size_t i = 0; i < 8; ++i)
        word |= (uint64_t)reader->at[i] << 8 * i;
    reader->at += 8;
    reader->hash = aur_hash2(reader->hash, word);
    return word;
}

static inline double aur_word_get_double(aur_word_reader *reader) {
    return aur_double_of_word(aur_word_get(reader));
}

/* Whether the last word is the hash of all before it, and no word was missing. */
static inline bool aur_word_check(aur_word_reader *reader) {
    const uint64_t hash = reader->hash;
    return aur_word_get(reader) == hash && !reader->failed;
}

/* Remaining whole words. */
static inline size_t aur_words_left(const aur_word_reader *reader) {
    return (size_t)(reader->end - reader->at) / 8;
}
