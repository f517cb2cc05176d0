/* Radical inverses in any prime base below 2^16, plain or with scrambled digits. */
#ifndef AUR_POINTSET_RADICAL_INVERSE_H
#define AUR_POINTSET_RADICAL_INVERSE_H

#include "pointset/set.h"

enum { AUR_RADICAL_PRIMES = 6542 }; /* primes below 2^16 */

/* How the digits of a radical inverse change, in the order from the coarse digit to the fine one. */
typedef enum aur_digits {
    AUR_DIGITS_PLAIN,
    AUR_DIGITS_SHIFT,   /* a random digit is added at each place, modulo the base */
    AUR_DIGITS_PERMUTE, /* a random permutation at each place (Owen 2017) */
    AUR_DIGITS_NESTED   /* a random permutation at each place for each sequence of digits before it */
} aur_digits;

/* What DIGIT and OWEN are in a base other than 2. */
static inline aur_digits aur_digits_of(aur_scramble scramble) {
    return scramble == AUR_SCRAMBLE_DIGIT  ? AUR_DIGITS_SHIFT
           : scramble == AUR_SCRAMBLE_OWEN ? AUR_DIGITS_NESTED
                                           : AUR_DIGITS_PLAIN;
}

/* In [0,1). `index` below AUR_INDEX_LIMIT, base at least 2 and below 2^16. Permutations are affine in the
 * digit (a d + c modulo the base, a not 0): pairs of digits then go to pairs as under uniformly random
 * permutations, and no more than pairs enters the variance of an estimate. */
double aur_radical_inverse(uint32_t base, uint64_t index, aur_digits digits, uint64_t key);

/* The same for points of a block, coordinate `d` of it, with base 2 by bits. */
void aur_fill_radical_inverse(const aur_pointset *set, const aur_block *block, size_t d, uint32_t base,
                              aur_digits digits);

/* Writes the first `count` primes. */
void aur_primes(size_t count, uint32_t *primes);

#endif
