/* Integrals over directions to a tolerance: a function is called with many points at a time until the
 * interval about the integral is narrow enough.
 *
 * Domains are the sphere, the hemisphere (with cos^m theta, if wished) and caps about +z, and their products
 * with one more axis, a radius or an energy, from one number to another. The value is the integral over solid
 * angle, in steradians, and over the axis. */
#ifndef AUREOLE_INTEGRATE_H
#define AUREOLE_INTEGRATE_H

#include <aureole/sphere.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills values[count] at the unit vectors directions[3 * count] and, where there is an axis, the numbers
 * along[count] on it, else NULL. At most AUR_INTEGRAND_POINTS points a call, in an order that the options
 * fix, on the caller's thread. What is not AUR_OK ends the integration with that result, and may fill
 * `error`. */
typedef aur_result (*aur_integrand)(void *user, size_t count, const double *directions, const double *along,
                                    double *values, aur_error *error);

enum { AUR_INTEGRAND_POINTS = 1024 };

typedef struct aur_integrate_options {
    size_t size;        /* of the caller's struct, so that it can grow */
    aur_domain domain;  /* SPHERE or HEMISPHERE */
    double cap_degrees; /* 0: all of the domain; else the cap of that polar angle about +z */
    double exponent;    /* the function is multiplied by cos^exponent theta; 0 to 1e9, whole HEMISPHERE */
    bool has_axis;      /* the product with [axis_from, axis_to], finite and ascending */
    double axis_from, axis_to;
    double absolute, relative; /* the error wanted: the larger of the two, of which one must be > 0 */
    double confidence;         /* of the interval, in (0,1) */
    size_t replicates;         /* 4 to 64 */
    uint64_t evaluations;      /* at most so many; at least 64 a replicate */
    uint64_t seed;
    aur_progress progress; /* evaluations so far, of those allowed */
} aur_integrate_options;

/* One percent of the value with 95 % confidence, by 8 replicates and at most 2^22 evaluations. */
AUR_API aur_result aur_integrate_options_init(aur_domain domain, aur_integrate_options *options,
                                              aur_error *error) AUR_NONNULL(2);

typedef enum aur_integrate_reason {
    AUR_INTEGRATE_TOLERANCE,  /* the error wanted was reached */
    AUR_INTEGRATE_EVALUATIONS /* one more level would take more evaluations than allowed */
} aur_integrate_reason;

typedef struct aur_integral {
    size_t size;     /* of the caller's struct, so that it can grow */
    double value;    /* the mean of the replicates */
    double error;    /* what was held against the tolerance: the larger of the interval and of difference/4 */
    double interval; /* half the width of Student's interval about the value, over the replicates */
    double difference; /* between the values of the last two levels, both from points of the last */
    uint64_t evaluations;
    size_t levels; /* level k has 64 * 2^k points a replicate, those of the levels before among them */
    aur_integrate_reason reason;
} aur_integral;

/* The integral of a function. On the whole sphere each replicate is a grid (esfg, Marques 2019) turned at
 * random, whose levels of up to 1024 points have exact weights of their own (exact.h) to about the degree
 * sqrt(points / 2.2) - 1; elsewhere it is a Sobol sequence with a random Owen scrambling and equal weights.
 * Both are without bias at a fixed level. The grid doubles until the error is as wanted; nothing is evaluated
 * twice. Intervals hold a little less often than `confidence` says, because they also end the work:
 * docs/choosing.md has the measured coverage. The integral's size must be set. Errors: ARGUMENT (which
 * option, and the range; a value that is not finite, and where), UNSUPPORTED, MEMORY, CANCELLED, and what the
 * function returns. */
AUR_API aur_result aur_integrate(aur_integrand function, void *user, const aur_integrate_options *options,
                                 aur_integral *integral, aur_error *error) AUR_NONNULL(1, 3, 4);

#ifdef __cplusplus
}
#endif

#endif
