/* The two-dimensional Sobol net and nested uniform scrambling on 32-bit words, a few instructions each and
 * without a table: for the inner loops of rendering, and as the scalar reference for tests of vector code. A
 * word x is the coordinate x / 2^32. */
#pragma once

#include <stdint.h>

static inline uint32_t aur_reverse_bits(uint32_t x) {
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__CUDA__)
    x = __builtin_bswap32(x);
#else
    x = x >> 24 | (x >> 8 & 0xff00u) | (x & 0xff00u) << 8 | x << 24;
#endif
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

/* Sobol's first dimension: the radical inverse in base 2 (van der Corput). */
static inline uint32_t aur_sobol_first(uint32_t index) {
    return aur_reverse_bits(index);
}

/* Sobol's second dimension: its generator matrix is Pascal's triangle modulo 2. By Lucas' theorem the entry
 * (i, j) is 1 exactly when the bits of i are among those of j, so the product is a superset sum over the five
 * bits of a bit's position: five masked steps in place of up to 32 rows. The result's bits are reversed. */
static inline uint32_t aur_sobol_second_reversed(uint32_t index) {
    uint32_t x = index;
    x ^= x >> 1 & 0x55555555u;
    x ^= x >> 2 & 0x33333333u;
    x ^= x >> 4 & 0x0f0f0f0fu;
    x ^= x >> 8 & 0x00ff00ffu;
    return x ^ x >> 16;
}

static inline uint32_t aur_sobol_second(uint32_t index) {
    return aur_reverse_bits(aur_sobol_second_reversed(index));
}

/* A permutation of words in which a bit depends on the lower bits only (Laine and Karras 2011, with constants
 * selected by the criteria of Burley 2020). */
static inline uint32_t aur_nested_hash(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Nested uniform (Owen) scrambling by hashing: every bit is flipped by a hash of the bits above it. */
static inline uint32_t aur_owen_scramble(uint32_t x, uint32_t seed) {
    return aur_reverse_bits(aur_nested_hash(aur_reverse_bits(x), seed));
}
