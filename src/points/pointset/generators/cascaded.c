/* Cascaded Sobol' points (Paulin, Coeurjolly, Iehl, Bonneel, Keller, Ostromoukhov 2021): each coordinate,
 * truncated to the digits of the number of points, is the index of the next one in Sobol's sequence, so that
 * consecutive coordinates are a (0,m,2)-net. All coordinates are digital: their matrices are products. The
 * direction numbers are those of Joe and Kuo 2008, not the paper's. Sets of different sizes are different. */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/pointset/digits/digital.h"

enum { DIMENSIONS = AUR_SOBOL_DIMENSIONS };

static aur_result prepare(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    uint64_t(*const matrices)[AUR_DIGITAL_COLUMNS] = malloc(set->dimension * sizeof *matrices);
    if (matrices == NULL)
        return aur_fail_memory(error);
    unsigned digits = 1; /* of the indices */
    while (digits < 63 && UINT64_C(1) << digits < set->size)
        ++digits;
    for (size_t d = 0; d < set->dimension; ++d) {
        uint64_t matrix[AUR_DIGITAL_COLUMNS];
        aur_sobol_matrix(d, matrix);
        for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
            matrices[d][k] =
                d == 0 ? matrix[k]
                       : aur_digital_word(matrix, k < digits ? matrices[d - 1][k] >> (64 - digits) : 0);
    }
    set->data = matrices;
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    aur_fill_digital_block(set, block, NULL);
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    return aur_fill_digital_pairs(set, block, NULL);
}

const aur_square_set aur_set_cascaded = {
    .description = {.row = {.name = "cascaded",
                            .summary =
                                "Sobol' points whose consecutive pairs of coordinates are all (0,m,2)-nets",
                            .source = "Paulin 2021"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, DIMENSIONS},
                    .maximum_size = UINT64_C(1) << 48,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .binary_net = true},
    .scramblings = AUR_SCRAMBLES_BINARY,
    .prepare = prepare,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
