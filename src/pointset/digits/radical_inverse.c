#include "pointset/digits/radical_inverse.h"

#include "pointset/digits/digital.h"
#include "pointset/runs.h"

enum { SHORT_RUN = 8, TABLE_LENGTH = 1024 };

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
        changed = (digit + below(aur_hash2(sum->key, sum->place), base)) % base;
    } else if (sum->digits == AUR_DIGITS_PERMUTE) {
        changed = permute(digit, base, aur_hash2(sum->key, sum->place));
    } else if (sum->digits == AUR_DIGITS_NESTED) {
        changed = permute(digit, base, sum->prefix);
        sum->prefix = aur_hash2(sum->prefix, digit);
    }
    ++sum->place;
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
    return sum.place;
}

double aur_radical_inverse(uint32_t base, uint64_t index, aur_digits digits, uint64_t key) {
    aur_digit_sum sum = aur_digit_sum_begin(base, digits, key);
    if (digits == AUR_DIGITS_PLAIN) {
        for (; index > 0; index /= base) {
            sum.numerator = sum.numerator * base + index % base;
            sum.denominator *= base;
        }
    } else {
        /* The index's endless leading zeros are digits too. */
        for (; aur_digit_sum_has_room(&sum); index /= base)
            aur_digit_sum_put(&sum, (uint32_t)(index % base));
    }
    return aur_digit_sum_value(&sum);
}

/* In base 2 the radical inverse is the digital sequence of the identity matrix. */
static void fill_binary(const aur_pointset *set, const aur_block *block, size_t d) {
    uint64_t columns[AUR_DIGITAL_COLUMNS];
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        columns[k] = UINT64_C(1) << (63 - k);
    aur_fill_digital(set, columns, block, d);
}

/* Numerators of points over one denominator: the point whose lower digits are `lower` has table[lower], and
 * what its higher digits add all points share that have the same. */
typedef struct reversed_digits {
    uint64_t base, denominator;
    uint64_t span; /* a power of the base: how many sequences of lower digits there are */
    size_t width;  /* how many of them the table holds: `span`, or the first ones of a large base */
    double table[TABLE_LENGTH];
} reversed_digits;

static void make_table(reversed_digits *r, size_t count) {
    for (r->span = r->base; r->span * r->base <= TABLE_LENGTH && r->span < count;)
        r->span *= r->base;
    r->width = r->span < TABLE_LENGTH ? (size_t)r->span : TABLE_LENGTH;
    r->table[0] = 0.0;
    uint64_t unit = r->denominator;
    for (size_t made = 1; made < r->width;) {
        unit /= r->base;
        const size_t before = made;
        for (; made < r->base * before && made < r->width; ++made)
            r->table[made] = r->table[made % before] + (double)(int64_t)(made / before * unit);
    }
}

/* In reversed digits over one denominator, which all of the run's points share. A fraction of two integers
 * below 2^53 is rounded correctly whatever its terms, so the bits are those of random access. False when the
 * denominator is not below 2^53. */
static bool fill_by_table(const aur_block *block, uint32_t base, double *out) {
    const uint64_t last = block->first + block->count - 1;
    reversed_digits r = {.base = base, .denominator = base};
    for (uint64_t rest = last / base; rest > 0; rest /= base) {
        r.denominator *= base;
        if (r.denominator > UINT64_C(1) << 53)
            return false;
    }
    make_table(&r, block->count);
    for (size_t i = 0; i < block->count;) {
        const uint64_t index = block->first + i;
        const uint64_t lower = index % r.span;
        const size_t within = (size_t)(lower % r.width);
        uint64_t unit = r.denominator / r.span;
        /* Where the table is too short for the lowest digit it begins anew. */
        uint64_t shared = (lower - within) * unit;
        for (uint64_t rest = index / r.span; rest > 0; rest /= base) {
            unit /= base;
            shared += rest % base * unit;
        }
        const uint64_t here = r.span - lower < r.width - within ? r.span - lower : r.width - within;
        const size_t count = here < block->count - i ? (size_t)here : block->count - i;
        aur_runs()->quotients((double)(int64_t)shared, r.table + within, (double)(int64_t)r.denominator,
                              count, out + i);
        i += count;
    }
    return true;
}

void aur_fill_radical_inverse(const aur_pointset *set, const aur_block *block, size_t d, uint32_t base,
                              aur_digits digits) {
    if (base == 2 && digits != AUR_DIGITS_PERMUTE) {
        fill_binary(set, block, d);
        return;
    }
    const size_t dimension = block->first_dimension + d;
    double *const out = block->data + d * block->coordinate_stride;
    if (digits == AUR_DIGITS_PLAIN && block->count >= SHORT_RUN && fill_by_table(block, base, out))
        return;
    /* Permutations belong to the set and stay when it is scrambled again. */
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
