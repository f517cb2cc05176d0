/* The (0,m,2)-net of Larcher and Pillichshammer 2001, in the form of Kollig and Keller 2002: x = i/N, and
 * binary digit j of y is the parity of the index's digits j, j + 1, ... Any N; a net when N is a power of
 * two. Its star discrepancy is among the lowest of all such nets. Error O(log N / N). */
#include "pointset/digits/digital.h"

static void fill(const aur_pointset *set, const aur_block *block) {
    uint64_t columns[AUR_DIGITAL_COLUMNS];
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        columns[k] = UINT64_MAX << (63 - k);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        if (block->first_dimension + d == 0)
            aur_fill_fraction(set, block, d);
        else
            aur_fill_digital(set, columns, block, d);
    }
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
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill,
};
