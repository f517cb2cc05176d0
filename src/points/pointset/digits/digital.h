/* Digital sequences: the digits of a coordinate are a matrix times the digits of the index. */
#pragma once

#include "points/pointset/set.h"

enum { AUR_DIGITAL_COLUMNS = 64 };

/* Base 2: a matrix is 64 words; column k is what bit k of the index contributes to the coordinate. */
static inline uint64_t aur_digital_word(const uint64_t columns[AUR_DIGITAL_COLUMNS], uint64_t index) {
    uint64_t word = 0;
    for (; index != 0; index &= index - 1)
        word ^= columns[__builtin_ctzll(index)];
    return word;
}

/* Writes the matrix of a dimension. */
typedef void (*aur_digital_matrix)(size_t dimension, uint64_t columns[AUR_DIGITAL_COLUMNS]);

/* An aur_digital_matrix of Sobol's sequence, for the dimensions of Joe and Kuo's table. */
enum { AUR_SOBOL_DIMENSIONS = 21201 };
void aur_sobol_matrix(size_t dimension, uint64_t columns[AUR_DIGITAL_COLUMNS]);

/* Computes the first `count` matrices into set->data. */
aur_result aur_prepare_digital(aur_pointset *set, size_t count, aur_digital_matrix make, aur_error *error);

/* The prepared matrix, or one computed in `columns` if set->data is NULL. */
const uint64_t *aur_digital_matrix_of(const aur_pointset *set, size_t dimension, aur_digital_matrix make,
                                      uint64_t columns[AUR_DIGITAL_COLUMNS]);

/* Fills coordinate `d` of a block. */
void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d);

/* Fill a block of any coordinates, or of two interleaved ones (aur_square_set.fill_pairs). */
void aur_fill_digital_block(const aur_pointset *set, const aur_block *block, aur_digital_matrix make);
bool aur_fill_digital_pairs(const aur_pointset *set, const aur_block *block, aur_digital_matrix make);

/* Any prime base: matrices of row_count x column_count digits, one after another, column by column; digit 0
 * of the index is the lowest one, row 0 gives the most significant digit of the coordinate. One allocation.
 */
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
