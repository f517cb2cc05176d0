/* The (0,m,2)-net of Larcher and Pillichshammer 2001, in the form of Kollig and Keller 2002: x = i/N, and
 * binary digit j of y is the parity of the index's digits j, j + 1, ... Any N; a net when N is a power of
 * two. Its star discrepancy is among the lowest of all such nets. Error O(log N / N). */
#include "points/pointset/digits/run.h"

static void make_columns(uint64_t columns[AUR_DIGITAL_COLUMNS]) {
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        columns[k] = UINT64_MAX << (63 - k);
}

static void fill(const aur_pointset *set, const aur_block *block) {
    uint64_t columns[AUR_DIGITAL_COLUMNS];
    make_columns(columns);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        if (block->first_dimension + d == 0)
            aur_fill_fraction(set, block, d);
        else
            aur_fill_digital(set, columns, block, d);
    }
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    if (set->scramble != AUR_SCRAMBLE_NONE)
        return false;
    uint64_t columns[AUR_DIGITAL_COLUMNS];
    make_columns(columns);
    aur_run x, y;
    aur_run_of_multiples(block->first, 1 % set->size, set->size, &x);
    aur_run_of_digits(columns, AUR_SCRAMBLE_NONE, 0, block->first, block->first + block->count, &y);
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
}

const aur_square_set aur_set_larcher_pillichshammer = {
    .description = {.row = {.name = "larcher-pillichshammer",
                            .summary = "(0,m,2)-net of very low star discrepancy",
                            .source = "Larcher, Pillichshammer 2001; Kollig, Keller 2002"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .binary_net = true},
    .scramblings = AUR_SCRAMBLES_BINARY,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
