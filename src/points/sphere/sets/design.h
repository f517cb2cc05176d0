/* Symmetric spherical designs beyond the table: computed by a solver. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

/* The largest degree: its system takes half a gibibyte. */
enum { AUR_DESIGN_DEGREE_MAX = 101 };

/* Half the points of the design of an odd degree: the minimum for the number of equations and degree / 8
 * more, so that the solver converges from its first start. */
size_t aur_design_half(size_t degree);

/* half[3 * aur_design_half(degree)]: with their opposites a design. Its harmonics to the degree have means
 * below 1e-14. O(degree^6): half a minute at degree 61. Errors: MEMORY, INTERNAL if no start converges. */
aur_result aur_design_solve(size_t degree, double *half, aur_error *error);
