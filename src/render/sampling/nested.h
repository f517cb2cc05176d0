/* Patterns of neighbouring pixels that complete each other.
 *
 * A spherical Fibonacci set is a lattice in azimuth and height. Its shifts by halves of two basis vectors
 * make four sets, together the lattice that is twice as fine; shifts by quarters and eighths, sixteen and
 * sixty-four. So the pixels of each 2 x 2 block have all halves, those of 4 x 4 all quarters, those of 8 x 8
 * all eighths: the larger the block, the finer the pattern that its pixels make together, as Ahmed and Wonka
 * 2020 ask of sequences in the order of a Morton curve. Directions of one number stay within a cell of the
 * pattern, so packets of them stay coherent. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "points/base/random.h"

enum {
    AUR_NESTED_LEVELS = 3, /* 2 x 2, 4 x 4, 8 x 8 */
    AUR_NESTED_COUNT = 1 << 2 * AUR_NESTED_LEVELS
};

/* The number of the shift of the pixel at (x, y): two bits a level, those of the 2 x 2 block highest. Which
 * pixel has which is drawn anew for each block of 4 x 4, and which block of 4 x 4 has which eighths for each
 * of 8 x 8: else pixels 4 apart would have nearly the same pattern, and those 8 apart the very same, and both
 * would be wrong alike. Blocks stay complete. */
static inline size_t aur_nested_number(uint64_t seed, size_t x, size_t y) {
    size_t number = 0;
    for (size_t level = 0; level < AUR_NESTED_LEVELS; ++level)
        number = number << 2 | (x >> level & 1u) << 1 | (y >> level & 1u);
    const size_t eighths = aur_hash3(seed, x / 8, y / 8) & 3u;
    const size_t others = aur_hash4(seed, x / 4, y / 4, 4) & 15u;
    return number ^ (others << 2 | eighths);
}

/* A point of a spherical Fibonacci set of `count` points on the hemisphere - azimuth in turns, and height -
 * where shift number `number` has it. What leaves the hemisphere at one end comes in at the other one, as the
 * lattice goes on there. Heights of all shifts together are the middles of equal steps. */
void aur_nested_shift(size_t count, size_t number, double point[2]);
