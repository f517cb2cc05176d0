/* A lower bound of the star discrepancy in any dimension by threshold accepting (Winker and Fang 1997, with
 * the snapping to critical boxes of Gnewuch, Wahlstroem and Winzen 2012): every value is that of a box, so
 * that the best one is a bound. Each trial is a pure function of the seed and its index. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/quality/measure.h"

enum { ATTEMPTS = 16, DEFAULT_STEPS = 4096 };

typedef struct walk {
    const aur_points_view *points;
    const double *sorted; /* dimension * (count + 1): the coordinates in order, and 1 */
    size_t steps;
    uint64_t seed;
    double *best; /* one per trial */
} walk;

typedef struct box {
    double *upper; /* dimension */
    double *low;   /* the box shrunk to the points inside */
    double *high;  /* the box grown until it meets the next points */
} box;

static double volume(const double *upper, size_t dimension) {
    double product = 1.0;
    for (size_t d = 0; d < dimension; ++d)
        product *= upper[d];
    return product;
}

/* The greater of: the mass in the closed box less its volume once it is shrunk to the points inside; the
 * volume less the mass in the open box once it is grown along each axis in turn until a point would enter. */
static double difference(const walk *w, const box *b) {
    const size_t dimension = w->points->dimension;
    double closed = 0.0, open = 0.0;
    memset(b->low, 0, dimension * sizeof *b->low);
    for (size_t i = 0; i < w->points->count; ++i) {
        const double *const x = aur_point_at(w->points, i);
        int in_closed = 1, in_open = 1;
        for (size_t d = 0; d < dimension && in_closed; ++d) {
            in_closed = x[d] <= b->upper[d];
            in_open &= x[d] < b->upper[d];
        }
        if (!in_closed)
            continue;
        closed += w->points->weights[i];
        open += in_open ? w->points->weights[i] : 0.0;
        for (size_t d = 0; d < dimension; ++d)
            b->low[d] = fmax(b->low[d], x[d]);
    }
    const double grown_from = volume(b->upper, dimension) - open;
    const double shrunk = closed > 0.0 ? closed - volume(b->low, dimension) : 0.0;
    return fmax(shrunk, grown_from);
}

/* Grows the best box along each axis while no point enters; the value of the open box. */
static double grow(const walk *w, const box *b) {
    const size_t dimension = w->points->dimension;
    memcpy(b->high, b->upper, dimension * sizeof *b->high);
    double open = 0.0;
    for (size_t d = 0; d < dimension; ++d) {
        double limit = 1.0;
        for (size_t i = 0; i < w->points->count; ++i) {
            const double *const x = aur_point_at(w->points, i);
            int inside = 1;
            for (size_t e = 0; e < dimension && inside; ++e)
                inside = e == d || x[e] < b->high[e];
            if (inside && x[d] >= b->high[d])
                limit = fmin(limit, x[d]);
        }
        b->high[d] = limit;
    }
    for (size_t i = 0; i < w->points->count; ++i) {
        int inside = 1;
        for (size_t d = 0; d < dimension && inside; ++d)
            inside = aur_point_at(w->points, i)[d] < b->high[d];
        open += inside ? w->points->weights[i] : 0.0;
    }
    return volume(b->high, dimension) - open;
}

typedef struct dice {
    uint64_t seed, attempt, counter;
} dice;

static size_t throw(dice * d, size_t sides) {
    const size_t side =
        (size_t)(aur_unit_double(aur_hash3(d->seed, d->attempt, d->counter++)) * (double)sides);
    return side < sides ? side : sides - 1;
}

/* Moves a few axes by up to `reach` places among the sorted coordinates. */
static void move(const walk *w, dice *random, const size_t *from, size_t reach, size_t *to) {
    const size_t dimension = w->points->dimension, count = w->points->count;
    memcpy(to, from, dimension * sizeof *to);
    const size_t changes = 1 + throw(random, dimension < 3 ? dimension : 3);
    for (size_t c = 0; c < changes; ++c) {
        const size_t axis = throw(random, dimension);
        const size_t low = from[axis] > reach ? from[axis] - reach : 0;
        const size_t high = from[axis] + reach < count ? from[axis] + reach : count;
        to[axis] = low + throw(random, high - low + 1);
    }
}

