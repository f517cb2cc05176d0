/* Independent randomisations of the same points, with unbiased means, from which integrals are estimated. */
#pragma once

#include <aureole/integrate.h>

/* The replicates of one stratum of the domain: of one peak, or of the rest of the domain. */
typedef struct aur_replicates aur_replicates;

enum { AUR_REPLICATES_MAX = 64 };

/* options->replicates of them with `capacity` points each. `peak` is an index, or peak_count for the rest of
 * the domain. The options must outlive the replicates. On failure *replicates is NULL. */
aur_result aur_replicates_create(const aur_integrate_options *options, size_t peak, size_t capacity,
                                 aur_replicates **replicates, aur_error *error);
void aur_replicates_destroy(aur_replicates *replicates); /* NULL is allowed */

/* The measure of the stratum, including the axis, by which means over the points are multiplied. */
double aur_replicates_measure(const aur_replicates *replicates);

/* Points first .. first + count - 1 of one replicate: points[count * coordinates], along[count] with an axis,
 * and factors[count] of the function: 0 if the point is not in this stratum. */
aur_result aur_replicates_points(const aur_replicates *replicates, size_t replicate, size_t first,
                                 size_t count, double *points, double *along, double *factors,
                                 aur_error *error);

/* weights[count] of the first `count` points, of sum 1, for all replicates. */
aur_result aur_replicates_weights(const aur_replicates *replicates, size_t count, double *weights,
                                  aur_error *error);
