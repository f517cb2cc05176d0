/* Golden ratio sequences and sets (Schretter 2012). */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/pointset/fraction128.h"
#include "points/pointset/words.h"

/* The fraction of a seed s in [0,1) as a word. */
static inline uint64_t aur_seed_word(double s) {
    return (uint64_t)(s * 0x1p53) << 11;
}

/* The word of G_s(1), where sequences begin. */
static inline uint64_t aur_golden_start(double s) {
    return aur_seed_word(s) + aur_phase(aur_golden_fraction, 1);
}

/* The step from the index of one value of G_s(0..count-1) to that of the next larger one: add `increment`
 * below `decrement`, else subtract `decrement`; an index beyond the set is skipped by another step (eq. 7).
 */
typedef struct aur_golden_order {
    uint64_t count, increment, decrement;
    uint64_t first; /* the index of the smallest value */
} aur_golden_order;

aur_golden_order aur_golden_order_of(uint64_t seed_word, uint64_t count);

static inline uint64_t aur_golden_next(const aur_golden_order *order, uint64_t index) {
    do
        index = index < order->decrement ? index + order->increment : index - order->decrement;
    while (index >= order->count);
    return index;
}

/* Additive recurrences: coordinate d of point i is start + i steps[d] modulo 1. */

typedef struct aur_recurrence {
    uint64_t start;          /* in units of 2^-64 */
    aur_fraction128 steps[]; /* one per dimension */
} aur_recurrence;

/* Rank-1 lattices and the golden-ratio limit of Fibonacci ones. */

enum { AUR_LATTICE_CAPACITY = 256 };

typedef struct aur_lattice {
    double offset; /* of the first coordinate, in steps */
    bool golden;   /* the second coordinate is i / Phi */
    uint64_t vector[AUR_LATTICE_CAPACITY];
} aur_lattice;
