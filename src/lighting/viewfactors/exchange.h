/* The symmetric matrix of exchanges (area times factor) between the rows of the result. */
#pragma once

#include "lighting/viewfactors/closed_pairs.h"

/* Compressed sparse rows with ascending columns; symmetric entries are bit-identical. */
typedef struct aur_exchange {
    size_t rows;
    uint64_t *starts;    /* rows + 1 */
    uint32_t *columns;   /* starts[rows], as for the next three */
    double *values;      /* exchanges */
    double *variances;   /* weights of the correction; 0 for closed forms only */
    double *half_widths; /* of the intervals */
    /* Deviations of each randomisation from the mean: of the entries from the diagonal on, row by row, and of
     * sky, then back, of every row. */
    float *deviations;       /* [upper entries][randomizations] */
    double *loss_deviations; /* [2][rows][randomizations] */
    size_t randomizations;
    double student; /* Student's t: half width of an interval over its standard error */
    double *areas;  /* rows, as for all arrays below */
    double *sky, *sky_half_widths;
    double *back, *back_half_widths;
    uint64_t closed_pairs, sampled_pairs; /* of patches */
    double closed_total;                  /* over both triangles */
} aur_exchange;

/* Combines closed forms and counted rays. Errors: CANCELLED, MEMORY. */
aur_result aur_exchange_assemble(const aur_facets *facets, const aur_ray_hits *ray_hits,
                                 const aur_closed_pairs *closed, double confidence,
                                 const aur_parallel_options *parallel, aur_exchange *exchange,
                                 aur_error *error);
void aur_exchange_release(aur_exchange *exchange);

/* Residuals of row sums, relative to the areas. */
typedef struct aur_balance {
    double before;     /* root mean square before the correction, weighted by area */
    double after;      /* maximum after the correction */
    size_t unbalanced; /* rows that are off by more than 1e-12 */
    double moved;      /* sum of |changes| over the sum of all exchanges */
} aur_balance;

/* Changes exchanges, sky and backs so that every row sums to its area: weighted least squares (weights:
 * variances), none below 0; first the sampled entries, then all if that does not suffice. If the pattern of
 * entries admits no such matrix, the result is the nearest one. Intervals are updated. Errors: CANCELLED,
 * MEMORY. */
aur_result aur_exchange_balance(aur_exchange *exchange, const aur_parallel_options *parallel,
                                aur_balance *balance, aur_error *error);

/* Computes the half widths of intervals from the deviations, which are unchanged. Errors: MEMORY. */
aur_result aur_exchange_find_widths(aur_exchange *exchange, aur_error *error);
