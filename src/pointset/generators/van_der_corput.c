/* van der Corput 1935: the radical inverse in base 2, one dimension. Random access, n up to 2^48; equally
 * spaced when n is a power of two. Error O(log N / N). */
#include "pointset/digits/radical_inverse.h"

static void fill(const aur_pointset *set, const aur_block *block) {
    if (block->dimension_count > 0)
        aur_fill_radical_inverse(set, block, 0, 2, AUR_DIGITS_PLAIN);
}

const aur_square_set aur_set_van_der_corput = {
    .description = {.row = {.name = "van-der-corput",
                            .summary = "radical inverse in base 2, one dimension",
                            .source = "van der Corput 1935"},
                    .domains = AUR_ON_CUBE,
                    .dimensions = {1, 1},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill,
};
