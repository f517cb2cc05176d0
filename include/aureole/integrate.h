/* Integrals to a tolerance: a function is called with many points at a time until the confidence interval of
 * the integral is narrow enough.
 *
 * Domains are those of points (square, cube, disk, hemisphere, sphere, caps, axes, rotations), the ball, the
 * triangle and the tetrahedron, and the product of each with one more axis, a radius or an energy. The value
 * is the integral over area, volume or solid angle in steradians, times the axis; or the mean. */
#ifndef AUREOLE_INTEGRATE_H
#define AUREOLE_INTEGRATE_H

#include <aureole/estimate.h>
#include <aureole/symmetry.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills values[count * options.values], the values of the first point first, at points[count * coordinates].
 * With an axis, along[count] are the coordinates on it; otherwise `along` is NULL. Points of the sphere,
 * hemisphere and axes are unit vectors, rotations are unit quaternions w,x,y,z. At most AUR_INTEGRAND_POINTS
 * points per call, in an order that the options fix, on the caller's thread. A result other than AUR_OK ends
 * the integration with that result, and may fill `error`. */
typedef aur_result (*aur_integrand)(void *user, size_t count, const double *points, const double *along,
                                    double *values, aur_error *error);

enum { AUR_INTEGRAND_POINTS = 1024, AUR_INTEGRATE_DIMENSION_MAX = 1024, AUR_INTEGRATE_VALUES_MAX = 65536 };

/* Domains other than those of point sets. BALL: of radius 1, volume 4 pi/3. TRIANGLE, TETRAHEDRON: all
 * coordinates >= 0 and their sum <= 1, area 1/2 and volume 1/6. */
typedef enum aur_region {
    AUR_REGION_DOMAIN, /* the field `domain` has the domain */
    AUR_REGION_BALL,
    AUR_REGION_TRIANGLE,
    AUR_REGION_TETRAHEDRON
} aur_region;

/* A part of the domain with separate points: where the function has a narrow peak or a singularity. */
typedef struct aur_integrate_peak {
    const double *centre; /* sphere, hemisphere, axes: a unit vector; square, cube: a point */
    double radius;        /* degrees; square, cube: half the side of a box. 0: all of the domain */
    double exponent;      /* >= 0: the function grows as distance^-exponent about the centre; must be below 2
                             (square, cube: the dimension) */
} aur_integrate_peak;

typedef struct aur_integrate_options {
    size_t size; /* sizeof the caller's struct */
    aur_domain domain;
    double cap_degrees; /* SPHERE, HEMISPHERE; 0: all of it; else the cap of that polar angle about +z */
    double exponent;    /* the function is multiplied by cos^exponent theta; 0 to 1e9, whole HEMISPHERE */
    bool has_axis;      /* the product with [axis_from, axis_to], finite and ascending */
    double axis_from, axis_to;
    double absolute, relative; /* the target error: the larger of the two; both 0: one level of `first` */
    double confidence;         /* of the interval, in (0,1) */
    size_t replicates;         /* randomisations, 4 to 64 */
    uint64_t evaluations;      /* the largest number */
    uint64_t seed;
    aur_progress progress; /* evaluations so far, of those allowed */

    aur_region region; /* replaces `domain` */
    size_t dimension;  /* of CUBE: 1 to AUR_INTEGRATE_DIMENSION_MAX */
    size_t values;     /* of the function: 1 to AUR_INTEGRATE_VALUES_MAX; 0: 1 */
    /* Values are separate integrals: each has its own target error and its own warnings. Otherwise they are
     * the components of one: the target is relative to the largest of them. */
    bool separate;
    bool mean; /* the value is divided by the measure of the domain */
    /* Points of a randomisation on the first level. 0: as many as give 2048 evaluations, or an eighth of
     * those that the resolution needs, and no result below 8192. Otherwise the caller must know that this
     * many resolve the function. */
    size_t first;
    size_t peak_count;
    const aur_integrate_peak *peaks; /* a point in several peaks belongs to the first of them */
    /* The points, a SET; then there is one level. NULL: esfg on the sphere and axes without an axis, sobol
     * elsewhere. */
    const char *set;
    aur_warnings warnings; /* one message for each bit of `doubts`, and where the target was not reached */
    /* The point group of a smooth function on the whole SPHERE: one direction of each orbit is evaluated, by
     * rules (aur_symmetric_rule) of 256 points (or `first`) and four times as many until two agree. Error and
     * interval are the change from the rule before. Without axis, peaks, set and `separate`. */
    const aur_point_group *group;
    /* The size of the smallest feature as a fraction of the domain, 1e-12 to 1. The integration ends only
     * after a feature of that size has been sampled with 95 % probability (3 / resolution points in addition
     * to those of peaks). 0: 1e-5, the size of the sun in the sky; and 1 (no condition) with `first` or
     * peaks, which tell where the function is narrow. If `evaluations`, or 128 MiB of values, do not suffice
     * for 1e-5, the result has the doubt AUR_INTEGRATE_UNRESOLVED. Not with a group or a set. */
    double resolution;
} aur_integrate_options;

