/* The values of a function at the points of all strata and replicates. */
#pragma once

#include <aureole/integrate.h>

#include "points/quadrature/integrate/replicates.h"

/* One part of the domain: the values of all replicates so far. */
typedef struct aur_stratum {
    aur_replicates *replicates;
    double scale;                       /* its measure, or fraction of the domain for a mean */
    size_t count;                       /* points of a replicate with values */
    size_t next;                        /* of the next level */
    size_t capacity;                    /* of each array below, in points */
    double *values[AUR_REPLICATES_MAX]; /* NaN: the point is not in this aur_stratum */
    double *weights;                    /* of the points, for all replicates */
} aur_stratum;

typedef struct aur_integration {
    aur_integrate_options options;
    aur_integrand function;
    void *user;
    size_t values, strata;
    size_t most; /* points of a replicate */
    aur_stratum *parts;
    double *results, *scratch; /* of one call: points, along, factors, values; of evidence */
    size_t scratch_capacity;
    double *means;  /* of one value: strata * replicates */
    double *shares; /* strata: of the variance of the mean */
    aur_estimated *found;
    double *before;         /* values of the previous level */
    double (*variances)[3]; /* of each value: the mean's, on this level and the two before */
    double quantile;        /* Student's, of the half width in standard errors */
    bool *all_equal;        /* of each value: those of all points */
    bool met;               /* the targets, by the errors of the level */
    aur_integral integral;
} aur_integration;

/* Evaluates the function at points, with `width` values each. Errors: ARGUMENT for a value that is not
 * finite, and where. */
aur_result aur_integrand_check(const aur_integrate_options *options, size_t width, size_t count,
                               const double *points, const double *values, aur_error *error);

/* Evaluates a stratum at the points of the next level. Errors: those of the function, MEMORY, CANCELLED. */
aur_result aur_integration_evaluate(aur_integration *work, aur_stratum *part, aur_error *error);

/* By rules of one point per orbit of the options' group, whose degree doubles until two agree: fills
 * found[values] and the integral. Errors: also those of aur_symmetric_rule. */
aur_result aur_integrate_orbits(aur_integrand function, void *user, const aur_integrate_options *options,
                                aur_estimated *found, aur_integral *integral, aur_error *error);
