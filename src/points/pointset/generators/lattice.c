/* Rank-1 lattices. rank1: coordinate d of point i is i g_d / N modulo 1, in exact integer arithmetic, for any
 * generating vector g; N up to 2^48. fibonacci-lattice (Schretter 2012, eq. 3; Marques 2013, sec. 3.1): N =
 * F_k and g = (1, F_{k-1}); for any other N, the limit ((i + offset) / N, i / Phi). Random access. Error
 * O(log N / N) for a good vector, and far better for periodic smooth functions. */
#include "points/pointset/generators/golden.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "points/pointset/generators/lattice.h"

/* False for coordinates with an offset, which are not fractions of integers. */
static bool make_run(const aur_pointset *set, size_t dimension, uint64_t first, aur_run *run) {
    const aur_lattice *const data = set->data;
    if (dimension == 0 && data->offset > 0.0)
        return false;
    if (data->golden && dimension == 1) {
        aur_run_of_fraction(0, aur_golden_fraction, first, run);
        return true;
    }
    aur_run_of_lattice(data->vector[dimension], first, set->size, run);
    return true;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const aur_lattice *const data = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        double *const out = block->data + d * block->coordinate_stride;
        aur_run run;
        if (make_run(set, block->first_dimension + d, block->first, &run)) {
            run.next(&run, block->count, out);
            continue;
        }
        for (size_t i = 0; i < block->count; ++i) {
            const double x = ((double)(int64_t)(block->first + i) + data->offset) / (double)set->size;
            out[i] = x < 1.0 ? x : AUR_BELOW_ONE;
        }
    }
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    aur_run x, y;
    if (!make_run(set, 0, block->first, &x) || !make_run(set, 1, block->first, &y))
        return false;
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
}

/* "1/a/b" */
static size_t parse_vector(const char *text, uint64_t vector[AUR_LATTICE_CAPACITY]) {
    size_t count = 0;
    while (count < AUR_LATTICE_CAPACITY && isdigit((unsigned char)*text)) {
        char *end;
        const unsigned long long value = strtoull(text, &end, 10);
        if (value >= AUR_INDEX_LIMIT)
            return 0;
        vector[count++] = value;
        if (*end == '\0')
            return count;
        if (*end != '/')
            return 0;
        text = end + 1;
    }
    return 0;
}

/* The number nearest to N / Phi that has no factor in common with N: a Fibonacci number for Fibonacci N. */
static uint64_t golden_generator(uint64_t n) {
    const uint64_t middle = (uint64_t)((double)n * 0.61803398874989484820 + 0.5);
    for (uint64_t distance = 0; distance < n; ++distance) {
        if (aur_common_divisor(middle + distance, n) == 1)
            return (middle + distance) % n;
        if (distance <= middle && aur_common_divisor(middle - distance, n) == 1)
            return middle - distance;
    }
    return 1;
}

static aur_lattice *create(aur_pointset *set, aur_error *error) {
    aur_lattice *const data = calloc(1, sizeof *data);
    if (data == NULL)
        aur_fail_memory(error);
    set->data = data;
    return data;
}

typedef struct lattice_keys {
    const char *vector;
    double offset;
} lattice_keys;

static const aur_key rank1_keys[] = {
    {AUR_KEY_OF_TEXT(lattice_keys, "vector", vector, "auto",
                     "generating vector 1/a/b, a number a dimension; auto: 1/a with a next to N/Phi")},
};

static const aur_key fibonacci_keys[] = {
    {AUR_KEY_OF_REAL(lattice_keys, "offset", offset, 0.0, 1.0, "0", "added to i in the first coordinate i/N"),
     .maximum_open = true},
};

static aur_result prepare_rank1(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    aur_lattice *const data = create(set, error);
    if (data == NULL)
        return AUR_ERROR_MEMORY;
    lattice_keys p = {0};
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    const char *const text = strcmp(p.vector, "auto") != 0 ? p.vector : NULL;
    size_t count = 2;
    if (text == NULL) {
        data->vector[0] = 1;
        data->vector[1] = golden_generator(set->size);
    } else {
        count = parse_vector(text, data->vector);
        if (count == 0)
            return aur_fail(
                error, AUR_ERROR_FORMAT,
                "set 'rank1': vector must be up to %d whole numbers below 2^48 with / between them, "
                "such as 1/55/21, not '%s'",
                AUR_LATTICE_CAPACITY, text);
    }
    if (set->options->dimension == 0)
        set->dimension = count;
    if (set->dimension != count)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'rank1': a vector of %zu numbers has no %zu dimensions%s", count, set->dimension,
                        text == NULL ? "; give vector=1/a/b" : "");
    return AUR_OK;
}

static void lattice_make_fibonacci(uint64_t size, double offset, aur_lattice *lattice) {
    uint64_t before = 1;
    uint64_t number = 1;
    while (number < size && number <= AUR_INDEX_LIMIT) {
        const uint64_t next = before + number;
        before = number;
        number = next;
    }
    lattice->offset = offset;
    lattice->vector[0] = 1;
    lattice->vector[1] = before;
    lattice->golden = number != size;
}

static aur_result prepare_fibonacci(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    aur_lattice *const data = create(set, error);
    if (data == NULL)
        return AUR_ERROR_MEMORY;
    lattice_keys p;
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    lattice_make_fibonacci(set->size, p.offset, data);
    if (data->golden)
        aur_warn_at(&set->options->warnings, (aur_location){0},
                    "set 'fibonacci-lattice': the number of points is not a Fibonacci number, so the points "
                    "are not a "
                    "lattice; the golden ratio replaces its ratios");
    return AUR_OK;
}

const aur_square_set aur_set_rank1 = {
    .description = {.row = {.name = "rank1",
                            .summary =
                                "rank-1 lattice of a generating vector 1/a/b; auto: 1/a with a next to N/Phi",
                            .source = "Korobov 1959; Sloan, Joe 1994",
                            AUR_ROW_KEYS(rank1_keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, AUR_LATTICE_CAPACITY},
                    .maximum_size = AUR_INDEX_LIMIT},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare_rank1,
    .fill = fill,
    .fill_pairs = fill_pairs,
};

const aur_square_set aur_set_fibonacci_lattice = {
    .description = {.row = {.name = "fibonacci-lattice",
                            .summary = "rank-1 lattice of two Fibonacci numbers; i/Phi at other sizes",
                            .source = "Zaremba 1966; Niederreiter, Sloan 1994",
                            AUR_ROW_KEYS(fibonacci_keys)},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .best_sizes = AUR_SIZES_FIBONACCI},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare_fibonacci,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
