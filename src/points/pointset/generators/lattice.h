/* Rank-1 lattices and the golden-ratio limit of Fibonacci ones. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

enum { AUR_LATTICE_CAPACITY = 256 };

typedef struct aur_lattice {
    double offset; /* of the first coordinate, in steps */
    bool golden;   /* the second coordinate is i / Phi */
    uint64_t vector[AUR_LATTICE_CAPACITY];
} aur_lattice;

void aur_lattice_make_fibonacci(uint64_t size, double offset, aur_lattice *lattice);
