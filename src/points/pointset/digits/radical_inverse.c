#include "points/pointset/digits/radical_inverse.h"

#include "points/pointset/digits/digital.h"

enum { SHORT_RUN = 8 };

static uint32_t below(uint64_t hash, uint32_t limit) {
    return (uint32_t)(((hash & UINT64_C(0xffffffff)) * limit) >> 32);
}

/* A random affine permutation of the digits 0..base-1; base is prime. */
static uint32_t permute(uint32_t digit, uint32_t base, uint64_t hash) {
    const uint64_t factor = 1 + below(hash >> 32, base - 1);
    return (uint32_t)((factor * digit + below(hash, base)) % base);
}

void aur_digit_sum_put(aur_digit_sum *sum, uint32_t digit) {
    const uint32_t base = sum->base;
    uint32_t changed = digit;
    if (sum->digits == AUR_DIGITS_SHIFT) {
        changed = (digit + below(aur_hash2(sum->key, sum->digit_index), base)) % base;
    } else if (sum->digits == AUR_DIGITS_PERMUTE) {
        changed = permute(digit, base, aur_hash2(sum->key, sum->digit_index));
    } else if (sum->digits == AUR_DIGITS_NESTED) {
        changed = permute(digit, base, sum->prefix);
        sum->prefix = aur_hash2(sum->prefix, digit);
    }
    ++sum->digit_index;
    sum->numerator = sum->numerator * base + changed;
    sum->denominator *= base;
}

double aur_digit_sum_value(const aur_digit_sum *sum) {
    return aur_fraction(sum->numerator, sum->denominator);
}

size_t aur_digit_sum_places(uint32_t base) {
    aur_digit_sum sum = aur_digit_sum_begin(base, AUR_DIGITS_PLAIN, 0);
    while (aur_digit_sum_has_room(&sum))
        aur_digit_sum_put(&sum, 0);
    return sum.digit_index;
}

double aur_radical_inverse(uint32_t base, uint64_t index, aur_digits digits, uint64_t key) {
    aur_digit_sum sum = aur_digit_sum_begin(base, digits, key);
    if (digits == AUR_DIGITS_PLAIN) {
        for (; index > 0; index /= base) {
            sum.numerator = sum.numerator * base + index % base;
            sum.denominator *= base;
        }
    } else {
        /* The infinite leading zeros of the index are digits, too. */
        for (; aur_digit_sum_has_room(&sum); index /= base)
            aur_digit_sum_put(&sum, (uint32_t)(index % base));
    }
    return aur_digit_sum_value(&sum);
}

/* In base 2 the radical inverse is the digital sequence of the identity matrix. */
static void binary_columns(uint64_t columns[AUR_DIGITAL_COLUMNS]) {
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        columns[k] = UINT64_C(1) << (63 - k);
}

bool aur_run_of_base(const aur_pointset *set, const aur_block *block, size_t dimension, uint32_t base,
                     aur_run *run) {
    if (base == 2) {
        uint64_t columns[AUR_DIGITAL_COLUMNS];
        binary_columns(columns);
        aur_run_of_digits(columns, set->scramble, aur_scramble_key(block->seed, dimension), block->first,
                          block->first + block->count, run);
        return true;
    }
    return aur_digits_of(set->scramble) == AUR_DIGITS_PLAIN &&
           aur_run_of_radical_inverse(base, block->first, block->first + block->count, run);
}

void aur_fill_radical_inverse(const aur_pointset *set, const aur_block *block, size_t d, uint32_t base,
                              aur_digits digits) {
    if (base == 2 && digits != AUR_DIGITS_PERMUTE) {
        uint64_t columns[AUR_DIGITAL_COLUMNS];
        binary_columns(columns);
        aur_fill_digital(set, columns, block, d);
        return;
    }
    const size_t dimension = block->first_dimension + d;
    double *const out = block->data + d * block->coordinate_stride;
    aur_run run;
    if (digits == AUR_DIGITS_PLAIN && block->count >= SHORT_RUN &&
        aur_run_of_radical_inverse(base, block->first, block->first + block->count, &run)) {
        run.next(&run, block->count, out);
        return;
    }
    /* Permutations are part of the set and do not change with the scrambling. */
    const uint64_t key = aur_scramble_key(digits == AUR_DIGITS_PERMUTE ? set->seed : block->seed, dimension);
    for (size_t i = 0; i < block->count; ++i)
        out[i] = aur_radical_inverse(base, block->first + i, digits, key);
}

bool aur_is_prime(uint32_t n) {
    if (n < 4)
        return n >= 2;
    for (uint32_t k = 2; k <= n / k; ++k)
        if (n % k == 0)
            return false;
    return true;
}

void aur_primes(size_t count, uint32_t *primes) {
    for (uint32_t candidate = 2; count > 0; ++candidate) {
        if (!aur_is_prime(candidate))
            continue;
        *primes++ = candidate;
        --count;
    }
}
