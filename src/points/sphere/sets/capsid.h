/* Triangular lattices on an icosahedron, as in virus capsids: for charges they are the known equilibria of
 * least energy at many sizes of a few hundred. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Fills x, y, z[count] with unit vectors: lattice number `which` of those with 10 (h^2 + h k + k^2) + 2 =
 * count points. False if there are no more. */
bool aur_capsid(size_t count, size_t which, double *x, double *y, double *z);