static double value_at(const walk *w, const size_t *indices, const box *b) {
    const size_t dimension = w->points->dimension, stride = w->points->count + 1;
    for (size_t d = 0; d < dimension; ++d)
        b->upper[d] = w->sorted[d * stride + indices[d]];
    return difference(w, b);
}

static double run_walk(const walk *w, size_t attempt, const box *b, size_t *here, size_t *there) {
    const size_t dimension = w->points->dimension, count = w->points->count;
    dice random = {w->seed, attempt, 0};
    /* Large boxes hold most of the differences in many dimensions: start with volumes spread evenly. */
    for (size_t d = 0; d < dimension; ++d) {
        const double side =
            pow(aur_unit_double(aur_hash3(w->seed, attempt, random.counter++)), 1.0 / (double)dimension);
        here[d] = (size_t)(side * (double)count);
    }
    double current = value_at(w, here, b);
    double best = fmax(current, grow(w, b));
    for (size_t step = 0; step < w->steps; ++step) {
        const double left = 1.0 - (double)step / (double)w->steps;
        const size_t reach = 1 + (size_t)(0.25 * left * (double)count);
        move(w, &random, here, reach, there);
        const double next = value_at(w, there, b);
        if (next > best)
            best = fmax(next, grow(w, b));
        /* The threshold falls to zero: a worse box is accepted early only. */
        if (next >= current - 0.25 * best * left * left) {
            memcpy(here, there, dimension * sizeof *here);
            current = next;
        }
    }
    return best;
}

static aur_result do_attempt(void *context, size_t attempt) {
    const walk *const w = context;
    const size_t dimension = w->points->dimension;
    double *const sides = malloc(3 * dimension * sizeof *sides);
    size_t *const indices = malloc(2 * dimension * sizeof *indices);
    const aur_result result = sides != NULL && indices != NULL ? AUR_OK : AUR_ERROR_MEMORY;
    if (result == AUR_OK) {
        const box b = {sides, sides + dimension, sides + 2 * dimension};
        w->best[attempt] = run_walk(w, attempt, &b, indices, indices + dimension);
    }
    free(sides);
    free(indices);
    return result;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The coordinates of each axis in order, with 1 at the end. */
static double *tabulate(const aur_points_view *points, aur_arena *arena) {
    const size_t count = points->count, dimension = points->dimension;
    double *const table = aur_arena_allocate(arena, dimension * (count + 1) * sizeof *table);
    for (size_t d = 0; d < dimension && table != NULL; ++d) {
        double *const axis = table + d * (count + 1);
        for (size_t i = 0; i < count; ++i)
            axis[i] = aur_point_at(points, i)[d];
        axis[count] = 1.0;
        qsort(axis, count, sizeof *axis, ascending);
    }
    return table;
}

static aur_result star_bound(const aur_measure_request *request, double *value, aur_error *error) {
    double steps;
    aur_result result = aur_measure_number(request, 1.0, 1e9, DEFAULT_STEPS, &steps, error);
    if (result != AUR_OK)
        return result;
    double best[ATTEMPTS] = {0};
    double *const table = tabulate(request->points, request->arena);
    if (table == NULL)
        return aur_fail_memory(error);
    walk w = {request->points, table, (size_t)steps, request->options.seed, best};
    result = aur_measure_items(&request->options, "trying boxes", ATTEMPTS, do_attempt, &w,
                               (aur_parallel_slice){best, sizeof *best, sizeof best}, error);
    *value = 0.0;
    for (size_t i = 0; i < ATTEMPTS; ++i)
        *value = fmax(*value, best[i]);
    return result;
}

const aur_measure_row aur_measure_star_bound = {
    {.row = {.name = "star-bound",
             .summary = "lower bound of the star discrepancy by threshold accepting, STEPS (4096) boxes in "
                        "each of 16 walks",
             .source = "Winker and Fang 1997; Gnewuch, Wahlström and Winzen 2012"},
     .parameter = "[:STEPS]",
     .domains = "square, cube",
     .bound = true},
    .masses = 1,
    .compute = star_bound};
