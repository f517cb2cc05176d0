/* The same points many times over, each time moved at random so that no mean has a bias: what integrals are
 * estimated from. */
#pragma once

#include <aureole/integrate.h>

typedef struct aur_replicates aur_replicates;

enum { AUR_REPLICATES_MAX = 64 };

/* 1 - cos of the polar angle of the domain or cap. */
double aur_cap_height(const aur_integrate_options *options);

/* options->replicates of them with `capacity` points each. On the whole sphere without an axis they are one
 * grid and its random turns, else Sobol points with random scramblings. On failure *replicates is NULL. */
aur_result aur_replicates_create(const aur_integrate_options *options, size_t capacity,
                                 aur_replicates **replicates, aur_error *error);
void aur_replicates_destroy(aur_replicates *replicates); /* NULL is allowed */

/* The grid before it is turned; NULL where the points are Sobol's. */
const aur_directions *aur_replicates_grid(const aur_replicates *replicates);

/* Points first .. first + count - 1 of one replicate: directions[3 * count] and, with an axis, along[count].
 */
aur_result aur_replicates_points(const aur_replicates *replicates, size_t replicate, size_t first,
                                 size_t count, double *directions, double *along, aur_error *error);
