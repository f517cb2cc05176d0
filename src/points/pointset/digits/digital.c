#include "points/pointset/digits/digital.h"

#include <stdlib.h>

#include "points/base/simd.h"
#include "points/pointset/digits/digital_kernels.h"

enum {
    SHORT_RUN = 16, /* shorter runs are computed one index at a time */
    WIDE_RUN = 48   /* shorter runs do not use the vector kernels */
};

/* The first `count` points of coordinate `d` of a run. */
static void fill_plainly(const aur_digital_run *run, size_t d, size_t count, double *out) {
    const uint64_t *const columns = run->columns[d];
    const uint64_t key = run->keys[d];
    const size_t stride = run->dimension_count;
    if (count < SHORT_RUN) {
        for (size_t i = 0; i < count; ++i)
            out[i * stride + d] = aur_word_to_double(
                aur_scramble_word(run->scramble, aur_digital_word(columns, run->first + i), key));
        return;
    }
    uint64_t flips[AUR_DIGITAL_COLUMNS];
    uint64_t sum = 0;
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        flips[k] = sum ^= columns[k];
    uint64_t word = aur_digital_word(columns, run->first);
    for (size_t i = 0; i < count; ++i) {
        out[i * stride + d] = aur_word_to_double(aur_scramble_word(run->scramble, word, key));
        word ^= flips[__builtin_ctzll(run->first + i + 1)];
    }
}

static void fill_run(aur_digital_run *run, double *out) {
    if (run->scramble == AUR_SCRAMBLE_NESTED) { /* the kernels support the others */
        for (size_t d = 0; d < run->dimension_count; ++d)
            fill_plainly(run, d, (size_t)(run->last - run->first), out);
        return;
    }
    aur_digital_kernel *const kernel = AUR_KERNEL_HERE(aur_digital_run);
    const size_t count = (size_t)(run->last - run->first);
    const size_t start = run->dimension_count == 2 ? aur_output_stream_start(count, out) : SIZE_MAX;
    if (start == SIZE_MAX && count >= WIDE_RUN) {
        kernel(run, count, false, out);
        return;
    }
    const size_t before = start < count ? start : count;
    for (size_t d = 0; d < run->dimension_count; ++d)
        fill_plainly(run, d, before, out);
    if (before == count)
        return;
    run->first += before;
    kernel(run, count - before, true, out + 2 * before);
}

static aur_digital_run run_of(const aur_pointset *set, const aur_block *block) {
    return (aur_digital_run){.dimension_count = 1,
                             .scramble = set->scramble,
                             .first = block->first,
                             .last = block->first + block->count};
}

void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d) {
    aur_digital_run run = run_of(set, block);
    run.columns[0] = columns;
    run.keys[0] = aur_scramble_key(block->seed, block->first_dimension + d);
    fill_run(&run, block->data + d * block->coordinate_stride);
}

aur_result aur_prepare_digital(aur_pointset *set, size_t count, aur_digital_matrix make, aur_error *error) {
    uint64_t(*const matrices)[AUR_DIGITAL_COLUMNS] = malloc(count * sizeof *matrices);
    if (matrices == NULL)
        return aur_fail_memory(error);
    for (size_t d = 0; d < count; ++d)
        make(d, matrices[d]);
    set->data = matrices;
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
    for (size_t d = 0; d < block->dimension_count; ++d) {
        uint64_t columns[AUR_DIGITAL_COLUMNS];
        aur_fill_digital(set, aur_digital_matrix_of(set, block->first_dimension + d, make, columns), block,
                         d);
    }
}

bool aur_fill_digital_pairs(const aur_pointset *set, const aur_block *block, aur_digital_matrix make) {
    uint64_t columns[2][AUR_DIGITAL_COLUMNS];
    aur_digital_run run = run_of(set, block);
    run.dimension_count = 2;
    for (size_t d = 0; d < 2; ++d) {
        const size_t dimension = block->first_dimension + d;
        run.columns[d] = aur_digital_matrix_of(set, dimension, make, columns[d]);
        run.keys[d] = aur_scramble_key(block->seed, dimension);
    }
    fill_run(&run, block->data);
    return true;
}
