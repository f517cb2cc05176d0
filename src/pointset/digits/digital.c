#include "pointset/digits/digital.h"

#include <stdlib.h>

#include "core/simd.h"
#include "pointset/digits/digital_body.h"

enum {
    SHORT_RUN = 16, /* shorter ones are computed one index at a time */
    WIDE_RUN = 96,  /* shorter ones are not worth preparing wide registers for */
    BUFFER_LENGTH = 512,
    STREAM_BYTES = 4 << 20 /* larger outputs go past the caches */
};

size_t aur_digital_run_portable(const aur_digital_run *run) {
    return run_kernel(run);
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
    aur_digital_flips(AUR_SCRAMBLE_NONE, columns, 0, flips);
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
    const size_t point_bytes = run->dimension_count * sizeof *run->out;
    const size_t beyond = (uintptr_t)run->out % 64;
    const size_t before = beyond == 0 ? 0 : (64 - beyond) / point_bytes;
    if (run->count < WIDE_RUN || beyond % point_bytes != 0) {
        fill_plainly_part(run, 0, run->count);
        return;
    }
    fill_plainly_part(run, 0, before);
    aur_digital_run wide = *run;
    wide.first += before;
    wide.count -= before;
    wide.out += before * run->dimension_count;
    wide.stream = wide.count * point_bytes > STREAM_BYTES;
    const aur_digital_kernel kernel = AUR_KERNEL_HERE(aur_digital_run);
    const size_t done = before + kernel(&wide);
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
    /* The run is made without gaps in a buffer and then spread. */
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
