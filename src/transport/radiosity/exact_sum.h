/* Sums that do not depend on the order of their terms: non-negative terms in fixed point, added in 128 bits.
 */
#pragma once

#include <stdint.h>

typedef struct aur_exact_sum {
    uint64_t low, high;
} aur_exact_sum;

static inline void aur_exact_add(aur_exact_sum *sum, uint64_t term) {
    sum->low += term;
    sum->high += sum->low < term;
}

static inline void aur_exact_merge(aur_exact_sum *sum, const aur_exact_sum *other) {
    aur_exact_add(sum, other->low);
    sum->high += other->high;
}

static inline double aur_exact_value(const aur_exact_sum *sum) {
    return (double)sum->high * 0x1p64 + (double)sum->low;
}
