/* Descent by L-BFGS (Nocedal 1980) of a function of points on the sphere. */
#pragma once

#include <aureole/core.h>
#include <stddef.h>

/* The energy of the points as they lie now; adds its gradient, whose part along each point has no meaning, to
 * `gradient`, which lies as the coordinates do. INFINITY: a place that a step must not reach. */
typedef struct aur_sphere_energy {
    double (*evaluate)(void *context, double *gradient);
    void *context;
} aur_sphere_energy;

/* Moves `count` unit vectors, whose x, y and z lie `stride` apart with zeros behind them, downhill until the
 * energy falls no more; returns it. Errors: MEMORY. */
aur_result aur_sphere_descend(const aur_sphere_energy *of, size_t count, size_t stride, double *coordinates,
                              double *energy, aur_error *error);
