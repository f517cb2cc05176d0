/* Repelling charges on the sphere: the energy of one against others, and minimisation of the energy. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/simd.h"

/* Unit vectors, one array per coordinate. With `axes` each charge has a twin at its opposite. */
typedef struct aur_charges {
    size_t count;
    double *x, *y, *z;
    bool axes;
} aur_charges;

typedef struct aur_push {
    double energy;      /* the sum of 1/|x_i - x_j|, for axes also of 1/|x_i + x_j| */
    double gradient[3]; /* of it, except for a radial part: the sum of x_j / |x_i - x_j|^3, for axes less that
                           of x_j / |x_i + x_j|^3 */
} aur_push;

/* The force of charges first .. last-1, except `index`, on charge `index`; bit-identical for all instruction
 * sets. */
typedef aur_push aur_push_kernel(const aur_charges *charges, size_t index, size_t first, size_t last);
AUR_KERNELS(aur_push_kernel, aur_push);

/* Charges 0 .. count-1 in shells: shell s has sizes[s] of them, one after another. The energy is half the
 * mean over pairs of all charges plus half the mean over shells of the means over their pairs (Caruyer,
 * Lenglet, Sapiro and Deriche 2013, eqs 3 to 5); of one shell it is the mean over all pairs. */
typedef struct aur_shells {
    size_t count;
    const size_t *sizes;
} aur_shells;

/* Moves the charges to a local minimum of the energy (L-BFGS, Nocedal 1980); returns the energy. Errors:
 * MEMORY. */
aur_result aur_repel(const aur_shells *shells, aur_charges *charges, double *energy, aur_error *error);

/* Orders charges first .. first+count-1 so that prefixes are uniform: each next charge is where the energy of
 * the earlier ones is minimal. Errors: MEMORY. */
aur_result aur_order_charges(aur_charges *charges, size_t first, size_t count, aur_error *error);
