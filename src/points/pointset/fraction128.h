/* Multiples i a modulo 1 of irrational numbers a, exact to a double: a is stored as a fraction of 128 bits.
 */
#pragma once

#include <stdint.h>

/* high / 2^64 + low / 2^128 */
typedef struct aur_fraction128 {
    uint64_t high, low;
} aur_fraction128;

/* 1/Phi = (sqrt 5 - 1)/2, the golden ratio minus 1, truncated to 128 bits: the only copy in this project.
 * Code with 64 bits uses AUR_GOLDEN_PHASE of points/sphere/phase.h, which is derived from it. */
#define AUR_GOLDEN_HIGH UINT64_C(0x9e3779b97f4a7c15)
#define AUR_GOLDEN_LOW UINT64_C(0xf39cc0605cedc834)
static const aur_fraction128 aur_golden_fraction = {AUR_GOLDEN_HIGH, AUR_GOLDEN_LOW};

__extension__ typedef unsigned __int128 aur_wide;

/* index * fraction modulo 1 in units of 2^-128: exact, and so are sums and differences of such phases. */
static inline aur_wide aur_phase128(aur_fraction128 fraction, uint64_t index) {
    return ((aur_wide)fraction.high << 64 | fraction.low) * index;
}

/* The upper half of a product; by halves if the compiler has no 128-bit integers. */
static inline uint64_t aur_multiply_high(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
    __extension__ typedef unsigned __int128 wide;
    return (uint64_t)((wide)a * b >> 64);
#else
    const uint64_t half = 0xffffffffu;
    const uint64_t low = (a & half) * (b & half), cross = (a >> 32) * (b & half) + (low >> 32);
    const uint64_t other = (a & half) * (b >> 32) + (cross & half);
    return (a >> 32) * (b >> 32) + (cross >> 32) + (other >> 32);
#endif
}

/* floor(index fraction 2^64) modulo 2^64, as a 64-bit word. */
static inline uint64_t aur_phase(aur_fraction128 fraction, uint64_t index) {
    return fraction.high * index + aur_multiply_high(fraction.low, index);
}
