/* The implementation of the inverse map: the lattice of a spherical Fibonacci set and its kernels. */
#pragma once

#include <aureole/core.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "points/base/simd_lanes.h"

/* Point j has 1 - z = (j + 1/2) step, for 0 <= j < limit of the `whole` points of the sphere. */
typedef struct aur_sphere_lattice {
    double step, whole, limit;
} aur_sphere_lattice;

enum { AUR_SPHERE_LATTICE_VECTORS = 48 };

/* F_k and (-1)^{k-1} Phi^-k, the basis vectors b_k in units of an index and of a turn (Marques 2019 eq. 5).
 */
extern const double aur_sphere_lattice_vectors[2][AUR_SPHERE_LATTICE_VECTORS];

/* The zone k: b_k and b_{k+1} are nearly orthogonal on the sphere where Phi^{2k} is sqrt 5 pi N sin^2 theta
 * (Keinert 2015), at least 2. log2 of 1 + m is a polynomial within 7.5e-4; the last factor is 1/(2 log2 Phi).
 */
static inline aur_words aur_sphere_lattice_zone(double whole, aur_reals sine_squared) {
    const aur_words bits = (aur_words)(7.0248147310407263 * whole * sine_squared + 1.0);
    const aur_reals exponent = aur_lanes_from_signed((bits >> 52) - 1023);
    const aur_reals m = (aur_reals)((bits & UINT64_C(0xfffffffffffff)) | UINT64_C(0x3ff0000000000000)) - 1.0;
    const aur_reals fraction =
        ((0.15270028479752112 * m + -0.5687040530057504) * m + 1.415653190432735) * m + 8.254628229341662e-4;
    const aur_reals k = (exponent + fraction) * 0.72021004203696985;
    return aur_lanes_from_whole(
        aur_lanes_choose((aur_words)(k > 2.0), aur_lanes_floor(k), (aur_reals){0} + 2.0));
}

/* The nearest point of each direction as an index, or -1 where the four corners of its cell do not decide
 * (near the limit). All kernels give the same. */
typedef void aur_sphere_lattice_kernel(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices);
AUR_KERNELS(aur_sphere_lattice_kernel, aur_sphere_lattice_nearest);

/* Nearest neighbours of arbitrary points in a few dimensions: a k-d tree (Friedman, Bentley and Finkel 1977).
 */

typedef struct aur_tree aur_tree;

typedef struct aur_found {
    double square; /* of the distance */
    size_t index;
} aur_found;

/* Copies the points: `count` of them, `stride` doubles apart, 1 to 8 dimensions, at least one. Errors:
 * MEMORY. */
aur_result aur_tree_create(size_t dimension, size_t count, size_t stride, const double *coordinates,
                           aur_tree **tree, aur_error *error);
void aur_tree_destroy(aur_tree *tree); /* NULL is allowed */

/* The `requested` points nearest to `query`, or all if there are fewer, nearest first, ties by index; returns
 * their number. */
size_t aur_tree_find(const aur_tree *tree, const double *query, size_t requested, aur_found *found);
