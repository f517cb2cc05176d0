/* Symmetric spherical designs that no table has: solved for. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

/* Larger ones are not made: this one's system takes half a gibibyte. */
enum { AUR_DESIGN_DEGREE_MAX = 101 };

/* Half the points of the design of an odd degree: as few as there are free angles for its equations, and
 * degree / 8 more, so that the solver arrives from its first start. */
size_t aur_design_half(size_t degree);

/* half[3 * aur_design_half(degree)]: with their opposites a design. Its harmonics to the degree have means
 * below 1e-14. O(degree^6): half a minute at degree 61. Errors: MEMORY, INTERNAL where no start arrives. */
aur_result aur_design_solve(size_t degree, double *half, aur_error *error);
