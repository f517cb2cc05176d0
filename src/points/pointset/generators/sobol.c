/* Sobol 1967 with the direction numbers of Joe and Kuo 2008, in natural order (not Gray code): the first two
 * dimensions are a (0,2)-sequence, every aligned run of 2^m points is a (t,m,s)-net. Random access, n up to
 * 2^53, any dimension: beyond the 21201 of the table the dimensions repeat, at an index that is shuffled
 * within its net and Owen-scrambled, both by hashes that depend on the repeat (Burley 2020). n that is not a
 * power of two leaves a net incomplete: a warning. Error O(log^d N / N). */
#include "points/pointset/digits/digital.h"

enum { DIMENSIONS = AUR_SOBOL_DIMENSIONS, DEGREE_MAX = 18, LETTERS = 32 };

/* For each dimension after the first: its degree and the bits of its polynomial and numbers, in the format
 * described in the table's header. */
static const char packed[DIMENSIONS - 1][LETTERS] = {
#include "data/sobol.inc"
};

typedef struct directions {
    unsigned degree;
    uint32_t polynomial;
    uint32_t numbers[DEGREE_MAX];
} directions;

static unsigned value_of(char letter) {
    return letter == '_'   ? 63u
           : letter == '-' ? 62u
           : letter < 'A'  ? (unsigned)(letter - '0') + 52u
           : letter < 'a'  ? (unsigned)(letter - 'A')
                           : (unsigned)(letter - 'a') + 26u;
}

/* Reads the next bits of a row, from bit *at on. */
static uint32_t take_bits(const char *letters, unsigned count, unsigned *at) {
    uint32_t bits = 0;
    for (unsigned k = 0; k < count; ++k, ++*at)
        bits |= (value_of(letters[*at / 6]) >> *at % 6 & 1u) << k;
    return bits;
}

static directions unpack(const char row[LETTERS]) {
    directions d = {.degree = value_of(row[0])};
    unsigned at = 6;
    d.polynomial = take_bits(row, d.degree - 1, &at) << 1 | 1u | 1u << d.degree;
    for (unsigned k = 0; k < d.degree; ++k)
        d.numbers[k] = take_bits(row, k, &at) << 1 | 1u;
    return d;
}

void aur_sobol_matrix(size_t dimension, uint64_t columns[AUR_DIGITAL_COLUMNS]) {
    if (dimension == 0) {
        for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
            columns[k] = UINT64_C(1) << (63 - k);
        return;
    }
    const directions of = unpack(packed[dimension - 1]);
    const unsigned degree = of.degree;
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k) {
        if (k < degree) {
            columns[k] = (uint64_t)of.numbers[k] << (63 - k);
            continue;
        }
        columns[k] = columns[k - degree] ^ columns[k - degree] >> degree;
        for (unsigned j = 1; j < degree; ++j)
            if (of.polynomial >> (degree - j) & 1u)
                columns[k] ^= columns[k - j];
    }
}

/* Nested uniform scrambling of an index, with its lowest bit as the last digit: blocks of 2^m are mapped to
 * blocks of 2^m. */
static uint64_t shuffle_index(uint64_t index, uint64_t key) {
    uint64_t x = aur_reverse64(index);
    x ^= x * UINT64_C(0xa24baed4963ee406);
    x += key;
    x *= key >> 32 | 1u;
    x ^= x * UINT64_C(0x9fb21c651e98df24);
    x ^= x * UINT64_C(0xd1342543de82ef94);
    return aur_reverse64(x);
}

/* Coordinates beyond the table. */
static void fill_repeat(const aur_pointset *set, const uint64_t *columns, const aur_block *block, size_t d) {
    const size_t dimension = block->first_dimension + d;
    const uint64_t repeat = aur_hash2(UINT64_C(0x736f626f6c), dimension / DIMENSIONS);
    const uint64_t fixed = aur_hash2(repeat, dimension);
    const uint64_t key = aur_scramble_key(block->seed, dimension);
    double *const out = block->data + d * block->coordinate_stride;
    for (size_t i = 0; i < block->count; ++i) {
        const uint64_t word =
            aur_owen_word(aur_digital_word(columns, shuffle_index(block->first + i, repeat)), fixed);
        out[i] = aur_word_to_double(aur_scramble_word(set->scramble, word, key));
    }
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const size_t table_count = block->first_dimension < DIMENSIONS ? DIMENSIONS - block->first_dimension : 0;
    aur_block part = *block;
    if (part.dimension_count > table_count)
        part.dimension_count = table_count;
    aur_fill_digital_block(set, &part, aur_sobol_matrix);
    for (size_t d = part.dimension_count; d < block->dimension_count; ++d) {
        uint64_t columns[AUR_DIGITAL_COLUMNS];
        const size_t dimension = (block->first_dimension + d) % DIMENSIONS;
        fill_repeat(set, aur_digital_matrix_of(set, dimension, aur_sobol_matrix, columns), block, d);
    }
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    return aur_fill_digital_pairs(set, block, aur_sobol_matrix);
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    const size_t count = set->dimension < DIMENSIONS ? set->dimension : DIMENSIONS;
    return aur_prepare_digital(set, count, aur_sobol_matrix, error);
}

const aur_square_set aur_set_sobol = {
    .description = {.row = {.name = "sobol",
                            .summary = "(t,s)-sequence in base 2 in 21201 dimensions; further ones repeat "
                                       "them, shuffled and scrambled",
                            .source = "Sobol 1967; Joe, Kuo 2008; Burley 2020"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, SIZE_MAX},
                    .maximum_size = UINT64_C(1) << 53,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .extensible = true,
                    .binary_net = true},
    .scramblings = AUR_SCRAMBLES_BINARY,
    .prepare = prepare,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
