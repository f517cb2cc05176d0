/* Weights by control variates with coefficients fitted to the same samples: published methods that solve a
 * system, as optimal weights do. */
#ifndef LAB_MARQUES_2018_CONTROL_H
#define LAB_MARQUES_2018_CONTROL_H

#include <aureole/quadrature.h>

typedef enum lab_control_basis {
    LAB_CONTROL_DENSITIES,  /* of the strategies: optimal multiple importance sampling (Kondapaneni 2019) */
    LAB_CONTROL_POLYNOMIALS /* of `degree` in x, y, z times the lobe: regression (Salaun 2022) */
} lab_control_basis;

typedef struct lab_control {
    lab_control_basis basis;
    size_t degree; /* 1 .. LAB_CONTROL_DEGREE_MAX */
    size_t count;  /* samples of both strategies, the first strategy's first */
    const double *xyz;
    aur_strategy strategies[2]; /* unclipped cos^m lobes */
    size_t lobe;                /* index of the strategy whose lobe is integrated, over the upper hemisphere
                                 */
    /* Points of equal weight that integrate the lobes: node_count of the first one, then of the second. */
    size_t node_count;
    const double *nodes;
} lab_control;

enum { LAB_CONTROL_DEGREE_MAX = 4 };

/* weights[count]: the sum of weight * light estimates the integral of light times the normalised lobe.
 * Samples below the surface get 0. Errors: INTERNAL if the system is singular. */
aur_result lab_control_weights(const lab_control *control, double *weights, aur_error *error);

#endif
