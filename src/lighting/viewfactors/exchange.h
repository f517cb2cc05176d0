/* The symmetric matrix of exchanges, area times factor, of the rows of the result. */
#pragma once

#include "lighting/viewfactors/closed_pairs.h"

/* Compressed rows, each with ascending columns; entries above and below the diagonal have the same bits. */
typedef struct aur_exchange {
    size_t rows;
    uint64_t *starts;    /* rows + 1 */
    uint32_t *columns;   /* starts[rows], as for the next three */
    double *values;      /* exchanges */
    double *variances;   /* what balancing weighs changes by; 0 for closed forms alone */
    double *half_widths; /* of the exchanges' intervals */
    /* What each randomisation is off the mean: of the entries from the diagonal on, row by row, and of sky,
     * then back, of every row. */
    float *deviations;       /* [upper entries][randomizations] */
    double *loss_deviations; /* [2][rows][randomizations] */
    size_t randomizations;
    double student; /* half an interval over its standard error */
    double *areas;  /* rows, as for all that follow */
    double *sky, *sky_half_widths;
    double *back, *back_half_widths;
    uint64_t closed_pairs, sampled_pairs; /* of patches */
    double closed_total;                  /* of both triangles */
} aur_exchange;

/* Puts closed forms and counted rays together. Errors: CANCELLED, MEMORY. */
aur_result aur_exchange_assemble(const aur_facets *facets, const aur_ray_hits *ray_hits,
                                 const aur_closed_pairs *closed, double confidence,
                                 const aur_parallel_options *parallel, aur_exchange *exchange,
                                 aur_error *error);
void aur_exchange_release(aur_exchange *exchange);

/* How far rows are from their areas, as parts of them. */
typedef struct aur_balance {
    double before;     /* root mean square, weighed by area */
    double after;      /* the largest */
    size_t unbalanced; /* rows that are off by more than 1e-12 */
    double moved;      /* sum of |changes| over the sum of all exchanges */
} aur_balance;

/* Moves exchanges, sky and backs so that every row adds up to its area: the least squares of the changes in
 * proportion to their variances, none below 0, first of what is sampled, and of all only where that does not
 * suffice. Where the pattern of entries has no such matrix, the nearest one is left. Intervals become those
 * of what was moved. Errors: CANCELLED, MEMORY. */
aur_result aur_exchange_balance(aur_exchange *exchange, const aur_parallel_options *parallel,
                                aur_balance *balance, aur_error *error);

/* Half widths of intervals from the deviations, which this leaves. Errors: MEMORY. */
aur_result aur_exchange_find_widths(aur_exchange *exchange, aur_error *error);
