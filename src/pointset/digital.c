#include "pointset/digital.h"

#include <stdlib.h>
#include <string.h>

#include "pointset/radical_inverse.h"

/* Runs shorter than this are computed one index at a time. */
enum { SHORT_RUN = 16 };

void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d) {
    const uint64_t key = aur_scramble_key(block->seed, block->first_dimension + d);
    double *const out = block->data + d * block->coordinate_stride;
    if (block->count < SHORT_RUN) {
        for (size_t i = 0; i < block->count; ++i) {
            const uint64_t word = aur_digital_word(columns, block->first + i);
            out[i * block->point_stride] = aur_word_to_double(aur_scramble_word(set->scramble, word, key));
        }
        return;
    }
    /* From one index to the next the lowest bits flip, as many as there are trailing ones and one more. */
    uint64_t flips[AUR_DIGITAL_COLUMNS];
    flips[0] = columns[0];
    for (unsigned k = 1; k < AUR_DIGITAL_COLUMNS; ++k)
        flips[k] = flips[k - 1] ^ columns[k];
    uint64_t word = aur_digital_word(columns, block->first);
    for (size_t i = 0; i < block->count; ++i) {
        out[i * block->point_stride] = aur_word_to_double(aur_scramble_word(set->scramble, word, key));
        word ^= flips[__builtin_ctzll(block->first + i + 1)];
    }
}

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

void aur_fill_digital_rule(const aur_pointset *set, const aur_block *block) {
    const aur_digital_rule *const rule = set->data;
    const aur_digits digits = aur_digits_of(set->scramble);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint16_t *const matrix = rule->digits + dimension * rule->row_count * rule->column_count;
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i)
            out[i * block->point_stride] = coordinate(rule, matrix, block->first + i, digits, key);
    }
}
