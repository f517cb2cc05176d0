/* Digital sequences in any prime base. */
#include <stdlib.h>

#include "points/pointset/digits/digital.h"
#include "points/pointset/digits/radical_inverse.h"

enum { SHORT_RUN = 16 }; /* shorter runs are computed one index at a time */

aur_digital_rule *aur_digital_rule_create(uint32_t base, size_t row_count, size_t column_count,
                                          size_t dimension) {
    const size_t per_matrix = row_count * column_count;
    if (dimension > (SIZE_MAX - sizeof(aur_digital_rule)) / sizeof(uint16_t) / per_matrix)
        return NULL;
    aur_digital_rule *const rule = malloc(sizeof *rule + dimension * per_matrix * sizeof rule->digits[0]);
    if (rule == NULL)
        return NULL;
    rule->base = base;
    rule->row_count = row_count;
    rule->column_count = column_count;
    return rule;
}

/* One coordinate of one point. The row sums stay below 64 2^32. */
static double coordinate(const aur_digital_rule *rule, const uint16_t *matrix, uint64_t index,
                         aur_digits digits, uint64_t key) {
    uint64_t rows[AUR_DIGITAL_COLUMNS] = {0};
    const uint16_t *column = matrix;
    for (; index > 0; index /= rule->base, column += rule->row_count) {
        const uint64_t digit = index % rule->base;
        for (size_t r = 0; digit != 0 && r < rule->row_count; ++r)
            rows[r] += digit * column[r];
    }
    aur_digit_sum sum = aur_digit_sum_begin(rule->base, digits, key);
    for (size_t r = 0; aur_digit_sum_has_room(&sum); ++r) {
        if (r >= rule->row_count && digits == AUR_DIGITS_PLAIN)
            break;
        aur_digit_sum_put(&sum, r < rule->row_count ? (uint32_t)(rows[r] % rule->base) : 0);
    }
    return aur_digit_sum_value(&sum);
}

/* The state of a run of points: the digits of a coordinate, before any scrambling, updated from index to
 * index. Adding a column `base` times adds 0, so that a digit that wraps to 0 needs no special case: the next
 * digit adds its column. */
typedef struct digit_rows {
    uint32_t rows[AUR_DIGITAL_COLUMNS];   /* digits, the most significant first */
    uint64_t powers[AUR_DIGITAL_COLUMNS]; /* the weight of a digit */
    uint64_t numerator, denominator;
} digit_rows;

static digit_rows rows_at(const aur_digital_rule *rule, const uint16_t *matrix, uint64_t index) {
    digit_rows r = {.denominator = 1};
    const uint16_t *column = matrix;
    for (; index > 0; index /= rule->base, column += rule->row_count)
        for (size_t k = 0; k < rule->row_count; ++k)
            r.rows[k] = (uint32_t)((r.rows[k] + index % rule->base * column[k]) % rule->base);
    for (size_t k = rule->row_count; k-- > 0; r.denominator *= rule->base) {
        r.powers[k] = r.denominator;
        r.numerator += r.rows[k] * r.denominator;
    }
    return r;
}

/* Adds a column whose rows from `count` on are 0. */
static inline void add_column(digit_rows *r, uint32_t base, size_t count, const uint16_t *column) {
    uint64_t numerator = r->numerator;
    for (size_t k = 0; k < count; ++k) {
        const uint32_t sum = r->rows[k] + column[k];
        const uint32_t digit = sum < base ? sum : sum - base;
        numerator += ((uint64_t)digit - r->rows[k]) * r->powers[k];
        r->rows[k] = digit;
    }
    r->numerator = numerator;
}

/* Increments through a run, with the same fractions as random access. False if the points have more digits
 * than fit. */
static bool fill_by_counting(const aur_digital_rule *rule, const uint16_t *matrix, const aur_block *block,
                             double *out) {
    const uint32_t base = rule->base;
    const size_t rows = rule->row_count;
    if (rows > AUR_DIGITAL_COLUMNS)
        return false;
    digit_rows r = rows_at(rule, matrix, block->first);
    size_t used = rows; /* of the first column: 1 if the matrix is upper triangular */
    while (used > 0 && matrix[used - 1] == 0)
        --used;
    uint32_t lowest = (uint32_t)(block->first % base);
    uint64_t above = block->first / base;
    for (size_t i = 0; i < block->count; ++i) {
        out[i] = aur_fraction(r.numerator, r.denominator);
        add_column(&r, base, used, matrix);
        if (++lowest < base)
            continue;
        lowest = 0;
        uint64_t digits = above++;
        const uint16_t *column = matrix + rows;
        for (; digits % base == base - 1; digits /= base, column += rows)
            add_column(&r, base, rows, column);
        if (i + 1 < block->count)
            add_column(&r, base, rows, column);
    }
    return true;
}

void aur_fill_digital_rule(const aur_pointset *set, const aur_block *block) {
    const aur_digital_rule *const rule = set->data;
    const aur_digits digits = aur_digits_of(set->scramble);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint16_t *const matrix = rule->digits + dimension * rule->row_count * rule->column_count;
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        if (digits == AUR_DIGITS_PLAIN && block->count >= SHORT_RUN &&
            fill_by_counting(rule, matrix, block, out))
            continue;
        for (size_t i = 0; i < block->count; ++i)
            out[i] = coordinate(rule, matrix, block->first + i, digits, key);
    }
}
