/* Runs of digital points in base 2 by wide registers. Every form writes the same bits as aur_fill_digital's
 * plain loop: words are exclusive sums, and their conversion is exact. */
#pragma once

#include "pointset/digits/digital.h"

/* Points first .. first + count - 1 of one coordinate, or of two beside each other. */
typedef struct aur_digital_run {
    size_t dimension_count; /* 1: out[i]; 2: out[2 i + d] */
    const uint64_t *columns[2];
    uint64_t keys[2];
    aur_scramble scramble; /* DIGIT and OWEN are applied */
    uint64_t first;
    size_t count;
    double *out; /* on a multiple of 64 bytes */
    bool stream; /* go past the caches */
} aur_digital_run;

/* Each does whole groups of points, as many as fit, and returns how many it did. */
typedef size_t (*aur_digital_kernel)(const aur_digital_run *run);
size_t aur_digital_run_portable(const aur_digital_run *run);
size_t aur_digital_run_avx2(const aur_digital_run *run);
size_t aur_digital_run_avx512(const aur_digital_run *run);

enum { AUR_DIGITAL_GROUP = 16 }; /* the largest group */

/* What a group of 2^bits points needs of a matrix. Point first + l of the sequence, l < 2^bits, has the word
 * lanes[l] ^ (word of 2^bits q or of 2^bits (q + 1)), q the group in which the run begins. */
typedef struct aur_digital_group {
    uint64_t lanes[AUR_DIGITAL_GROUP];
    uint64_t flips[AUR_DIGITAL_COLUMNS]; /* from group q to q + 1: flips[trailing zeros of q + 1] */
    uint64_t word;                       /* of the first index of group q */
} aur_digital_group;

/* flips[z] is what a word changes by from group q to group q + 1 of 2^bits points, z the number of trailing
 * zeros of q + 1: the lowest bits of the number flip, as many as there are trailing ones and one more. */
void aur_digital_flips(aur_scramble scramble, const uint64_t columns[AUR_DIGITAL_COLUMNS], unsigned bits,
                       uint64_t flips[AUR_DIGITAL_COLUMNS]);

/* `order[l]` is the point (from 0) that lane l holds. For OWEN a word is in the form that hashing wants: its
 * upper 32 digits reversed in the lower half, its lower 32 digits in the upper half. */
void aur_digital_group_prepare(const aur_digital_run *run, size_t dimension, unsigned bits,
                               const unsigned char *order, aur_digital_group *group);
