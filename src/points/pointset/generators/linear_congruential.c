/* The minimal standard generator, x <- 16807 x modulo 2^31 - 1 (Park and Miller 1988), consumed point by
 * point: value i d + c gives coordinate c of point i. Random access by modular powers; n d at most the period
 * 2^31 - 2. Seed 0 starts at x = 1, so that the stream begins 16807, 282475249, ... Error N^-1/2. */
#include "points/pointset/set.h"

static const uint64_t modulus = (UINT64_C(1) << 31) - 1;
static const uint64_t multiplier = 16807;

static uint64_t power(uint64_t base, uint64_t exponent) {
    uint64_t result = 1;
    for (; exponent > 0; exponent >>= 1) {
        if (exponent & 1u)
            result = result * base % modulus;
        base = base * base % modulus;
    }
    return result;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const uint64_t start = set->seed == 0 ? 1 : 1 + aur_mix64(set->seed) % (modulus - 1);
    const uint64_t stride = power(multiplier, set->dimension);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const uint64_t skipped = block->first * set->dimension + block->first_dimension + d + 1;
        uint64_t x = start * power(multiplier, skipped) % modulus;
        const uint64_t key = aur_scramble_key(block->seed, block->first_dimension + d);
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            out[i] = aur_scrambled_fraction(set->scramble, x, modulus, key);
            x = x * stride % modulus;
        }
    }
}

const aur_square_set aur_set_lcg = {
    .description = {.row = {.name = "lcg",
                            .summary = "minimal standard linear congruential generator",
                            .source = "Park, Miller 1988"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, (UINT64_C(1) << 31) - 2},
                    .maximum_size = (UINT64_C(1) << 31) - 2,
                    .counts_coordinates = true,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill,
};
