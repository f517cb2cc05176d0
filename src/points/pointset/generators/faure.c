/* Faure 1982: the generator matrix of coordinate d is Pascal's triangle to the power d modulo a prime base
 * that is at least the dimension; every aligned run of base^m points is a (0,m,s)-net. With
 * scramble=lower-triangular each matrix is multiplied from the left by a random nonsingular lower-triangular
 * one (Matousek 1998, "random linear scrambling"), drawn from the seed: the points are still such a net but
 * lose their alignment, with which large bases are worse than random points. Random access, n up to 2^48 and
 * up to base^digits of a double's precision. n that is not a power of the base leaves the net incomplete: a
 * warning. Error O(log^d N / N). */
#include <stdlib.h>
#include <string.h>

#include "points/pointset/digits/digital.h"
#include "points/pointset/digits/radical_inverse.h"

/* Pascal's triangle to the power d: entry (r, c) is binomial(c, r) d^(c - r). Column by column. */
static void pascal_power(const aur_digital_rule *rule, uint32_t d, uint16_t *matrix) {
    const uint32_t base = rule->base;
    memset(matrix, 0, rule->row_count * rule->column_count * sizeof *matrix);
    matrix[0] = 1;
    for (size_t c = 1; c < rule->column_count; ++c) {
        const uint16_t *const before = matrix + (c - 1) * rule->row_count;
        uint16_t *const column = matrix + c * rule->row_count;
        for (size_t r = 0; r < rule->row_count; ++r) {
            const uint64_t above = r > 0 ? before[r - 1] : 0;
            column[r] = (uint16_t)((above + (uint64_t)d * before[r]) % base);
        }
    }
}

/* A random lower-triangular matrix times `matrix`. */
static void scramble_lower(const aur_digital_rule *rule, uint64_t key, uint16_t *matrix) {
    const size_t rows = rule->row_count;
    const uint32_t base = rule->base;
    for (size_t c = 0; c < rule->column_count; ++c) {
        uint16_t *const column = matrix + c * rows;
        for (size_t r = rows; r-- > 0;) {
            uint64_t sum = column[r] * (1 + aur_hash3(key, r, r) % (base - 1)) % base;
            for (size_t k = 0; k < r; ++k)
                sum += column[k] == 0 ? 0 : column[k] * (aur_hash3(key, r, k) % base) % base;
            column[r] = (uint16_t)(sum % base);
        }
    }
}

static uint32_t smallest_base(size_t dimension) {
    uint32_t base = dimension < 2 ? 2 : (uint32_t)dimension;
    while (!aur_is_prime(base))
        ++base;
    return base;
}

typedef struct faure_keys {
    int64_t base;
    enum { SCRAMBLE_NONE, SCRAMBLE_LOWER_TRIANGULAR } scramble;
} faure_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(faure_keys, "base", base, 2, AUR_RADICAL_BASE_LIMIT - 1, "auto",
                        "a prime of at least the dimension; auto: the smallest"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(faure_keys, "scramble", scramble, "none",
                       "random lower-triangular matrices (Matousek 1998)", "none", "lower-triangular")},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    faure_keys p = {.base = smallest_base(set->dimension)};
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    const int64_t base = p.base;
    if (!aur_is_prime((uint32_t)base) || (uint64_t)base < set->dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'faure': base must be a prime of at least the dimension %zu, such as %u, not %u",
                        set->dimension, (unsigned)smallest_base(set->dimension), (unsigned)base);
    const size_t digit_count = aur_digit_sum_places((uint32_t)base);
    aur_digital_rule *const rule =
        aur_digital_rule_create((uint32_t)base, digit_count, digit_count, set->dimension);
    if (rule == NULL)
        return aur_fail_memory(error);
    for (size_t d = 0; d < set->dimension; ++d) {
        uint16_t *const matrix = rule->digits + d * digit_count * digit_count;
        pascal_power(rule, (uint32_t)d, matrix);
        if (p.scramble == SCRAMBLE_LOWER_TRIANGULAR)
            scramble_lower(rule, aur_hash3(UINT64_C(0x6661757265), set->seed, d), matrix);
    }
    set->data = rule;
    set->net_base = (uint64_t)base;
    return AUR_OK;
}

const aur_square_set aur_set_faure = {
    .description =
        {.row = {.name = "faure",
                 .summary =
                     "(0,s)-sequence in a prime base (auto: the smallest); scramble=none|lower-triangular",
                 .source = "Faure 1982; Matousek 1998",
                 AUR_ROW_KEYS(keys)},
         .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
         .dimensions = {1, 4096},
         .maximum_size = AUR_INDEX_LIMIT,
         .best_sizes = AUR_SIZES_POWERS,
         .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = aur_fill_digital_rule,
};
