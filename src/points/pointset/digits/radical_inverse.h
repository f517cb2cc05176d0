/* Numbers from digits in a prime base, plain or scrambled: radical inverses and digital sequences. */
#pragma once

#include "points/pointset/digits/run.h"

enum { AUR_RADICAL_PRIMES = 6542, AUR_RADICAL_BASE_LIMIT = 1 << 16 }; /* primes below the limit */

/* Randomisation of digits, from the most to the least significant. */
typedef enum aur_digits {
    AUR_DIGITS_PLAIN,
    AUR_DIGITS_SHIFT,   /* a random digit is added at each position, modulo the base */
    AUR_DIGITS_PERMUTE, /* a random permutation at each position (Owen 2017) */
    AUR_DIGITS_NESTED   /* a random permutation at each position for each sequence of preceding digits */
} aur_digits;

/* DIGIT and OWEN in a base other than 2. */
static inline aur_digits aur_digits_of(aur_scramble scramble) {
    return scramble == AUR_SCRAMBLE_DIGIT  ? AUR_DIGITS_SHIFT
           : scramble == AUR_SCRAMBLE_OWEN ? AUR_DIGITS_NESTED
                                           : AUR_DIGITS_PLAIN;
}

/* A fraction built from digits, the most significant first. Permutations are affine in the digit (a d + c
 * modulo the base, a not 0): pairs of digits are then distributed as under uniformly random permutations, and
 * the variance of an estimate depends only on pairs. */
typedef struct aur_digit_sum {
    uint32_t base; /* a prime below AUR_RADICAL_BASE_LIMIT */
    aur_digits digits;
    uint32_t digit_index;
    uint64_t key;
    uint64_t prefix; /* a hash of the digits so far */
    uint64_t numerator, denominator;
} aur_digit_sum;

static inline aur_digit_sum aur_digit_sum_begin(uint32_t base, aur_digits digits, uint64_t key) {
    return (aur_digit_sum){
        .base = base, .digits = digits, .key = key, .prefix = key, .numerator = 0, .denominator = 1};
}

/* Whether another digit fits into a double. */
static inline bool aur_digit_sum_has_room(const aur_digit_sum *sum) {
    return sum->denominator < UINT64_C(1) << 53 && sum->denominator <= UINT64_MAX / sum->base;
}

/* Call it only while a digit fits. */
void aur_digit_sum_put(aur_digit_sum *sum, uint32_t digit);

/* In [0,1). */
double aur_digit_sum_value(const aur_digit_sum *sum);

/* The number of digits of the base that fit into the fraction. */
size_t aur_digit_sum_places(uint32_t base);

/* In [0,1). `index` is below AUR_INDEX_LIMIT. */
double aur_radical_inverse(uint32_t base, uint64_t index, aur_digits digits, uint64_t key);

/* The same for coordinate `d` of the points of a block, with bit operations for base 2. */
void aur_fill_radical_inverse(const aur_pointset *set, const aur_block *block, size_t d, uint32_t base,
                              aur_digits digits);

/* Radical inverses of a dimension of a block as a run, with the scrambling of the set; false if a run does
 * not support it. */
bool aur_run_of_base(const aur_pointset *set, const aur_block *block, size_t dimension, uint32_t base,
                     aur_run *run);

/* Writes the first `count` primes. */
void aur_primes(size_t count, uint32_t *primes);
bool aur_is_prime(uint32_t n);
