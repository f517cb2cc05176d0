/* Functions in which a cap's polynomials are written, orthonormal for a density that depends on the height
 * alone: Y(z, phi) = q(z) (1 - z^2)^{m/2} times cos(m phi) or sin(m phi). On the whole sphere they are the
 * spherical harmonics. The polynomials of degree L in x, y, z are those of orders m <= l <= L. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"

/* Beyond, powers of the sine underflow where the functions do not vanish. */
enum { AUR_BASIS_DEGREE_MAX = 1500 };

/* One step of the recurrence: q_l = (scale z + shift) q_{l-1} - before q_{l-2}. */
typedef struct aur_basis_step {
    double scale, shift, before;
} aur_basis_step;

typedef struct aur_basis {
    size_t degree;
    double *start;         /* degree + 1: q_mm is start[m] sin(theta) times q_{m-1,m-1}; start[0] is 1 */
    aur_basis_step *steps; /* at aur_basis_at(degree, m) + l - m; that of l = m is not used */
} aur_basis;

/* Where order m begins among the pairs m <= l <= degree, and how many pairs there are. */
static inline size_t aur_basis_at(size_t degree, size_t m) {
    return m * (degree + 1) - m * (m - 1) / 2;
}
static inline size_t aur_basis_pairs(size_t degree) {
    return (degree + 1) * (degree + 2) / 2;
}

/* The functions to a degree for the density z^exponent on the cap z >= `lowest`, normalised to integral 1;
 * `lowest` -1 is the sphere, 0 the hemisphere; `exponent` is 0 unless `lowest` is. The mean of each squared
 * function over the density is 1. Errors: MEMORY. On failure there is nothing to release. */
aur_result aur_basis_create(size_t degree, double lowest, double exponent, aur_basis *basis,
                            aur_error *error);
void aur_basis_release(aur_basis *basis);
