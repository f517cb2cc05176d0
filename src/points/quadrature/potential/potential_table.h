/* The published look-up of z in a table: what aur_z_grid asks for. */
#pragma once

#include <aureole/quadrature.h>

typedef struct aur_potential_table aur_potential_table;

/* Errors: ARGUMENT for a grid out of its ranges, MEMORY. */
aur_result aur_potential_table_create(const aur_z_grid *grid, double smoothness, aur_potential_table **table,
                                      aur_error *error);
void aur_potential_table_destroy(aur_potential_table *table); /* NULL is allowed */

/* z of the normalised cos^m lobe at directions whose cosines to its axis are given. */
void aur_potential_table_evaluate(const aur_potential_table *table, double exponent, size_t count,
                                  const double *cosines, double *z);
