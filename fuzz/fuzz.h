/* The interface of a harness. libFuzzer requires the first function; driver.c, which does not need clang,
 * requires both. */
#pragma once

#include <fcntl.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Passes the input to a parser and checks the result. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Writes valid input number `index` to data[capacity] and returns its size; 0 after the last one. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data);

/* Ends the program unless the condition holds. */
static inline void fuzz_require(int condition, const char *what) {
    if (condition)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

/* Writes the input to a file for parsers that read from a path; `path` is relative to the working directory.
 * Truncating after the write avoids the cost that file systems have for truncation to zero. */
static inline void fuzz_write_file(const char *path, const uint8_t *data, size_t size) {
    const int file = open(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    fuzz_require(file >= 0 && write(file, data, size) == (ssize_t)size && ftruncate(file, (off_t)size) == 0 &&
                     close(file) == 0,
                 "the input file cannot be written");
}

/* Reads a file that a writer has produced, as a seed. */
static inline size_t fuzz_read_file(const char *path, size_t capacity, uint8_t *data) {
    FILE *const file = fopen(path, "rb");
    fuzz_require(file != NULL, "a seed cannot be read");
    const size_t size = fread(data, 1, capacity, file);
    fclose(file);
    return size;
}

/* Copies text number `index` of `count` as a seed. */
static inline size_t fuzz_text_seed(size_t count, const char *const *texts, size_t index, size_t capacity,
                                    uint8_t *data) {
    if (index >= count)
        return 0;
    const size_t size = strlen(texts[index]);
    fuzz_require(size <= capacity, "a seed is too long");
    memcpy(data, texts[index], size);
    return size;
}
