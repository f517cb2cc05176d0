/* What a harness offers. libFuzzer wants the first function; the driver in driver.c, which needs no clang,
 * wants both. */
#ifndef AUR_FUZZ_FUZZ_H
#define AUR_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

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

#endif
