/* The (0,m,2)-net of Larcher and Pillichshammer 2001, in the form of Kollig and Keller 2002: x = i/N, and
 * binary digit j of y is the parity of the index's digits j, j + 1, ... Any N; a net when N is a power of
 * two. Its star discrepancy is among the lowest of all such nets. Error O(log N / N). */
#include "pointset/set.h"

static uint64_t second_word(uint64_t index) {
    uint64_t x = aur_reverse64(index);
    for (unsigned shift = 1; shift < 64; shift *= 2)
        x ^= x << shift;
    return x;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        if (dimension == 0) {
            aur_fill_fraction(set, block, d);
            continue;
        }
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i)
            out[i * block->point_stride] =
                aur_word_to_double(aur_scramble_word(set->scramble, second_word(block->first + i), key));
    }
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, const aur_pointset_options *options,
                          aur_error *error) {
    (void)keys;
    (void)error;
    aur_warn_incomplete_net(set, options, 2);
    return AUR_OK;
}

const aur_square_set aur_set_larcher_pillichshammer = {
    .description = {.name = "larcher-pillichshammer",
                    .keys = "",
                    .summary = "(0,m,2)-net of very low star discrepancy",
                    .domains = "square",
                    .sizes = "any; a net at 2^m",
                    .extensible = 0,
                    .binary_net = 1,
                    .source = "Larcher, Pillichshammer 2001; Kollig, Keller 2002"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .maximum_size = AUR_INDEX_LIMIT,
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = fill,
};
