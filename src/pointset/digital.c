#include "pointset/digital.h"

#include <stdlib.h>
#include <string.h>

#include "core/simd.h"
#include "pointset/digital_kernels.h"
#include "pointset/radical_inverse.h"

enum {
    SHORT_RUN = 16, /* shorter ones are computed one index at a time */
    WIDE_RUN = 96,  /* shorter ones are not worth preparing wide registers for */
    BUFFER_LENGTH = 512,
    STREAM_BYTES = 4 << 20 /* larger outputs go past the caches */
};

/* OWEN's form of a word, see digital_kernels.h; exclusive sums of forms are forms of exclusive sums. */
static uint64_t form_of(aur_scramble scramble, uint64_t word) {
    if (scramble != AUR_SCRAMBLE_OWEN)
        return word;
    return (uint64_t)(uint32_t)word << 32 | aur_reverse_bits((uint32_t)(word >> 32));
}

/* From one index to the next the lowest bits flip, as many as there are trailing ones and one more; the same
 * holds for the numbers of groups of 2^bits. */
static void make_flips(aur_scramble scramble, const uint64_t columns[AUR_DIGITAL_COLUMNS], unsigned bits,
                       uint64_t flips[AUR_DIGITAL_COLUMNS]) {
    uint64_t sum = 0;
    for (unsigned k = bits; k < AUR_DIGITAL_COLUMNS; ++k) {
        sum ^= columns[k];
        flips[k - bits] = form_of(scramble, sum);
    }
}

void aur_digital_group_prepare(const aur_digital_run *run, size_t dimension, unsigned bits,
                               const unsigned char *order, aur_digital_group *group) {
    const uint64_t *const columns = run->columns[dimension];
    const uint64_t size = UINT64_C(1) << bits;
    const uint64_t xor_key = run->scramble == AUR_SCRAMBLE_DIGIT ? run->keys[dimension] : 0;
    for (size_t l = 0; l < size; ++l) {
        const uint64_t index = (run->first + order[l]) % size;
        group->lanes[l] = form_of(run->scramble, aur_digital_word(columns, index) ^ xor_key);
    }
    make_flips(run->scramble, columns, bits, group->flips);
    group->word = form_of(run->scramble, aur_digital_word(columns, run->first / size * size));
}

/* A run of one dimension with any stride. */
static void fill_plainly(const aur_digital_run *run, size_t dimension, size_t stride, double *out) {
    const uint64_t *const columns = run->columns[dimension];
    const uint64_t key = run->keys[dimension];
    if (run->count < SHORT_RUN) {
        for (size_t i = 0; i < run->count; ++i)
            out[i * stride] = aur_word_to_double(
                aur_scramble_word(run->scramble, aur_digital_word(columns, run->first + i), key));
        return;
    }
    uint64_t flips[AUR_DIGITAL_COLUMNS];
    make_flips(AUR_SCRAMBLE_NONE, columns, 0, flips);
    uint64_t word = aur_digital_word(columns, run->first);
    for (size_t i = 0; i < run->count; ++i) {
        out[i * stride] = aur_word_to_double(aur_scramble_word(run->scramble, word, key));
        word ^= flips[__builtin_ctzll(run->first + i + 1)];
    }
}

static void fill_plainly_part(const aur_digital_run *run, size_t begin, size_t count) {
    aur_digital_run part = *run;
    part.first += begin;
    part.count = count;
    for (size_t d = 0; d < run->dimension_count; ++d)
        fill_plainly(&part, d, run->dimension_count, run->out + begin * run->dimension_count + d);
}

/* One dimension, or two beside each other, without gaps. */
static void fill_run(const aur_digital_run *run) {
    const aur_isa isa = run->count < WIDE_RUN ? AUR_ISA_PORTABLE : aur_isa_available();
    const size_t point_bytes = run->dimension_count * sizeof *run->out;
    const size_t beyond = (uintptr_t)run->out % 64;
    const size_t before = beyond == 0 ? 0 : (64 - beyond) / point_bytes;
    if (isa == AUR_ISA_PORTABLE || beyond % point_bytes != 0) {
        fill_plainly_part(run, 0, run->count);
        return;
    }
    fill_plainly_part(run, 0, before);
    aur_digital_run wide = *run;
    wide.first += before;
    wide.count -= before;
    wide.out += before * run->dimension_count;
    wide.stream = wide.count * point_bytes > STREAM_BYTES;
    const size_t done =
        before + (isa == AUR_ISA_AVX512 ? aur_digital_run_avx512(&wide) : aur_digital_run_avx2(&wide));
    fill_plainly_part(run, done, run->count - done);
}

