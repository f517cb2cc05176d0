/* Common code of rank-1 lattices: coordinate d of point i is i g_d / N modulo 1. */
#pragma once

#include "points/pointset/digits/run.h"

static inline uint64_t aur_common_divisor(uint64_t a, uint64_t b) {
    while (b != 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* The coordinates of points from `first` on, for a component of the vector. */
static inline void aur_run_of_lattice(uint64_t component, uint64_t first, uint64_t size, aur_run *run) {
    __extension__ typedef unsigned __int128 wide;
    const uint64_t step = component % size;
    aur_run_of_multiples((uint64_t)((wide)(first % size) * step % size), step, size, run);
}
