/* The computing time of golden numbers and of van der Corput's, by loops as described in the paper and by the
 * library. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "program/lab/points.h"
#include "schretter.h"

enum { NUMBERS = 1 << 16, ROUNDS = 24 };

typedef union numbers {
    uint32_t *integers;
    double *doubles;
} numbers;

static void golden_loop(numbers to) {
    uint32_t state = 0;
    for (size_t i = 0; i < NUMBERS; ++i)
        to.integers[i] = state += UINT32_C(2654435769);
}

/* Bit reversal by swaps, the usual method in base 2. */
static void corput_swaps(numbers to) {
    for (uint32_t i = 0; i < NUMBERS; ++i) {
        uint32_t x = i + 1;
        x = x << 16 | x >> 16;
        x = (x & UINT32_C(0x00ff00ff)) << 8 | (x & UINT32_C(0xff00ff00)) >> 8;
        x = (x & UINT32_C(0x0f0f0f0f)) << 4 | (x & UINT32_C(0xf0f0f0f0)) >> 4;
        x = (x & UINT32_C(0x33333333)) << 2 | (x & UINT32_C(0xcccccccc)) >> 2;
        x = (x & UINT32_C(0x55555555)) << 1 | (x & UINT32_C(0xaaaaaaaa)) >> 1;
        to.integers[i] = x;
    }
}

/* Digit by digit, for any base. */
static void corput_digits(numbers to) {
    for (uint32_t i = 0; i < NUMBERS; ++i) {
        uint32_t value = 0;
        for (uint32_t n = i + 1, digit = UINT32_C(1) << 31; n > 0; n /= 2, digit /= 2)
            value += n % 2 * digit;
        to.integers[i] = value;
    }
}

aur_result schretter_numbers(const char *sequence, uint64_t first, size_t count, double *to,
                             aur_error *error) {
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset *set = NULL;
    aur_result result = aur_pointset_options_init(first + count, &options, error);
    options.dimension = 1;
    if (result == AUR_OK)
        result = aur_pointset_create(sequence, &options, &set, error);
    if (result == AUR_OK)
        result = aur_pointset_points(set, first, count, count, to, error);
    aur_pointset_destroy(set);
    return result;
}

static void golden_library(numbers to) {
    schretter_numbers("golden", 0, NUMBERS, to.doubles, NULL);
}

static void corput_library(numbers to) {
    schretter_numbers("van-der-corput", 1, NUMBERS, to.doubles, NULL);
}

static const struct {
    const char *name;
    void (*golden)(numbers to), (*corput)(numbers to);
} pairs[] = {{"loops, bits reversed by swaps", golden_loop, corput_swaps},
             {"loops, digit by digit", golden_loop, corput_digits},
             {"the library", golden_library, corput_library}};

/* Processor seconds of eight runs of one method. */
static double seconds(void (*make)(numbers to), numbers to) {
    struct timespec begin, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (size_t i = 0; i < 8; ++i)
        make(to);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}

aur_result schretter_time(lab_run *run, aur_error *error) {
    double *const room = calloc(NUMBERS, sizeof *room);
    if (room == NULL) {
        *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; ++p) {
        const numbers to = {.doubles = room};
        double ratios[ROUNDS], mean, half, least = INFINITY;
        seconds(pairs[p].golden, to); /* warm-up: memory allocated, full clock speed */
        for (size_t k = 0; k < ROUNDS; ++k) {
            const double golden = seconds(pairs[p].golden, to);
            ratios[k] = log(seconds(pairs[p].corput, to) / golden);
            least = fmin(least, golden);
        }
        char name[160];
        lab_mean_interval(ROUNDS, ratios, &mean, &half);
        snprintf(name, sizeof name, "golden, %s: of 2^19 numbers", pairs[p].name);
        lab_time(run, name, least);
        snprintf(name, sizeof name, "van der Corput over golden, %s: a ratio", pairs[p].name);
        lab_time(run, name, exp(mean));
        lab_time(run, "its interval of 95 %, from", exp(mean - half));
        lab_time(run, "its interval of 95 %, to", exp(mean + half));
    }
    free(room);
    return AUR_OK;
}