static aur_digital_run run_of(const aur_pointset *set, const aur_block *block) {
    return (aur_digital_run){
        .dimension_count = 1, .scramble = set->scramble, .first = block->first, .count = block->count};
}

void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d) {
    double *const out = block->data + d * block->coordinate_stride;
    aur_digital_run run = run_of(set, block);
    run.columns[0] = columns;
    run.keys[0] = aur_scramble_key(block->seed, block->first_dimension + d);
    run.out = out;
    if (block->point_stride == 1) {
        fill_run(&run);
        return;
    }
    if (block->count < WIDE_RUN) {
        fill_plainly(&run, 0, block->point_stride, out);
        return;
    }
    /* Make it without gaps, then spread it. */
    _Alignas(64) double buffer[BUFFER_LENGTH];
    run.out = buffer;
    for (size_t begin = 0; begin < block->count; begin += run.count) {
        run.first = block->first + begin;
        run.count = block->count - begin < BUFFER_LENGTH ? block->count - begin : BUFFER_LENGTH;
        fill_run(&run);
        for (size_t i = 0; i < run.count; ++i)
            out[(begin + i) * block->point_stride] = buffer[i];
    }
}

/* Two coordinates that lie beside each other. */
static void fill_pair(const aur_pointset *set, const uint64_t *const columns[2], const aur_block *block) {
    aur_digital_run run = run_of(set, block);
    run.dimension_count = 2;
    for (size_t d = 0; d < 2; ++d) {
        run.columns[d] = columns[d];
        run.keys[d] = aur_scramble_key(block->seed, block->first_dimension + d);
    }
    run.out = block->data;
    fill_run(&run);
}

aur_result aur_prepare_digital(aur_pointset *set, size_t count, aur_digital_matrix make,
                               const aur_pointset_options *options, aur_error *error) {
    uint64_t(*const matrices)[AUR_DIGITAL_COLUMNS] = malloc(count * sizeof *matrices);
    if (matrices == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t d = 0; d < count; ++d)
        make(d, matrices[d]);
    set->data = matrices;
    aur_warn_incomplete_net(set, options, 2);
    return AUR_OK;
}

const uint64_t *aur_digital_matrix_of(const aur_pointset *set, size_t dimension, aur_digital_matrix make,
                                      uint64_t columns[AUR_DIGITAL_COLUMNS]) {
    const uint64_t(*const matrices)[AUR_DIGITAL_COLUMNS] = set->data;
    if (matrices != NULL)
        return matrices[dimension];
    make(dimension, columns);
    return columns;
}

void aur_fill_digital_block(const aur_pointset *set, const aur_block *block, aur_digital_matrix make) {
    uint64_t columns[2][AUR_DIGITAL_COLUMNS];
    const size_t first = block->first_dimension;
    if (block->dimension_count == 2 && block->point_stride == 2 && block->coordinate_stride == 1 &&
        block->count >= WIDE_RUN) {
        fill_pair(set,
                  (const uint64_t *const[]){aur_digital_matrix_of(set, first, make, columns[0]),
                                            aur_digital_matrix_of(set, first + 1, make, columns[1])},
                  block);
        return;
    }
    for (size_t d = 0; d < block->dimension_count; ++d)
        aur_fill_digital(set, aur_digital_matrix_of(set, first + d, make, columns[0]), block, d);
}

aur_digital_rule *aur_digital_rule_create(uint32_t base, size_t row_count, size_t column_count,
                                          size_t dimension) {
    const size_t per_matrix = row_count * column_count;
    if (dimension > (SIZE_MAX - sizeof(aur_digital_rule)) / sizeof(uint16_t) / per_matrix)
        return NULL;
    aur_digital_rule *const rule = malloc(sizeof *rule + dimension * per_matrix * sizeof rule->digits[0]);
    if (rule == NULL)
        return NULL;
    rule->base = base;
    rule->row_count = row_count;
    rule->column_count = column_count;
    return rule;
}

