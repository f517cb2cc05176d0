#include "pointset/digits/digital.h"

#include <stdlib.h>

#include "core/simd.h"
#include "pointset/digits/digital_body.h"

enum {
    SHORT_RUN = 16,        /* shorter ones are computed one index at a time */
    WIDE_RUN = 48,         /* shorter ones are not worth preparing wide registers for */
    STREAM_BYTES = 4 << 20 /* larger outputs go past the caches */
};

void aur_digital_run_portable(const aur_digital_run *run) {
    run_kernel(run);
}

/* One coordinate of a run. */
static void fill_plainly(const aur_digital_run *run, size_t d) {
    const uint64_t *const columns = run->columns[d];
    const uint64_t key = run->keys[d];
    const size_t stride = run->dimension_count;
    double *const out = run->out + d;
    if (run->count < SHORT_RUN) {
        for (size_t i = 0; i < run->count; ++i)
            out[i * stride] = aur_word_to_double(
                aur_scramble_word(run->scramble, aur_digital_word(columns, run->first + i), key));
        return;
    }
    uint64_t flips[AUR_DIGITAL_COLUMNS];
    uint64_t sum = 0;
    for (unsigned k = 0; k < AUR_DIGITAL_COLUMNS; ++k)
        flips[k] = sum ^= columns[k];
    uint64_t word = aur_digital_word(columns, run->first);
    for (size_t i = 0; i < run->count; ++i) {
        out[i * stride] = aur_word_to_double(aur_scramble_word(run->scramble, word, key));
        word ^= flips[__builtin_ctzll(run->first + i + 1)];
    }
}

static void fill_run(const aur_digital_run *run) {
    const aur_digital_kernel kernel = AUR_KERNEL_HERE(aur_digital_run);
    const size_t point_bytes = run->dimension_count * sizeof *run->out;
    const size_t beyond = (uintptr_t)run->out % 64;
    aur_digital_run part = *run;
    part.stream = run->count * point_bytes > STREAM_BYTES && beyond % point_bytes == 0;
    if (part.stream) {
        part.count = beyond == 0 ? 0 : (64 - beyond) / point_bytes;
    } else if (run->count >= WIDE_RUN) {
        kernel(&part);
        return;
    }
    for (size_t d = 0; d < run->dimension_count; ++d)
        fill_plainly(&part, d);
    if (!part.stream)
        return;
    part.first += part.count;
    part.out += part.count * run->dimension_count;
    part.count = run->count - part.count;
    kernel(&part);
}

static aur_digital_run run_of(const aur_pointset *set, const aur_block *block) {
    return (aur_digital_run){.dimension_count = 1,
                             .scramble = set->scramble,
                             .first = block->first,
                             .count = block->count,
                             .out = block->data};
}

void aur_fill_digital(const aur_pointset *set, const uint64_t columns[AUR_DIGITAL_COLUMNS],
                      const aur_block *block, size_t d) {
    aur_digital_run run = run_of(set, block);
    run.columns[0] = columns;
    run.keys[0] = aur_scramble_key(block->seed, block->first_dimension + d);
    run.out += d * block->coordinate_stride;
    fill_run(&run);
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

void aur_fill_digital_pairs(const aur_pointset *set, const aur_block *block, aur_digital_matrix make) {
    uint64_t columns[2][AUR_DIGITAL_COLUMNS];
    aur_digital_run run = run_of(set, block);
    run.dimension_count = 2;
    for (size_t d = 0; d < 2; ++d) {
        const size_t dimension = block->first_dimension + d;
        run.columns[d] = aur_digital_matrix_of(set, dimension, make, columns[d]);
        run.keys[d] = aur_scramble_key(block->seed, dimension);
    }
    fill_run(&run);
}
