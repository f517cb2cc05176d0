/* The inside of the inverse map: the lattice of a spherical Fibonacci set and its kernels. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Point j has 1 - z = (j + 1/2) step, for 0 <= j < limit of the `whole` points of the sphere. */
typedef struct aur_sphere_lattice {
    double step, whole, limit;
} aur_sphere_lattice;

enum { AUR_SPHERE_LATTICE_VECTORS = 48 };

/* F_k and (-1)^{k-1} Phi^-k, the basis vectors b_k in units of an index and of a turn (Marques 2019 eq. 5).
 */
extern const double aur_sphere_lattice_vectors[2][AUR_SPHERE_LATTICE_VECTORS];

typedef void (*aur_sphere_lattice_kernel)(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                          double *indices);

/* The nearest point of each direction as an index, or -1 where the four corners of its cell do not decide
 * (near the limit). All kernels give the same. */
void aur_sphere_lattice_nearest_portable(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                         double *indices);
void aur_sphere_lattice_nearest_avx2(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                     double *indices);
void aur_sphere_lattice_nearest_avx512(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices);
