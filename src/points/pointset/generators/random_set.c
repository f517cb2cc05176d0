/* Independent random points, each coordinate a hash of (seed, dimension, index): error N^-1/2. */
#include "points/pointset/digits/run.h"
#include "points/pointset/set.h"

static uint64_t stream_of(const aur_pointset *set, size_t dimension) {
    return aur_hash3(UINT64_C(0x72616e646f6d), set->seed, dimension);
}

static void fill(const aur_pointset *set, const aur_block *block) {
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint64_t stream = stream_of(set, dimension);
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        if (set->scramble != AUR_SCRAMBLE_DIGIT && set->scramble != AUR_SCRAMBLE_OWEN) {
            aur_runs(block->count)->hashes(&(aur_hashes){stream, block->first}, block->count, out);
            continue;
        }
        for (size_t i = 0; i < block->count; ++i) {
            const uint64_t word = aur_hash2(stream, block->first + i);
            out[i] = aur_word_to_double(aur_scramble_word(set->scramble, word, key));
        }
    }
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    if (set->scramble != AUR_SCRAMBLE_NONE)
        return false;
    aur_run x, y;
    aur_run_of_hashes(stream_of(set, 0), block->first, &x);
    aur_run_of_hashes(stream_of(set, 1), block->first, &y);
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
}

const aur_square_set aur_set_random = {
    .description = {.row = {.name = "random",
                            .summary = "independent uniform random points, counter-based",
                            .source = "Salmon 2011 (counter-based generation)"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, SIZE_MAX},
                    .maximum_size = UINT64_MAX,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
