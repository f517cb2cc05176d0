/* Sets of certain sizes whose points are in tables. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "points/sphere/native.h"

/* One size: `count` points that are exact for polynomials up to `degree`, from the rows first ..
 * first+rows-1 of a table. */
typedef struct aur_reference {
    uint16_t count, degree, first, rows;
} aur_reference;

/* The one of the `size` references, in the order of their counts, with the requested number of points.
 * Errors: ARGUMENT for other numbers, with the nearest; UNSUPPORTED for a cap. */
aur_result aur_reference_find(const char *set, size_t size, const aur_reference *references,
                              const aur_native_request *request, const aur_reference **found,
                              aur_error *error);

/* The table of Lebedev's rules by their orbits. */

enum { AUR_LEBEDEV_COUNT = 32 };

/* Their rows are orbits. */
extern const aur_reference aur_lebedev_rules[AUR_LEBEDEV_COUNT];

/* The table of symmetric spherical designs: each of its points and the opposite. */

enum { AUR_T_DESIGN_COUNT = 26 };

extern const aur_reference aur_t_designs[AUR_T_DESIGN_COUNT];

/* Extensible spherical Fibonacci grids: the choice of the order in which sub-grids are added. */

/* The index of the shortest basis vector b_k = (F_k/N, (-1)^{k-1}/Phi^k) of a planar grid of N points, whose
 * y is stretched by `stretch` (Marques 2019 eq. 22 by comparison: the closed form of eq. 23 is wrong at N =
 * 5, 34, 233, 1597, ...). */
size_t aur_grid_shortest_vector(uint64_t base, double stretch);
/* Which of the shifts b_0/2, b_1/2, b_2/2 doubles a grid best: s = g mod 3 with g the longest of the three
 * vectors that make the Voronoi cell (eq. 56); 1 is the paper's stretch. */
size_t aur_grid_first_shift(uint64_t base, double stretch);
/* The same by trying all three on a cap of height `height` (1 hemisphere, 2 sphere) and choosing the doubled
 * grid of the lowest energy. The first point is `centre` index steps below the pole; a negative `centre`
 * selects the middle of each doubled grid. For more than 2048 points the mean stretch of a cap decides. */
size_t aur_grid_best_shift(uint64_t base, double height, double centre);

/* b_s/2^level, s below 3 and level at least 1, as its change of the index (x times N) and of the phase. */
typedef struct aur_grid_shift {
    double index;
    uint64_t phase;
} aur_grid_shift;

aur_grid_shift aur_grid_shift_of(size_t s, size_t level);