/* One percent of the value with 95 % confidence, by 16 randomisations, at least 2^19 evaluations (see
 * `resolution`: if no feature of a slow function is narrow, set it to 1) and at most 2^22. */
AUR_API aur_result aur_integrate_options_init(aur_domain domain, aur_integrate_options *options,
                                              aur_error *error) AUR_NONNULL(2);

/* Numbers per point of the options' domain: 2 to 4, or the dimension of the cube. */
AUR_API size_t aur_integrate_coordinates(const aur_integrate_options *options) AUR_NONNULL(1);

typedef enum aur_integrate_reason {
    AUR_INTEGRATE_TOLERANCE,   /* the target error was reached */
    AUR_INTEGRATE_EVALUATIONS, /* one more level would take more evaluations than allowed */
    AUR_INTEGRATE_CONSTANT     /* the same value at all of 65536 points or more: the error has no bound */
} aur_integrate_reason;

/* Reasons not to trust an interval: bits of aur_integral.doubts. */
typedef enum aur_integrate_doubt {
    AUR_INTEGRATE_ALL_EQUAL = 1,  /* all values are equal: the interval is infinite */
    AUR_INTEGRATE_SPARSE = 2,     /* fewer than 64 values differ from the most frequent one */
    AUR_INTEGRATE_DOMINATED = 4,  /* one point contributes more than half of the sum of magnitudes */
    AUR_INTEGRATE_HEAVY_TAIL = 8, /* the largest values fall as slowly as those of infinite variance do */
    AUR_INTEGRATE_UNRESOLVED = 16 /* too few points to sample a feature of the options' resolution */
} aur_integrate_doubt;

typedef struct aur_integral {
    size_t size;       /* sizeof the caller's struct */
    double value;      /* the mean of the replicates; of several values the first */
    double error;      /* compared with the target: the larger of the interval and of difference/4; of several
                          values the largest */
    double interval;   /* half the width of the interval about the value */
    double difference; /* between the values of the last two levels, both from points of the last */
    uint64_t evaluations;
    size_t levels; /* each doubles the points and includes those of the previous level */
    aur_integrate_reason reason;
    unsigned doubts;   /* of aur_integrate_doubt */
    double resolution; /* 3/N: size of features, as a fraction of the domain, sampled with 95 % probability */
    /* Sphere, hemisphere and axes: the radius of a cap of that size (with the exponent: about +z), 95 % of
     * which contain a point. Elsewhere 0. */
    double resolution_degrees;
} aur_integral;

/* The integral of a function. On the whole sphere and for axes each replicate is a randomly rotated grid
 * (esfg, Marques 2019) with exact weights (exact.h) to about the degree sqrt(points / 2.2) - 1 for at most
 * 1024 points and to degree 6 beyond; elsewhere it is a Sobol sequence with a random Owen scrambling and
 * equal weights. Both are unbiased at a fixed level. Points double until the error is below the target;
 * nothing is evaluated twice.
 *
 * The interval is Student's over the replicates. Where replicates agree by chance, their variance is pooled
 * with the variance that earlier levels predict. It is never below the effect of one more point in one
 * replicate: the largest lasting gap between values, or the largest value where the tail is heavy. At least
 * two levels are compared, and a level with a doubt is not the last. A function of one value alone ends the
 * work after 65536 evaluations. docs/integrals.md has the measured coverage.
 *
 * `results`, unless NULL, has one element for each of the function's values. The caller sets `size` of the
 * integral. Errors: ARGUMENT (which option, and the range; a value that is not finite, and where),
 * UNSUPPORTED, MEMORY, CANCELLED, and what the function returns. */
AUR_API aur_result aur_integrate_values(aur_integrand function, void *user,
                                        const aur_integrate_options *options, aur_estimated *results,
                                        aur_integral *integral, aur_error *error) AUR_NONNULL(1, 3, 5);

/* The same for the first value. */
AUR_API aur_result aur_integrate(aur_integrand function, void *user, const aur_integrate_options *options,
                                 aur_integral *integral, aur_error *error) AUR_NONNULL(1, 3, 4);

#ifdef __cplusplus
}
#endif

#endif
