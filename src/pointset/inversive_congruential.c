/* The inversive congruential generator of Eichenauer and Lehn 1986, x <- 9102 / x + 36884165 modulo 2^31 - 1
 * with 1/0 = 0, consumed point by point: value i d + c makes coordinate c of point i. Its period is the full
 * 2^31 - 1, so n d is at most that. Seed 0 starts at x = 0. Error N^-1/2.
 *
 * Random access: the step is the map (b x + a) / x of the projective line, where 0 goes to infinity and
 * infinity to b. Full period means that this map runs through all 2^31 points of the line, and the
 * generator's sequence is the same without infinity. So value k is a power of a 2 x 2 matrix. */
#include "pointset/set.h"

static const uint64_t modulus = (UINT64_C(1) << 31) - 1;
static const uint64_t factor = 9102;
static const uint64_t summand = 36884165;

typedef struct matrix {
    uint64_t a, b, c, d;
} matrix;

static matrix multiply(matrix m, matrix n) {
    return (matrix){(m.a * n.a + m.b * n.c) % modulus, (m.a * n.b + m.b * n.d) % modulus,
                    (m.c * n.a + m.d * n.c) % modulus, (m.c * n.b + m.d * n.d) % modulus};
}

/* By Fermat's little theorem; 0 goes to 0. */
static uint64_t inverse(uint64_t x) {
    uint64_t result = 1;
    for (uint64_t exponent = modulus - 2; exponent > 0; exponent >>= 1) {
        if (exponent & 1u)
            result = result * x % modulus;
        x = x * x % modulus;
    }
    return result;
}

/* Value k of the stream that starts at 0, by jumping. */
static uint64_t value_at(uint64_t k) {
    k %= modulus;
    if (k == 0)
        return 0;
    matrix result = {1, 0, 0, 1};
    matrix step = {summand, factor, 1, 0};
    for (uint64_t exponent = k + 1; exponent > 0; exponent >>= 1) {
        if (exponent & 1u)
            result = multiply(result, step);
        step = multiply(step, step);
    }
    return result.b * inverse(result.d) % modulus;
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, const aur_pointset_options *options,
                          aur_error *error) {
    (void)keys;
    (void)options;
    if (set->size > modulus / set->dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'icg': its period holds no more than %u points of %zu dimensions",
                        (unsigned)(modulus / set->dimension), set->dimension);
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const uint64_t start = set->seed == 0 ? 0 : aur_mix64(set->seed) % modulus;
    const bool whole = block->dimension_count == set->dimension;
    uint64_t x = value_at(start + block->first * set->dimension);
    for (size_t i = 0; i < block->count; ++i) {
        for (size_t d = 0; d < block->dimension_count; ++d) {
            const size_t dimension = block->first_dimension + d;
            const uint64_t key = aur_scramble_key(block->seed, dimension);
            if (!whole)
                x = value_at(start + (block->first + i) * set->dimension + dimension);
            block->data[i * block->point_stride + d * block->coordinate_stride] =
                aur_scrambled_fraction(set->scramble, x, modulus, key);
            x = (factor * inverse(x) + summand) % modulus;
        }
    }
}

const aur_square_set aur_set_icg = {
    .description = {.name = "icg",
                    .keys = "",
                    .summary = "inversive congruential generator of full period",
                    .domains = "square, cube",
                    .sizes = "1..(2^31-1)/dimension",
                    .extensible = 1,
                    .source = "Eichenauer, Lehn 1986"},
    .minimum_dimension = 1,
    .maximum_dimension = (UINT64_C(1) << 31) - 1,
    .maximum_size = (UINT64_C(1) << 31) - 1,
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = fill,
};