/* One coordinate of one point. The row sums stay below 64 2^32. */
static double coordinate(const aur_digital_rule *rule, const uint16_t *matrix, uint64_t index,
                         aur_digits digits, uint64_t key) {
    uint64_t rows[AUR_DIGITAL_COLUMNS] = {0};
    const uint16_t *column = matrix;
    for (; index > 0; index /= rule->base, column += rule->row_count) {
        const uint64_t digit = index % rule->base;
        for (size_t r = 0; digit != 0 && r < rule->row_count; ++r)
            rows[r] += digit * column[r];
    }
    aur_digit_sum sum = aur_digit_sum_begin(rule->base, digits, key);
    for (size_t r = 0; aur_digit_sum_has_room(&sum); ++r) {
        if (r >= rule->row_count && digits == AUR_DIGITS_PLAIN)
            break;
        aur_digit_sum_put(&sum, r < rule->row_count ? (uint32_t)(rows[r] % rule->base) : 0);
    }
    return aur_digit_sum_value(&sum);
}

/* Where a run of points is: the digits of a coordinate, before any scrambling, kept from index to index.
 * Adding a column as often as the base says is adding nothing, so a digit that goes back to 0 needs no care:
 * the next one adds its column. */
typedef struct digit_rows {
    uint32_t rows[AUR_DIGITAL_COLUMNS];   /* digits, the coarse one first */
    uint64_t powers[AUR_DIGITAL_COLUMNS]; /* what a digit counts */
    uint64_t numerator, denominator;
} digit_rows;

static digit_rows rows_at(const aur_digital_rule *rule, const uint16_t *matrix, uint64_t index) {
    digit_rows r = {.denominator = 1};
    const uint16_t *column = matrix;
    for (; index > 0; index /= rule->base, column += rule->row_count)
        for (size_t k = 0; k < rule->row_count; ++k)
            r.rows[k] = (uint32_t)((r.rows[k] + index % rule->base * column[k]) % rule->base);
    for (size_t k = rule->row_count; k-- > 0; r.denominator *= rule->base) {
        r.powers[k] = r.denominator;
        r.numerator += r.rows[k] * r.denominator;
    }
    return r;
}

/* Adds a column whose rows from `count` on are 0. */
static inline void add_column(digit_rows *r, uint32_t base, size_t count, const uint16_t *column) {
    uint64_t numerator = r->numerator;
    for (size_t k = 0; k < count; ++k) {
        const uint32_t sum = r->rows[k] + column[k];
        const uint32_t digit = sum < base ? sum : sum - base;
        numerator += ((uint64_t)digit - r->rows[k]) * r->powers[k];
        r->rows[k] = digit;
    }
    r->numerator = numerator;
}

/* Counts through a run: the same fractions as random access. False when the points have more digits than fit.
 */
static bool fill_by_counting(const aur_digital_rule *rule, const uint16_t *matrix, const aur_block *block,
                             double *out) {
    const uint32_t base = rule->base;
    const size_t rows = rule->row_count;
    if (rows > AUR_DIGITAL_COLUMNS)
        return false;
    digit_rows r = rows_at(rule, matrix, block->first);
    size_t used = rows; /* of the first column: 1 where the matrix is upper triangular */
    while (used > 0 && matrix[used - 1] == 0)
        --used;
    uint32_t lowest = (uint32_t)(block->first % base);
    uint64_t above = block->first / base;
    for (size_t i = 0; i < block->count; ++i) {
        out[i * block->point_stride] = aur_fraction(r.numerator, r.denominator);
        add_column(&r, base, used, matrix);
        if (++lowest < base)
            continue;
        lowest = 0;
        uint64_t digits = above++;
        const uint16_t *column = matrix + rows;
        for (; digits % base == base - 1; digits /= base, column += rows)
            add_column(&r, base, rows, column);
        if (i + 1 < block->count)
            add_column(&r, base, rows, column);
    }
    return true;
}

void aur_fill_digital_rule(const aur_pointset *set, const aur_block *block) {
    const aur_digital_rule *const rule = set->data;
    const aur_digits digits = aur_digits_of(set->scramble);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint16_t *const matrix = rule->digits + dimension * rule->row_count * rule->column_count;
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        double *const out = block->data + d * block->coordinate_stride;
        if (digits == AUR_DIGITS_PLAIN && block->count >= SHORT_RUN &&
            fill_by_counting(rule, matrix, block, out))
            continue;
        for (size_t i = 0; i < block->count; ++i)
            out[i * block->point_stride] = coordinate(rule, matrix, block->first + i, digits, key);
    }
}
