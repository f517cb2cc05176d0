/* Confidence intervals for any functional of weighted points, by independent randomisations of the points.
 *
 * A functional is any number that a program computes from a set of points: the mean of a function, the
 * brightness of an image, a quantile. It is computed separately for every randomisation. The mean over the
 * randomisations is the estimate; their spread gives its error. If the functional is linear in the weights,
 * as means are, the estimate is unbiased. Otherwise it has the bias of the functional at the number of points
 * of one randomisation. */
#ifndef AUREOLE_ESTIMATE_H
#define AUREOLE_ESTIMATE_H

#include <aureole/pointset.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One randomisation of one level's points: points[count * dimension] in [0,1)^dimension, one after another,
 * and weights[count] that add up to 1. */
typedef struct aur_estimate_points {
    size_t replicate, level;
    size_t count, dimension;
    const double *points, *weights;
} aur_estimate_points;

/* Computes the functional's values[] from the points. Called on the caller's thread, for levels and
 * randomisations one after the other. A result other than AUR_OK ends the estimate with that result, and may
 * fill `error`. */
typedef aur_result (*aur_functional)(void *user, const aur_estimate_points *points, double *values,
                                     aur_error *error);

typedef struct aur_estimate_options {
    size_t size;               /* sizeof the caller's struct */
    const char *set;           /* a SET of `dimension` dimensions; NULL: "sobol" */
    size_t dimension;          /* 1 or more */
    size_t values;             /* of the functional, 1 to 4096; the first is compared with the target error */
    double absolute, relative; /* target half width: the larger of the two; both 0: one level of all points */
    double confidence;         /* of the intervals, in (0,1) */
    size_t replicates;         /* randomisations, 4 to 64 */
    /* Points of a randomisation on the first level; each level has twice as many. 0: 128, or fewer where two
     * levels need it. */
    size_t first;
    uint64_t evaluations; /* points at most, of all levels and randomisations; at least first * replicates */
    uint64_t seed;
    aur_progress progress; /* points so far, of those allowed */
    aur_warnings warnings; /* one message where the target was not reached, or all randomisations are equal */
} aur_estimate_options;

/* One percent of the first value with 95 % confidence, by 16 randomisations, at most
 * 2^20 points. */
AUR_API aur_result aur_estimate_options_init(size_t dimension, size_t values, aur_estimate_options *options,
                                             aur_error *error) AUR_NONNULL(3);

/* One value of the functional. */
typedef struct aur_estimated {
    double value;      /* the mean over the randomisations */
    double error;      /* its standard error */
    double half_width; /* of Student's interval about the value */
} aur_estimated;

/* Statistics of an estimate; the caller sets `size`. */
typedef struct aur_estimate_report {
    size_t size;
    uint64_t evaluations;
    size_t levels;
    bool reached;      /* the target error; false where one more level would exceed `evaluations` */
    bool constant;     /* the first value is the same in all randomisations: its half width is infinite */
    double resolution; /* 3 / evaluations: fraction of the cube of a feature that the points of all
                          randomisations sampled with 95 % probability; smaller ones have no effect on the
                          intervals */
} aur_estimate_report;

/* Estimates a functional: results[options->values]. Sets that are nets in base 2 are scrambled (Owen 1995),
 * the others shifted modulo 1 (Cranley and Patterson 1976). Levels have independent points. They are combined
 * with weights n^1.5 of their sizes n, independent of their values, so that a linear functional is unbiased.
 * The interval is Student's over the randomisations. Where few values are distinct, as for counts of points,
 * it is never below the effect of one more point. A target is reached after two levels or more; a functional
 * of one value ends after 65536 points. `report` may be NULL. Errors: ARGUMENT (which option, and the range;
 * a value that is not finite), NAME, UNSUPPORTED (a set without that dimension), MEMORY, CANCELLED, and what
 * the functional returns. */
AUR_API aur_result aur_estimate(aur_functional functional, void *user, const aur_estimate_options *options,
                                aur_estimated *results, aur_estimate_report *report, aur_error *error)
    AUR_NONNULL(1, 3, 4);

#ifdef __cplusplus
}
#endif

#endif
