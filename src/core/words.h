/* Numbers in files: words of 8 bytes, the lowest byte first, with a hash of all of them. */
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "core/random.h"

typedef struct aur_word_writer {
    FILE *stream;
    uint64_t hash;
} aur_word_writer;

/* A failed write leaves its mark on the stream, which aur_file_commit looks at. */
static inline void aur_word_put(aur_word_writer *writer, uint64_t word) {
    unsigned char bytes[8];
    for (size_t i = 0; i < sizeof bytes; ++i)
        bytes[i] = (unsigned char)(word >> 8 * i);
    fwrite(bytes, 1, sizeof bytes, writer->stream);
    writer->hash = aur_hash2(writer->hash, word);
}

static inline uint64_t aur_word_of_double(double value) {
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

typedef struct aur_word_reader {
    const unsigned char *at, *end;
    uint64_t hash;
    /* The data have ended before a word that was asked for. */
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
    const uint64_t word = aur_word_get(reader);
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* Whether the last word is the hash of all before it, and nothing was missing. */
static inline bool aur_word_check(aur_word_reader *reader) {
    const uint64_t hash = reader->hash;
    return aur_word_get(reader) == hash && !reader->failed;
}

/* Whole words that are left. */
static inline size_t aur_words_left(const aur_word_reader *reader) {
    return (size_t)(reader->end - reader->at) / 8;
}
