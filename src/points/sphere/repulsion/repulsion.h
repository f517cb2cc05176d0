/* Charges on the sphere that repel each other: the energy of some of them against one, and its least value.
 */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/simd.h"

/* Unit vectors, one array a coordinate. With `axes` each charge has a twin at its opposite. */
typedef struct aur_charges {
    size_t count;
    double *x, *y, *z;
    bool axes;
} aur_charges;

typedef struct aur_push {
    double energy;      /* the sum of 1/|x_i - x_j|, for axes also of 1/|x_i + x_j| */
    double gradient[3]; /* of it, but for a part along x_i: the sum of x_j / |x_i - x_j|^3, for axes less that
                           of x_j / |x_i + x_j|^3 */
} aur_push;

/* What charges first .. last-1 but `index` do to charge `index`; no bit depends on the instruction set. */
typedef aur_push aur_push_kernel(const aur_charges *charges, size_t index, size_t first, size_t last);
AUR_KERNELS(aur_push_kernel, aur_push);

/* Charges 0 .. count-1 in shells: shell s has sizes[s] of them, one after another. The energy is half the
 * mean over pairs of all charges plus half the mean over shells of the means over their pairs (Caruyer,
 * Lenglet, Sapiro and Deriche 2013, eqs 3 to 5); of one shell it is the mean over all pairs. */
typedef struct aur_shells {
    size_t count;
    const size_t *sizes;
} aur_shells;

/* Moves the charges downhill (L-BFGS, Nocedal 1980) until the energy falls no more; returns it. Errors:
 * MEMORY. */
aur_result aur_repel(const aur_shells *shells, aur_charges *charges, double *energy, aur_error *error);

/* Puts charges first .. first+count-1 in an order whose prefixes are even: each next one is where the energy
 * of the earlier ones is the least. Errors: MEMORY. */
aur_result aur_order_charges(aur_charges *charges, size_t first, size_t count, aur_error *error);
