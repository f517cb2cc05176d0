/* One random point in each of N cells of equal area (Cook 1986): the square is cut into floor(sqrt N) columns
 * and each column into floor or ceil(N / columns) cells; the width of a column is proportional to its number
 * of cells. Random access, N up to 2^40. Error O(N^-1) for smooth functions, O(N^-3/4) across an edge. */
#include <math.h>

#include "points/pointset/set.h"

static void fill(const aur_pointset *set, const aur_block *block) {
    const uint64_t n = set->size;
    const uint64_t columns = (uint64_t)sqrt((double)n);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint64_t stream = aur_hash3(UINT64_C(0x6a6974746572), set->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            const uint64_t index = block->first + i;
            /* Column c begins with cell floor(c n / columns). */
            const uint64_t column = ((index + 1) * columns - 1) / n;
            const uint64_t begin = column * n / columns;
            const uint64_t cells = (column + 1) * n / columns - begin;
            const double jitter = aur_word_to_double(aur_hash2(stream, index));
            const double x = dimension == 0 ? ((double)begin + jitter * (double)cells) / (double)n
                                            : ((double)(index - begin) + jitter) / (double)cells;
            out[i] = fmin(x, AUR_BELOW_ONE);
        }
    }
}

const aur_square_set aur_set_jittered = {
    .description = {.row = {.name = "jittered",
                            .summary = "a random point in each of N cells of equal area",
                            .source = "Cook 1986"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = UINT64_C(1) << 40},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .fill = fill,
};
