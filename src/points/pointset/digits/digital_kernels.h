/* Vectorised runs of digital points in base 2. Every kernel is bit-identical to the plain loop of
 * aur_fill_digital: words are XOR sums, and their conversion is exact. */
#pragma once

#include "points/base/simd.h"
#include "points/pointset/digits/digital.h"

enum { AUR_DIGITAL_SLOTS = 64 }; /* coordinates of the largest group */

/* The state of a group of points. A slot is a coordinate of a point, in the order of the output. The word of
 * slot s is lanes[s] XOR `words`, which follow the groups of the sequence. Where `wrapped` is set, the flips
 * to the next group are added, since a group of the run begins in the middle of a group of the sequence. From
 * group n - 1 to group n words change by flips[z], where z is the number of trailing zeros of n: the lowest z
 * + 1 bits of the number flip.
 *
 * Words and flips are pairs, for the two coordinates or twice for one. For OWEN they are in the form of the
 * hash: first the reversed upper 32 digits of both, then the lower digits of both. */
typedef struct aur_digital_group {
    uint64_t lanes[AUR_DIGITAL_SLOTS];
    uint64_t wrapped[AUR_DIGITAL_SLOTS]; /* all bits or none */
    uint64_t flips[AUR_DIGITAL_COLUMNS][2];
    uint64_t words[2];
    uint64_t next; /* the number of the group after the current one */
    bool tails;    /* some word has digits beyond the 32nd */
} aur_digital_group;

/* Points of one coordinate, or of two interleaved ones. */
typedef struct aur_digital_run {
    size_t dimension_count; /* 1: out[i]; 2: out[2 i + d] */
    const uint64_t *columns[2];
    uint64_t keys[2];
    aur_scramble scramble; /* DIGIT and OWEN are applied */
    uint64_t first, last;  /* the points of the whole run */
    bool started;
    aur_digital_group group; /* private to the kernel */
} aur_digital_run;

/* Computes the next `count` points: a multiple of AUR_DIGITAL_SLOTS unless they are the last. `stream`
 * bypasses the caches: `out` is aligned to 64 bytes. */
typedef void aur_digital_kernel(aur_digital_run *run, size_t count, bool stream, double *out);
AUR_KERNELS(aur_digital_kernel, aur_digital_run);

/* Prepares run->group. `slots` is a power of two and more than two. */
void aur_digital_run_start(aur_digital_run *run, size_t slots);
