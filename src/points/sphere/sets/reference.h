/* Sets of some sizes only, whose points stand in tables. */
#pragma once

#include "points/sphere/native.h"

/* One size: `count` points that are exact for polynomials up to `degree`, from the rows first ..
 * first+rows-1 of a table. */
typedef struct aur_reference {
    uint16_t count, degree, first, rows;
} aur_reference;

/* That of the `size` references, in the order of their counts, which has as many points as are asked for.
 * Errors: ARGUMENT for a number between, with the nearest; UNSUPPORTED for a cap. */
aur_result aur_reference_find(const char *set, size_t size, const aur_reference *references,
                              const aur_native_request *request, const aur_reference **found,
                              aur_error *error);

/* The table of Lebedev's rules by their orbits. */

enum { AUR_LEBEDEV_COUNT = 10 };

/* Their rows are orbits. */
extern const aur_reference aur_lebedev_rules[AUR_LEBEDEV_COUNT];

/* The table of symmetric spherical designs: each of its points and the opposite. */

enum { AUR_T_DESIGN_COUNT = 13 };

extern const aur_reference aur_t_designs[AUR_T_DESIGN_COUNT];
