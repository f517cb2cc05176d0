/* The golden ratio sequence G_s(i) = s + i/Phi modulo 1 (Schretter 2012, eq. 4) for i = 1, 2, ..., so that
 * point k is G_s(k + 1); one dimension. Random access, any n; any prefix is evenly spread. Exact to a double
 * for every i. Error O(log N / N). */
#include "pointset/generators/golden.h"

#include <stdlib.h>

#include "pointset/set.h"

typedef struct golden_keys {
    double seed;
} golden_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(golden_keys, "seed", seed, 0.0, 1.0, "0", "s: where the sequence starts"),
     .maximum_open = true},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    golden_keys p;
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    uint64_t *const word = malloc(sizeof *word);
    if (word == NULL)
        return aur_fail_memory(error);
    *word = aur_golden_start(p.seed);
    set->data = word;
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const uint64_t seed_word = *(const uint64_t *)set->data;
    for (size_t i = 0; i < block->count && block->dimension_count > 0; ++i)
        block->data[i * block->point_stride] =
            aur_word_to_double(seed_word + aur_phase(aur_golden_fraction, block->first + i));
}

const aur_square_set aur_set_golden = {
    .description = {.row = {.name = "golden",
                            .summary = "golden ratio sequence, one dimension",
                            .source = "Schretter 2012",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_CUBE,
                    .dimensions = {1, 1},
                    .maximum_size = UINT64_MAX,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = fill,
};
