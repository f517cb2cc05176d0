/* Functions on domains other than parts of the sphere, at given points: their rows are stored, so that sums
 * over them take O(functions * points). */
#pragma once

#include <aureole/exact.h>
#include <aureole/rotations.h>

/* Orthonormal functions for the uniform density, in the order of their degrees; the first is 1. On square and
 * cube products of Legendre polynomials of a total degree, on the disk Zernike's, on rotations the real
 * Wigner functions that are invariant under the symmetries. */
typedef struct aur_exact_space {
    aur_domain domain;
    size_t dimension; /* coordinates of a point */
    aur_symmetry crystal, sample;
    size_t threads;
    size_t count;
    double *points; /* dimension each; for rotations the first nonzero coordinate is positive */
    size_t filled;  /* degrees with computed rows */
    double *rows;   /* of count each */
} aur_exact_space;

/* Whether this file has the functions of a domain. */
bool aur_exact_space_has(aur_domain domain);
/* Copies the points and checks them. Errors: ARGUMENT for options and points out of range (which), MEMORY. On
 * failure nothing needs to be released. */
aur_result aur_exact_space_open(size_t count, const double *points, const aur_exact_options *options,
                                aur_exact_space *space, aur_error *error);
void aur_exact_space_release(aur_exact_space *space);

/* The number of functions to a degree; SIZE_MAX on overflow. */
size_t aur_exact_space_size(const aur_exact_space *space, size_t degree);
/* Computes the rows to a degree. Errors: MEMORY, UNSUPPORTED for more than AUR_EXACT_ENTRIES_MAX numbers. */
aur_result aur_exact_space_fill(aur_exact_space *space, size_t degree, aur_error *error);
/* coefficients[size] = sum over points of weights[i] f_j(x_i), and values[i] = sum over the first `size`
 * functions of coefficients[j] f_j(x_i); the rows must have been computed. */
aur_result aur_exact_space_analyse(const aur_exact_space *space, size_t size, const double *weights,
                                   double *coefficients, aur_error *error);
aur_result aur_exact_space_synthesise(const aur_exact_space *space, size_t size, const double *coefficients,
                                      double *values, aur_error *error);

/* The number of Wigner functions of degree `degree` that are invariant under both symmetries, */
size_t aur_wigner_size(aur_symmetry crystal, aur_symmetry sample, size_t degree);
/* and rows[j * count + i] of those of all degrees to `degree` at unit quaternions. Errors: MEMORY. */
aur_result aur_wigner_rows(aur_symmetry crystal, aur_symmetry sample, size_t degree, size_t count,
                           const double *wxyz, double *rows, aur_error *error);
