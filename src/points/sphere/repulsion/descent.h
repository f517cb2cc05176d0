/* Descent by L-BFGS (Nocedal 1980) of a function of points on the sphere. */
#pragma once

#include <aureole/core.h>
#include <stddef.h>

/* Returns the energy of the points and adds its gradient to `gradient`, in the layout of the coordinates; its
 * radial parts are ignored. INFINITY: the step is not allowed. */
typedef struct aur_sphere_energy {
    double (*evaluate)(void *context, double *gradient);
    void *context;
} aur_sphere_energy;

/* Moves `count` unit vectors, whose x, y and z are `stride` apart and padded with zeros, to a local minimum
 * of the energy; returns the energy. Errors: MEMORY. */
aur_result aur_sphere_descend(const aur_sphere_energy *of, size_t count, size_t stride, double *coordinates,
                              double *energy, aur_error *error);
