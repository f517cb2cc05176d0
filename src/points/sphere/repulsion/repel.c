/* The minimal energy of charges on the sphere, by L-BFGS (Nocedal 1980) with steps that end on the sphere. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/sphere/repulsion/descent.h"
#include "points/sphere/repulsion/repulsion.h"

typedef struct repulsion {
    const aur_shells *shells;
    aur_charges *charges; /* coordinates in one block: x, y and z are `stride` apart */
    aur_push_kernel *kernel;
    size_t stride;
} repulsion;

static double pairs(size_t count) {
    return 0.5 * (double)count * (double)(count - 1);
}

/* Adds the interaction of charges of one range, times `factor`. */
static double add_range(const repulsion *d, size_t first, size_t last, double factor, double *gradient) {
    double sum = 0.0;
    for (size_t i = first; i < last; ++i) {
        const aur_push push = d->kernel(d->charges, i, first, last);
        sum += push.energy;
        for (size_t c = 0; c < 3; ++c)
            gradient[c * d->stride + i] += factor * push.gradient[c];
    }
    return 0.5 * factor * sum;
}

static double energy_and_gradient(void *context, double *gradient) {
    const repulsion *const d = context;
    const size_t count = d->charges->count, shells = d->shells->count;
    const double share = shells > 1 ? 0.5 : 1.0;
    double energy = add_range(d, 0, count, share / pairs(count), gradient);
    for (size_t s = 0, first = 0; s < shells && shells > 1; first += d->shells->sizes[s], ++s)
        if (d->shells->sizes[s] > 1)
            energy += add_range(d, first, first + d->shells->sizes[s],
                                0.5 / ((double)shells * pairs(d->shells->sizes[s])), gradient);
    return energy;
}

aur_result aur_repel(const aur_shells *shells, aur_charges *charges, double *energy, aur_error *error) {
    *energy = 0.0;
    if (charges->count < 2)
        return AUR_OK;
    repulsion d = {.shells = shells,
                   .charges = charges,
                   .kernel = AUR_KERNEL_HERE(aur_push),
                   .stride = (size_t)(charges->y - charges->x)};
    const aur_sphere_energy of = {energy_and_gradient, &d};
    return aur_sphere_descend(&of, charges->count, d.stride, charges->x, energy, error);
}

static void exchange(double *values, size_t a, size_t b) {
    const double saved = values[a];
    values[a] = values[b];
    values[b] = saved;
}

aur_result aur_order_charges(aur_charges *charges, size_t first, size_t count, aur_error *error) {
    double *const potential = calloc(count + 1, sizeof *potential);
    if (potential == NULL)
        return aur_fail_memory(error);
    double *const x = charges->x + first, *const y = charges->y + first, *const z = charges->z + first;
    for (size_t k = 0; k + 1 < count; ++k) {
        size_t best = k + 1;
        for (size_t i = k + 1; i < count; ++i) {
            const double c = x[i] * x[k] + y[i] * y[k] + z[i] * z[k];
            potential[i] += 1.0 / sqrt(fmax(2.0 - 2.0 * c, 1e-30));
            if (charges->axes)
                potential[i] += 1.0 / sqrt(fmax(2.0 + 2.0 * c, 1e-30));
            if (potential[i] < potential[best])
                best = i;
        }
        exchange(x, k + 1, best);
        exchange(y, k + 1, best);
        exchange(z, k + 1, best);
        exchange(potential, k + 1, best);
    }
    free(potential);
    return AUR_OK;
}
