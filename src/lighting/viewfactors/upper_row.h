/* The rows of an exchange matrix before assembly. */
#pragma once

#include "lighting/viewfactors/exchange.h"

/* The entries of a row from the diagonal on. */
typedef struct aur_upper_row {
    size_t count;
    uint32_t *columns;
    double *closed, *sampled, *half_widths;
    float *deviations; /* [count][randomizations] */
    uint64_t closed_pairs, sampled_pairs;
} aur_upper_row;

/* Fills the matrix from its upper triangle, rows[exchange->rows]. Its areas are set. False if out of memory.
 * Frees the rows' deviations. */
bool aur_exchange_mirror(aur_upper_row *rows, aur_exchange *exchange);
