/* Digital sequences: the digits of a coordinate are a matrix times the digits of the index. */
#ifndef AUR_POINTSET_DIGITAL_H
#define AUR_POINTSET_DIGITAL_H

#include "pointset/set.h"

enum { AUR_DIGITAL_COLUMNS = 64 };

/* Base 2: a matrix is 64 words; column k is what bit k of the index contributes to the coordinate. */
static inline uint64_t aur_digital_word(const uint64_t columns[AUR_DIGITAL_COLUMNS], uint64_t index) {
    uint64_t word = 0;
    for (; index != 0; index &= index - 1)
        word ^= columns[__builtin_ctzll(index)];
    return word;
}

/* Fills coordinate `d` of the block. */
void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d);

/* Any prime base: matrices of row_count x column_count digits, one after another, column by column; digit 0
 * of the index is the lowest one, row 0 makes the coarsest digit of the coordinate. One allocation. */
typedef struct aur_digital_rule {
    uint32_t base;
    size_t row_count, column_count;
    uint16_t digits[];
} aur_digital_rule;

/* Uninitialised digits for `dimension` matrices; NULL when out of memory. Free with free(). */
aur_digital_rule *aur_digital_rule_create(uint32_t base, size_t row_count, size_t column_count,
                                          size_t dimension);

/* Fills a block from set->data, an aur_digital_rule. */
void aur_fill_digital_rule(const aur_pointset *set, const aur_block *block);

#endif
