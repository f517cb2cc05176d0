/* Digital nets of order 2 and 3 (Dick 2008, 2011): the binary digits of a coordinate are interleaved from 2
 * or 3 coordinates of Sobol's sequence. Error O(log^.. N / N^order) for functions with as many square
 * integrable mixed derivatives; the RMS error over OWEN, which scrambles the coordinates before interleaving,
 * is smaller by N^-1/2. Random access, n up to 2^53. */
#include <stdlib.h>

#include "points/pointset/digits/digital.h"

enum { BYTES = 4, VALUES = 256 }; /* of a component's first digits, as many as fit a double */

/* The matrices of all components follow. */
typedef struct interlaced {
    size_t order;
    uint64_t spread[VALUES]; /* the bits of a byte, `order` apart, the highest at bit 63 */
    uint64_t columns[][AUR_DIGITAL_COLUMNS];
} interlaced;

/* The first digits of a component, `order` apart. */
static uint64_t spread_word(const interlaced *data, uint64_t word) {
    uint64_t spread = 0;
    for (size_t b = 0; b < BYTES; ++b) {
        const size_t shift = 8 * b * data->order;
        if (shift < 64)
            spread |= data->spread[word >> (56 - 8 * b) & 0xff] >> shift;
    }
    return spread;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const interlaced *const data = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t component = (block->first_dimension + d) * data->order;
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            uint64_t sum = 0;
            for (size_t j = 0; j < data->order; ++j) {
                const uint64_t word = aur_digital_word(data->columns[component + j], block->first + i);
                const uint64_t key = aur_scramble_key(block->seed, component + j);
                sum |= spread_word(data, aur_scramble_word(set->scramble, word, key)) >> j;
            }
            out[i] = aur_word_to_double(sum);
        }
    }
}

typedef struct interlaced_keys {
    uint64_t order;
} interlaced_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(interlaced_keys, "order", order, 2, 3, "2",
                        "number of Sobol' coordinates that are interleaved into one")},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    interlaced_keys p = {0};
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    const size_t order = (size_t)p.order, components = set->dimension * order;
    if (components > AUR_SOBOL_DIMENSIONS)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'interlaced' has at most %zu dimensions of order %zu, not %zu",
                        AUR_SOBOL_DIMENSIONS / order, order, set->dimension);
    interlaced *const data = malloc(sizeof *data + components * sizeof data->columns[0]);
    set->data = data;
    if (data == NULL)
        return aur_fail_memory(error);
    data->order = order;
    for (size_t v = 0; v < VALUES; ++v) {
        data->spread[v] = 0;
        for (size_t bit = 0; bit < 8; ++bit)
            data->spread[v] |= (uint64_t)(v >> (7 - bit) & 1) << (63 - bit * order);
    }
    for (size_t c = 0; c < components; ++c)
        aur_sobol_matrix(c, data->columns[c]);
    return AUR_OK;
}

const aur_square_set aur_set_interlaced = {
    .description = {.row = {.name = "interlaced",
                            .summary = "digital nets of order 2 or 3: interleaved digits of Sobol' "
                                       "coordinates, for smooth functions",
                            .source = "Dick 2008; Dick 2011",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, AUR_SOBOL_DIMENSIONS / 2},
                    .maximum_size = UINT64_C(1) << 53,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_BINARY,
    .prepare = prepare,
    .fill = fill,
};
