/* Functions on domains that are no part of the sphere, at given points: their rows are stored, so that sums
 * over them take O(functions * points). */
#pragma once

#include <aureole/exact.h>
#include <aureole/rotations.h>

/* Orthonormal functions for the uniform density, in the order of their degrees; the first is 1. On square and
 * cube products of Legendre polynomials of a total degree, on the disk Zernike's, of rotations the real
 * Wigner functions that the symmetries leave unchanged. */
typedef struct aur_exact_space {
    aur_domain domain;
    size_t dimension; /* coordinates of a point */
    aur_symmetry crystal, sample;
    size_t threads;
    size_t count;
    double *points; /* dimension each; of rotations the first coordinate that is not 0 is positive */
    size_t filled;  /* degrees whose rows are there */
    double *rows;   /* of count each */
} aur_exact_space;

/* Whether a domain's functions are made here. */
bool aur_exact_space_has(aur_domain domain);
/* Copies the points and checks them. Errors: ARGUMENT for options and points out of range (which), MEMORY. On
 * failure there is nothing to release. */
aur_result aur_exact_space_open(size_t count, const double *points, const aur_exact_options *options,
                                aur_exact_space *space, aur_error *error);
void aur_exact_space_release(aur_exact_space *space);

/* How many functions there are to a degree; SIZE_MAX for more than can be counted. */
size_t aur_exact_space_size(const aur_exact_space *space, size_t degree);
/* Makes the rows to a degree. Errors: MEMORY, UNSUPPORTED for more than AUR_EXACT_ENTRIES_MAX numbers. */
aur_result aur_exact_space_fill(aur_exact_space *space, size_t degree, aur_error *error);
/* coefficients[size] = sum over points of weights[i] f_j(x_i), and values[i] = sum over the first `size`
 * functions of coefficients[j] f_j(x_i); the rows must be there. */
aur_result aur_exact_space_analyse(const aur_exact_space *space, size_t size, const double *weights,
                                   double *coefficients, aur_error *error);
aur_result aur_exact_space_synthesise(const aur_exact_space *space, size_t size, const double *coefficients,
                                      double *values, aur_error *error);

/* The Wigner functions of degree `degree` that both symmetries leave unchanged: how many there are, */
size_t aur_wigner_size(aur_symmetry crystal, aur_symmetry sample, size_t degree);
/* and rows[j * count + i] of those of all degrees to `degree` at unit quaternions. Errors: MEMORY. */
aur_result aur_wigner_rows(aur_symmetry crystal, aur_symmetry sample, size_t degree, size_t count,
                           const double *wxyz, double *rows, aur_error *error);
