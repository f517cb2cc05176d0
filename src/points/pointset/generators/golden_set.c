/* Golden point sets (Schretter 2012, sec. 3 and appendix): the golden ratio sequence paired with the same
 * sequence in ascending order, without sorting. The ordered coordinate is prepared in a table of N indices; n
 * up to 2^32. form=one-seed: (G_s(i), sorted G_s) for i = 1..N; form=two-seeds: (sorted G_s, G_r(i)) as in
 * the appendix, r drawn from the options' seed. Error about O(log N / N) (measured). */
#include <stdlib.h>

#include "points/pointset/digits/run.h"
#include "points/pointset/generators/golden.h"
#include "points/pointset/set.h"

enum { PART_LENGTH = 512 };

typedef struct golden_set {
    bool two_seeds;
    uint64_t seed_word, second_word;
    uint32_t order[];
} golden_set;

/* The index of the smallest value of G_s(0..count-1), by the records on the way to it: the next smaller value
 * after a record is n indices later, where n is the first number whose multiple of the golden ratio is below
 * the next integer by no more than the record. Numbers n with smaller differences than all before are the
 * Fibonacci numbers of every other rank (1/Phi is above 1/2, so 1, 3, 8, ...). */
static uint64_t smallest_of(uint64_t seed_word, uint64_t count) {
    uint64_t index = 0;
    uint64_t down = 1;
    uint64_t up = 1;
    aur_wide value = (aur_wide)seed_word << 64;
    while (down < count - index) {
        const aur_wide fall = 0 - aur_phase128(aur_golden_fraction, down);
        if (fall <= value) {
            index += down;
            value -= fall;
        } else {
            up += down;
            down += up;
        }
    }
    return index;
}

aur_golden_order aur_golden_order_of(uint64_t seed_word, uint64_t count) {
    /* Gaps between the values of indices that are Fibonacci numbers apart: one of even and one of odd rank,
     * so that one goes up and the other down (1/Phi is above 1/2, so 1, 3, 8, ... go down from above). */
    uint64_t larger = 1;
    uint64_t smaller = 1;
    bool odd = false;
    while (larger + smaller < count) {
        const uint64_t sum = larger + smaller;
        smaller = larger;
        larger = sum;
        odd = !odd;
    }
    aur_golden_order order = {.count = count, .increment = odd ? larger : smaller};
    order.decrement = odd ? smaller : larger;
    order.first = smallest_of(seed_word, count);
    return order;
}

typedef struct golden_set_keys {
    enum { ONE_SEED, TWO_SEEDS } form;
    double seed;
} golden_set_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(golden_set_keys, "form", form, "one-seed",
                       "the sequence paired with its sorted copy, from one start or from two", "one-seed",
                       "two-seeds")},
    {AUR_KEY_OF_REAL(golden_set_keys, "seed", seed, 0.0, 1.0, "0", "s: where the sequence starts"),
     .maximum_open = true},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    golden_set_keys p;
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    golden_set *const data = malloc(sizeof *data + set->size * sizeof data->order[0]);
    if (data == NULL)
        return aur_fail_memory(error);
    data->two_seeds = p.form == TWO_SEEDS;
    data->seed_word = aur_seed_word(p.seed);
    if (!data->two_seeds)
        data->seed_word += aur_phase(aur_golden_fraction, 1);
    data->second_word = aur_hash2(UINT64_C(0x676f6c64656e), set->seed);
    const aur_golden_order order = aur_golden_order_of(data->seed_word, set->size);
    uint64_t index = order.first;
    for (uint64_t i = 0; i < set->size; ++i) {
        data->order[i] = (uint32_t)index;
        if (i + 1 < set->size)
            index = aur_golden_next(&order, index);
    }
    set->data = data;
    return AUR_OK;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const golden_set *const data = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const bool sorted = (block->first_dimension + d == 0) == data->two_seeds;
        const uint64_t start = !sorted && data->two_seeds ? data->second_word : data->seed_word;
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            const uint64_t index = block->first + i;
            const uint64_t rank = sorted ? data->order[index] : index;
            out[i] = aur_word_to_double(start + aur_phase(aur_golden_fraction, rank));
        }
    }
}

static void put_part(const aur_output *output, aur_strides strides, size_t coordinate, size_t first,
                     size_t count, const double *values) {
    const aur_output from = {
        .doubles = output->doubles != NULL ? output->doubles + coordinate * strides.coordinate : NULL,
        .floats = output->floats != NULL ? output->floats + coordinate * strides.coordinate : NULL};
    aur_output_put(&from, strides, first, count, values);
}

aur_result aur_golden_set_points(double s, size_t count, const aur_output *output, aur_error *error) {
    if (!(s >= 0.0 && s < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a seed must be at least 0 and below 1, not %g", s);
    if (count == 0 || count > UINT64_C(1) << 32)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a golden set has 1 to 2^32 points, not %zu", count);
    aur_strides strides;
    const aur_result result = aur_output_open(output, 2, count, &strides, error);
    if (result != AUR_OK)
        return result;
    const uint64_t seed_word = aur_golden_start(s);
    const aur_golden_order order = aur_golden_order_of(seed_word, count);
    aur_ascent ascent = {.start = seed_word,
                         .count = count,
                         .step = order.increment,
                         .modulus = order.increment + order.decrement,
                         .index = order.first};
    aur_run ascending, sequence;
    aur_run_of_ascent(&ascent, &ascending);
    aur_run_of_fraction(seed_word, aur_golden_fraction, 0, &sequence);
    if (output->doubles != NULL && strides.point == 2) {
        aur_run_pairs(&sequence, &ascending, count, output->doubles);
        return AUR_OK;
    }
    size_t part;
    for (size_t done = 0; done < count; done += part) {
        double values[PART_LENGTH];
        part = count - done < PART_LENGTH ? count - done : PART_LENGTH;
        ascending.next(&ascending, part, values);
        put_part(output, strides, 1, done, part, values);
        sequence.next(&sequence, part, values);
        put_part(output, strides, 0, done, part, values);
    }
    return AUR_OK;
}

const aur_square_set aur_set_golden_set = {
    .description = {.row = {.name = "golden-set",
                            .summary =
                                "golden ratio sequence paired with its sorted copy; form=one-seed|two-seeds",
                            .source = "Schretter 2012",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = UINT64_C(1) << 32},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = fill,
};
