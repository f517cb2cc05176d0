#include "points/sphere/repulsion/descent.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"

enum { MEMORY = 12, ITERATIONS = 2000, HALVINGS = 30 };

/* The relative decrease of the energy in a step below which the descent has converged. */
static const double least_fall = 1e-14;

typedef struct descent {
    const aur_sphere_energy *of;
    size_t count, stride;
    double *x;                                           /* the coordinates: x, y and z are `stride` apart */
    double *gradient, *direction, *start, *old_gradient; /* 3 * stride each, as the coordinates */
    double *steps, *changes;                             /* MEMORY of them */
    double curvature[MEMORY];                            /* 1 / (step . change) */
} descent;

static double dot(size_t count, const double *a, const double *b) {
    double sums[8] = {0.0};
    for (size_t i = 0; i < count; ++i)
        sums[i % 8] += a[i] * b[i];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

/* Removes the radial part of a vector at each charge. */
static void make_tangent(const descent *d, double *vector) {
    const double *const x = d->x;
    const size_t s = d->stride;
    for (size_t i = 0; i < d->count; ++i) {
        const double along = vector[i] * x[i] + vector[s + i] * x[s + i] + vector[2 * s + i] * x[2 * s + i];
        vector[i] -= along * x[i];
        vector[s + i] -= along * x[s + i];
        vector[2 * s + i] -= along * x[2 * s + i];
    }
}

static double energy_and_gradient(descent *d) {
    memset(d->gradient, 0, 3 * d->stride * sizeof *d->gradient);
    const double energy = d->of->evaluate(d->of->context, d->gradient);
    make_tangent(d, d->gradient);
    return energy;
}

/* The direction of L-BFGS from the last `stored` steps; `next` - 1 is the newest. */
static void choose_direction(descent *d, size_t stored, size_t next) {
    const size_t size = 3 * d->stride;
    double factors[MEMORY];
    for (size_t i = 0; i < size; ++i)
        d->direction[i] = -d->gradient[i];
    for (size_t k = 0; k < stored; ++k) {
        const size_t m = (next + MEMORY - 1 - k) % MEMORY;
        factors[m] = d->curvature[m] * dot(size, d->steps + m * size, d->direction);
        for (size_t i = 0; i < size; ++i)
            d->direction[i] -= factors[m] * d->changes[m * size + i];
    }
    if (stored > 0) {
        const size_t m = (next + MEMORY - 1) % MEMORY;
        const double *const change = d->changes + m * size;
        const double scale = 1.0 / (d->curvature[m] * dot(size, change, change));
        for (size_t i = 0; i < size; ++i)
            d->direction[i] *= scale;
    }
    for (size_t k = stored; k-- > 0;) {
        const size_t m = (next + MEMORY - 1 - k) % MEMORY;
        const double factor = factors[m] - d->curvature[m] * dot(size, d->changes + m * size, d->direction);
        for (size_t i = 0; i < size; ++i)
            d->direction[i] += factor * d->steps[m * size + i];
    }
    make_tangent(d, d->direction);
}

/* Moves from `start` along the direction and projects back to the sphere. */
static void step_to(descent *d, double length) {
    double *const x = d->x;
    for (size_t i = 0; i < d->count; ++i) {
        double at[3], square = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            at[c] = d->start[c * d->stride + i] + length * d->direction[c * d->stride + i];
            square += at[c] * at[c];
        }
        const double norm = sqrt(square);
        for (size_t c = 0; c < 3; ++c)
            x[c * d->stride + i] = at[c] / norm;
    }
}

/* The longest move of a charge for a step of length 1. */
static double longest_move(const descent *d) {
    double longest = 0.0;
    for (size_t i = 0; i < d->count; ++i) {
        const double x = d->direction[i], y = d->direction[d->stride + i];
        const double z = d->direction[2 * d->stride + i];
        longest = fmax(longest, x * x + y * y + z * z);
    }
    return sqrt(longest);
}

/* A descent step by backtracking (Armijo); false, with no change, if there is none. No charge moves farther
 * than a third of the mean distance of neighbours. */
static bool search(descent *d, double slope, bool first, double *energy) {
    const size_t size = 3 * d->stride;
    memcpy(d->start, d->x, size * sizeof *d->start);
    memcpy(d->old_gradient, d->gradient, size * sizeof *d->gradient);
    const double reach = 1.0 / sqrt((double)d->count), move = longest_move(d);
    double length = first || move > reach ? (move > 0.0 ? reach / move : 1.0) : 1.0;
    const double before = *energy;
    for (int halving = 0; halving < HALVINGS; ++halving, length *= 0.5) {
        step_to(d, length);
        *energy = energy_and_gradient(d);
        if (*energy <= before + 1e-4 * length * slope)
            return true;
    }
    memcpy(d->x, d->start, size * sizeof *d->start);
    memcpy(d->gradient, d->old_gradient, size * sizeof *d->gradient);
    *energy = before;
    return false;
}

static double descend(descent *d) {
    const size_t size = 3 * d->stride;
    double energy = energy_and_gradient(d);
    size_t stored = 0, next = 0;
    for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
        choose_direction(d, stored, next);
        double slope = dot(size, d->gradient, d->direction);
        if (!(slope < 0.0)) {
            stored = 0;
            choose_direction(d, 0, next);
            slope = dot(size, d->gradient, d->direction);
        }
        const double before = energy;
        if (!(slope < 0.0) || !search(d, slope, stored == 0, &energy)) {
            if (stored == 0)
                break;
            stored = 0;
            continue;
        }
        if (before - energy <= least_fall * energy)
            break;
        double *const step = d->steps + next * size, *const change = d->changes + next * size;
        for (size_t i = 0; i < size; ++i) {
            step[i] = d->x[i] - d->start[i];
            change[i] = d->gradient[i] - d->old_gradient[i];
        }
        const double product = dot(size, step, change);
        if (product > 0.0) {
            d->curvature[next] = 1.0 / product;
            next = (next + 1) % MEMORY;
            stored += stored < MEMORY;
        }
    }
    return energy;
}

aur_result aur_sphere_descend(const aur_sphere_energy *of, size_t count, size_t stride, double *coordinates,
                              double *energy, aur_error *error) {
    const size_t size = 3 * stride;
    double *const room = calloc((4 + 2 * MEMORY) * size, sizeof *room);
    if (room == NULL)
        return aur_fail_memory(error);
    descent d = {.of = of,
                 .count = count,
                 .stride = stride,
                 .x = coordinates,
                 .gradient = room,
                 .direction = room + size,
                 .start = room + 2 * size,
                 .old_gradient = room + 3 * size,
                 .steps = room + 4 * size,
                 .changes = room + (4 + MEMORY) * size};
    *energy = descend(&d);
    free(room);
    return AUR_OK;
}
