#include "pointset/radical_inverse.h"

static uint32_t below(uint64_t hash, uint32_t limit) {
    return (uint32_t)(((hash & UINT64_C(0xffffffff)) * limit) >> 32);
}

/* A random affine permutation of the digits 0..base-1; base is prime. */
static uint32_t permute(uint32_t digit, uint32_t base, uint64_t hash) {
    const uint64_t factor = 1 + below(hash >> 32, base - 1);
    return (uint32_t)((factor * digit + below(hash, base)) % base);
}

static double ratio(uint64_t reversed, uint64_t power) {
    const double x = (double)reversed / (double)power;
    return x < 1.0 ? x : AUR_BELOW_ONE;
}

static double plain_inverse(uint32_t base, uint64_t index) {
    uint64_t reversed = 0;
    uint64_t power = 1;
    while (index > 0) {
        reversed = reversed * base + index % base;
        index /= base;
        power *= base;
    }
    return ratio(reversed, power);
}

double aur_radical_inverse(uint32_t base, uint64_t index, aur_digits digits, uint64_t key) {
    if (digits == AUR_DIGITS_PLAIN)
        return plain_inverse(base, index);
    /* The index's endless leading zeros are digits too: go on until a double has no room for more. */
    const uint64_t room = UINT64_MAX / base;
    uint64_t reversed = 0;
    uint64_t power = 1;
    uint64_t prefix = key;
    for (uint32_t place = 0; power <= room && power < UINT64_C(1) << 53; ++place) {
        const uint32_t digit = (uint32_t)(index % base);
        index /= base;
        uint32_t changed;
        if (digits == AUR_DIGITS_SHIFT) {
            changed = (digit + below(aur_hash2(key, place), base)) % base;
        } else if (digits == AUR_DIGITS_PERMUTE) {
            changed = permute(digit, base, aur_hash2(key, place));
        } else {
            changed = permute(digit, base, prefix);
            prefix = aur_hash2(prefix, digit);
        }
        reversed = reversed * base + changed;
        power *= base;
    }
    return ratio(reversed, power);
}

void aur_fill_radical_inverse(const aur_pointset *set, const aur_block *block, size_t d, uint32_t base,
                              aur_digits digits) {
    const size_t dimension = block->first_dimension + d;
    const bool permuted = digits == AUR_DIGITS_PERMUTE;
    /* Permutations belong to the set and stay when it is scrambled again. */
    const uint64_t key = aur_scramble_key(permuted ? set->seed : block->seed, dimension);
    double *const out = block->data + d * block->coordinate_stride;
    for (size_t i = 0; i < block->count; ++i) {
        const uint64_t index = block->first + i;
        out[i * block->point_stride] =
            base == 2 && !permuted
                ? aur_word_to_double(aur_scramble_word(set->scramble, aur_reverse64(index), key))
                : aur_radical_inverse(base, index, digits, key);
    }
}

void aur_primes(size_t count, uint32_t *primes) {
    size_t found = 0;
    for (uint32_t candidate = 2; found < count; ++candidate) {
        bool prime = true;
        for (size_t k = 0; k < found && primes[k] * primes[k] <= candidate && prime; ++k)
            prime = candidate % primes[k] != 0;
        if (prime)
            primes[found++] = candidate;
    }
}
