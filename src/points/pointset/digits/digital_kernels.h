/* Runs of digital points in base 2 by wide registers. Every form writes the same bits as aur_fill_digital's
 * plain loop: words are exclusive sums, and their conversion is exact. */
#pragma once

#include "points/base/simd.h"
#include "points/pointset/digits/digital.h"

enum { AUR_DIGITAL_SLOTS = 64 }; /* coordinates of the largest group */

/* What a group of points needs of the matrices. A slot is a coordinate of a point, in the order of the
 * output. Slot s has the word lanes[s], changed by `words`, which follow the groups of the sequence, and
 * where `wrapped` is set by the flips to the next group, too: a group of the run begins in the middle of one
 * of the sequence. From group n - 1 to group n words change by flips[trailing
 * zeros of n]: the lowest bits of the number flip, as many as there are trailing zeros and one more.
 *
 * Words and flips are pairs, of the two coordinates or twice of the one. For OWEN they are in the form that
 * hashing wants: first the reversed upper 32 digits of both, then the lower ones of both. */
typedef struct aur_digital_group {
    uint64_t lanes[AUR_DIGITAL_SLOTS];
    uint64_t wrapped[AUR_DIGITAL_SLOTS]; /* all bits or none */
    uint64_t flips[AUR_DIGITAL_COLUMNS][2];
    uint64_t words[2];
    uint64_t next; /* the number of the group after that where the run is now */
    bool tails;    /* some word has digits beyond the 32nd */
} aur_digital_group;

/* Points of one coordinate, or of two beside each other. */
typedef struct aur_digital_run {
    size_t dimension_count; /* 1: out[i]; 2: out[2 i + d] */
    const uint64_t *columns[2];
    uint64_t keys[2];
    aur_scramble scramble; /* DIGIT and OWEN are applied */
    uint64_t first, last;  /* the points of the whole run */
    bool started;
    aur_digital_group group; /* the kernel's own */
} aur_digital_run;

/* The next `count` points: a multiple of AUR_DIGITAL_SLOTS where there are more to come. `stream` goes past
 * the caches: `out` is a multiple of 64 bytes. */
typedef void aur_digital_kernel(aur_digital_run *run, size_t count, bool stream, double *out);
AUR_KERNELS(aur_digital_kernel, aur_digital_run);

/* Makes run->group ready. `slots` is a power of two and more than two. */
void aur_digital_run_start(aur_digital_run *run, size_t slots);
