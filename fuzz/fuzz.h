/* What a harness offers. libFuzzer wants the first function; the driver in driver.c, which needs no clang,
 * wants both. */
#ifndef AUR_FUZZ_FUZZ_H
#define AUR_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Gives the input to a parser and checks what comes back. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Writes valid input number `index` to data[capacity] and returns its size; 0 when there are no more. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data);

/* Ends the program when what must be true is not. */
static inline void fuzz_require(int condition, const char *what) {
    if (condition)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

/* The input as a file, for parsers that read from a path; `path` is relative to where the harness runs. */
static inline void fuzz_write_file(const char *path, const uint8_t *data, size_t size) {
    FILE *const file = fopen(path, "wb");
    fuzz_require(file != NULL && fwrite(data, 1, size, file) == size && fclose(file) == 0,
                 "the input file cannot be written");
}

/* Text number `index` of `count` as a seed. */
static inline size_t fuzz_text_seed(size_t count, const char *const *texts, size_t index, size_t capacity,
                                    uint8_t *data) {
    if (index >= count)
        return 0;
    const size_t size = strlen(texts[index]);
    fuzz_require(size <= capacity, "a seed is too long");
    memcpy(data, texts[index], size);
    return size;
}

#endif
