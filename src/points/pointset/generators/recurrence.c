/* Additive recurrences, random access, any n, exact to a double for every i.
 *
 * golden (Schretter 2012, eq. 4): G_s(i) = s + i/Phi modulo 1 for i = 1, 2, ..., so that point k is G_s(k +
 * 1); one dimension. Every prefix is uniform. Error O(log N / N).
 *
 * r2 (Roberts 2018): coordinate d of point i is 1/2 + i t^(d+1) modulo 1, where 1/t is the root above 1 of
 * x^(s+1) = x + 1 in s dimensions: the golden ratio for s = 1, the plastic number for s = 2. Error
 * O(log^2 N / N) (measured in two dimensions). */

#include <stdlib.h>

#include "points/pointset/digits/run.h"
#include "points/pointset/generators/golden.h"
#include "points/pointset/set.h"

/* The upper 128 bits of the product of two 128-bit fractions, truncated; at most a few units too small. */
static aur_wide multiply(aur_wide a, aur_wide b) {
    const aur_wide a_high = a >> 64, a_low = (uint64_t)a;
    const aur_wide b_high = b >> 64, b_low = (uint64_t)b;
    const aur_wide middle = (a_high * b_low >> 64) + (a_low * b_high >> 64);
    return a_high * b_high + middle;
}

/* t in (1/2, 1) with t^s + t^(s+1) = 1, by bisection: the left side rises with t. */
static aur_wide root(size_t dimension) {
    aur_wide t = 0;
    for (int bit = 127; bit >= 0; --bit) {
        const aur_wide candidate = t | (aur_wide)1 << bit;
        aur_wide power = candidate;
        for (size_t k = 1; k < dimension; ++k)
            power = multiply(power, candidate);
        const aur_wide sum = power + multiply(power, candidate);
        if (sum >= power) /* else the sum exceeded 1 */
            t = candidate;
    }
    return t;
}

enum { R2_DIMENSIONS = 4096 };

static aur_recurrence *create(size_t dimension) {
    return malloc(sizeof(aur_recurrence) + dimension * sizeof(aur_fraction128));
}

/* The golden ratio sequence from s in [0,1), one dimension. */
static void recurrence_golden(double s, aur_recurrence *recurrence) {
    recurrence->start = aur_golden_start(s);
    recurrence->steps[0] = aur_golden_fraction;
}

/* Roberts' sequence. */
static void recurrence_r2(size_t dimension, aur_recurrence *recurrence) {
    const aur_wide t = root(dimension);
    aur_wide power = t;
    recurrence->start = UINT64_C(1) << 63;
    for (size_t d = 0; d < dimension; ++d) {
        recurrence->steps[d] = (aur_fraction128){(uint64_t)(power >> 64), (uint64_t)power};
        power = multiply(power, t);
    }
}

typedef struct golden_keys {
    double seed;
} golden_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(golden_keys, "seed", seed, 0.0, 1.0, "0", "s: where the sequence starts"),
     .maximum_open = true},
};

static aur_result prepare_golden(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    golden_keys p;
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    set->data = create(1);
    if (set->data == NULL)
        return aur_fail_memory(error);
    recurrence_golden(p.seed, set->data);
    return AUR_OK;
}

static aur_result prepare_r2(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    (void)parameters;
    set->data = create(set->dimension);
    if (set->data == NULL)
        return aur_fail_memory(error);
    recurrence_r2(set->dimension, set->data);
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const aur_recurrence *const recurrence = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        aur_multiples_of_fraction run = {.step = recurrence->steps[block->first_dimension + d],
                                         .start = recurrence->start,
                                         .first = block->first};
        aur_runs(block->count)->fractions(&run, block->count, block->data + d * block->coordinate_stride);
    }
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    const aur_recurrence *const recurrence = set->data;
    aur_run x, y;
    aur_run_of_fraction(recurrence->start, recurrence->steps[0], block->first, &x);
    aur_run_of_fraction(recurrence->start, recurrence->steps[1], block->first, &y);
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
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
    .prepare = prepare_golden,
    .fill = fill,
};

const aur_square_set aur_set_r2 = {
    .description = {.row = {.name = "r2",
                            .summary =
                                "additive recurrence of the plastic number, generalised to any dimension",
                            .source = "Roberts 2018"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, R2_DIMENSIONS},
                    .maximum_size = UINT64_MAX,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare_r2,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
