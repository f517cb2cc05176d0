/* Roberts 2018: coordinate d of point i is 1/2 + i t^(d+1) modulo 1, where 1/t is the root above 1 of
 * x^(s+1) = x + 1 in s dimensions: the golden ratio for s = 1, the plastic number for s = 2. Random access,
 * any n, exact to a double for every i. Error O(log^2 N / N) (measured in two dimensions). */
#include "pointset/generators/r2.h"

#include <stdlib.h>

#include "pointset/set.h"

__extension__ typedef unsigned __int128 fraction;

/* The upper 128 bits of the product of two 128-bit fractions, cut; at most a few units too small. */
static fraction multiply(fraction a, fraction b) {
    const fraction a_high = a >> 64, a_low = (uint64_t)a;
    const fraction b_high = b >> 64, b_low = (uint64_t)b;
    const fraction middle = (a_high * b_low >> 64) + (a_low * b_high >> 64);
    return a_high * b_high + middle;
}

/* t in (1/2, 1) with t^s + t^(s+1) = 1, by bisection: the left side rises with t. */
static fraction root(size_t dimension) {
    fraction t = 0;
    for (int bit = 127; bit >= 0; --bit) {
        const fraction candidate = t | (fraction)1 << bit;
        fraction power = candidate;
        for (size_t k = 1; k < dimension; ++k)
            power = multiply(power, candidate);
        const fraction sum = power + multiply(power, candidate);
        if (sum >= power) /* else the sum went past 1 */
            t = candidate;
    }
    return t;
}

void aur_r2_steps(size_t dimension, aur_fraction128 *steps) {
    const fraction t = root(dimension);
    fraction power = t;
    for (size_t d = 0; d < dimension; ++d) {
        steps[d] = (aur_fraction128){(uint64_t)(power >> 64), (uint64_t)power};
        power = multiply(power, t);
    }
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    aur_fraction128 *const steps = malloc(set->dimension * sizeof *steps);
    if (steps == NULL)
        return aur_fail_memory(error);
    aur_r2_steps(set->dimension, steps);
    set->data = steps;
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const aur_fraction128 *const steps = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const aur_fraction128 step = steps[block->first_dimension + d];
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i)
            out[i * block->point_stride] =
                aur_word_to_double((UINT64_C(1) << 63) + aur_phase(step, block->first + i));
    }
}

const aur_square_set aur_set_r2 = {
    .description = {.row = {.name = "r2",
                            .summary =
                                "additive recurrence of the plastic number (its kin in other dimensions)",
                            .source = "Roberts 2018"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, AUR_R2_DIMENSIONS},
                    .maximum_size = UINT64_MAX,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = fill,
};
