/* The least energy of charges on the sphere, by L-BFGS (Nocedal 1980) with steps that end on the sphere. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/sphere/repulsion/repulsion.h"

enum { MEMORY = 12, ITERATIONS = 2000, HALVINGS = 30 };

/* Where the energy falls by less than this share in a step, it has arrived. */
static const double least_fall = 1e-14;

typedef struct descent {
    const aur_shells *shells;
    aur_charges *charges; /* coordinates in one block: x, y and z lie `stride` apart */
    aur_push_kernel *kernel;
    size_t stride;
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

static double pairs(size_t count) {
    return 0.5 * (double)count * (double)(count - 1);
}

/* Adds what charges of one range do to each other, times `factor`. */
static double add_range(descent *d, size_t first, size_t last, double factor) {
    double sum = 0.0;
    for (size_t i = first; i < last; ++i) {
        const aur_push push = d->kernel(d->charges, i, first, last);
        sum += push.energy;
        for (size_t c = 0; c < 3; ++c)
            d->gradient[c * d->stride + i] += factor * push.gradient[c];
    }
    return 0.5 * factor * sum;
}

/* Takes the part along each charge's own direction from a vector. */
static void make_tangent(const descent *d, double *vector) {
    const aur_charges *const q = d->charges;
    const size_t s = d->stride;
    for (size_t i = 0; i < q->count; ++i) {
        const double along = vector[i] * q->x[i] + vector[s + i] * q->y[i] + vector[2 * s + i] * q->z[i];
        vector[i] -= along * q->x[i];
        vector[s + i] -= along * q->y[i];
        vector[2 * s + i] -= along * q->z[i];
    }
}

static double energy_and_gradient(descent *d) {
    const size_t count = d->charges->count, shells = d->shells->count;
    memset(d->gradient, 0, 3 * d->stride * sizeof *d->gradient);
    const double share = shells > 1 ? 0.5 : 1.0;
    double energy = add_range(d, 0, count, share / pairs(count));
    for (size_t s = 0, first = 0; s < shells && shells > 1; first += d->shells->sizes[s], ++s)
        if (d->shells->sizes[s] > 1)
            energy += add_range(d, first, first + d->shells->sizes[s],
                                0.5 / ((double)shells * pairs(d->shells->sizes[s])));
    make_tangent(d, d->gradient);
    return energy;
}

/* The direction of L-BFGS from the last `kept` steps, of which `next` - 1 is the newest. */
static void choose_direction(descent *d, size_t kept, size_t next) {
    const size_t size = 3 * d->stride;
    double factors[MEMORY];
    for (size_t i = 0; i < size; ++i)
        d->direction[i] = -d->gradient[i];
    for (size_t k = 0; k < kept; ++k) {
        const size_t m = (next + MEMORY - 1 - k) % MEMORY;
        factors[m] = d->curvature[m] * dot(size, d->steps + m * size, d->direction);
        for (size_t i = 0; i < size; ++i)
            d->direction[i] -= factors[m] * d->changes[m * size + i];
    }
    if (kept > 0) {
        const size_t m = (next + MEMORY - 1) % MEMORY;
        const double *const change = d->changes + m * size;
        const double scale = 1.0 / (d->curvature[m] * dot(size, change, change));
        for (size_t i = 0; i < size; ++i)
            d->direction[i] *= scale;
    }
    for (size_t k = kept; k-- > 0;) {
        const size_t m = (next + MEMORY - 1 - k) % MEMORY;
        const double factor = factors[m] - d->curvature[m] * dot(size, d->changes + m * size, d->direction);
        for (size_t i = 0; i < size; ++i)
            d->direction[i] += factor * d->steps[m * size + i];
    }
    make_tangent(d, d->direction);
}

/* From `start` along the direction, back on the sphere. */
static void step_to(descent *d, double length) {
    aur_charges *const q = d->charges;
    for (size_t i = 0; i < q->count; ++i) {
        double at[3], square = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            at[c] = d->start[c * d->stride + i] + length * d->direction[c * d->stride + i];
            square += at[c] * at[c];
        }
        const double norm = sqrt(square);
        q->x[i] = at[0] / norm;
        q->y[i] = at[1] / norm;
        q->z[i] = at[2] / norm;
    }
}

/* The longest move of a charge for a step of length 1. */
static double longest_move(const descent *d) {
    double longest = 0.0;
    for (size_t i = 0; i < d->charges->count; ++i) {
        const double x = d->direction[i], y = d->direction[d->stride + i];
        const double z = d->direction[2 * d->stride + i];
        longest = fmax(longest, x * x + y * y + z * z);
    }
    return sqrt(longest);
}

/* A step downhill by halving (Armijo); false where there is none, and then nothing has moved. No charge moves
 * farther than a third of the mean distance of neighbours. */
static bool search(descent *d, double slope, bool first, double *energy) {
    const size_t size = 3 * d->stride;
    memcpy(d->start, d->charges->x, size * sizeof *d->start);
    memcpy(d->old_gradient, d->gradient, size * sizeof *d->gradient);
    const double reach = 1.0 / sqrt((double)d->charges->count), move = longest_move(d);
    double length = first || move > reach ? (move > 0.0 ? reach / move : 1.0) : 1.0;
    const double before = *energy;
    for (int halving = 0; halving < HALVINGS; ++halving, length *= 0.5) {
        step_to(d, length);
        *energy = energy_and_gradient(d);
        if (*energy <= before + 1e-4 * length * slope)
            return true;
    }
    memcpy(d->charges->x, d->start, size * sizeof *d->start);
    memcpy(d->gradient, d->old_gradient, size * sizeof *d->gradient);
    *energy = before;
    return false;
}

static double descend(descent *d) {
    const size_t size = 3 * d->stride;
    double energy = energy_and_gradient(d);
    size_t kept = 0, next = 0;
    for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
        choose_direction(d, kept, next);
        double slope = dot(size, d->gradient, d->direction);
        if (!(slope < 0.0)) {
            kept = 0;
            choose_direction(d, 0, next);
            slope = dot(size, d->gradient, d->direction);
        }
        const double before = energy;
        if (!(slope < 0.0) || !search(d, slope, kept == 0, &energy)) {
            if (kept == 0)
                break;
            kept = 0;
            continue;
        }
        if (before - energy <= least_fall * energy)
            break;
        double *const step = d->steps + next * size, *const change = d->changes + next * size;
        for (size_t i = 0; i < size; ++i) {
            step[i] = d->charges->x[i] - d->start[i];
            change[i] = d->gradient[i] - d->old_gradient[i];
        }
        const double product = dot(size, step, change);
        if (product > 0.0) {
            d->curvature[next] = 1.0 / product;
            next = (next + 1) % MEMORY;
            kept += kept < MEMORY;
        }
    }
    return energy;
}

aur_result aur_repel(const aur_shells *shells, aur_charges *charges, double *energy, aur_error *error) {
    *energy = 0.0;
    if (charges->count < 2)
        return AUR_OK;
    const size_t stride = (size_t)(charges->y - charges->x), size = 3 * stride;
    double *const room = calloc((4 + 2 * MEMORY) * size, sizeof *room);
    if (room == NULL)
        return aur_fail_memory(error);
    descent d = {.shells = shells,
                 .charges = charges,
                 .kernel = AUR_KERNEL_HERE(aur_push),
                 .stride = stride,
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

static void exchange(double *values, size_t a, size_t b) {
    const double kept = values[a];
    values[a] = values[b];
    values[b] = kept;
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
