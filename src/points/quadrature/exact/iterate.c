/* Conjugate gradients on A D A' x = b - A near, D the weights to approximate; w = near + D A' x. For uniform
 * sets the matrix is close to the identity, unless there are hardly more points than functions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parallel.h"
#include "points/quadrature/exact/fast.h"
#include "points/quadrature/exact/system.h"

/* From this number of points and degrees on fast transforms are used. */
enum { FAST_POINTS = 2048, FAST_DEGREE = 24 };

/* The number of restarts with the exact residual, and the criterion of stagnation: a small residual that this
 * many steps do not halve is rounding. */
enum { PASSES = 3, PATIENCE = 20 };
static const double small = 1e-12;

typedef struct gradients {
    const aur_exact_system *system;
    aur_transform transform;
    aur_fast_transform *fast;             /* NULL: `transform` is used */
    size_t size, limit;                   /* of coefficients; of steps */
    double *rest, *direction, *image, *t; /* t is of points */
    double *storage;
    size_t steps; /* taken so far */
} gradients;

/* Within a step the progress is that of its beginning. */
static int report(void *user, const char *what, uint64_t done, uint64_t total) {
    const gradients *const g = user;
    (void)what, (void)done, (void)total;
    return g->system->progress.function(g->system->progress.user, "solving", g->steps, g->limit);
}

static aur_progress progress_of(gradients *g) {
    return g->system->progress.function != NULL ? (aur_progress){.function = report, .user = g}
                                                : (aur_progress){0};
}

static double square(size_t count, const double *a, const double *b) {
    double sum[8] = {0};
    for (size_t i = 0; i < count; ++i)
        sum[i % 8] += a[i] * b[i];
    return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

static aur_result analyse(const gradients *g, const double *weights, double *coefficients, aur_error *error) {
    if (g->system->space != NULL)
        return aur_exact_space_analyse(g->system->space, g->size, weights, coefficients, error);
    return g->fast != NULL ? aur_fast_transform_analyse(g->fast, weights, coefficients, error)
                           : aur_transform_analyse(&g->transform, weights, coefficients, error);
}

static aur_result synthesise(const gradients *g, const double *coefficients, double *values,
                             aur_error *error) {
    if (g->system->space != NULL)
        return aur_exact_space_synthesise(g->system->space, g->size, coefficients, values, error);
    return g->fast != NULL ? aur_fast_transform_synthesise(g->fast, coefficients, values, error)
                           : aur_transform_synthesise(&g->transform, coefficients, values, error);
}

/* rest = b - A w. */
static aur_result find_rest(const gradients *g, const double *weights, aur_error *error) {
    const aur_result result = analyse(g, weights, g->rest, error);
    for (size_t j = 0; j < g->size; ++j)
        g->rest[j] = (j == 0 ? 1.0 : 0.0) - g->rest[j];
    return result;
}

static double largest_rest(const gradients *g) {
    double largest = 0.0;
    for (size_t j = 0; j < g->size; ++j)
        largest = fmax(largest, fabs(g->rest[j]));
    return largest;
}

static aur_result descend(gradients *g, double *weights, size_t *steps, aur_error *error) {
    const aur_exact_system *const system = g->system;
    memcpy(g->direction, g->rest, g->size * sizeof *g->direction);
    double rest = square(g->size, g->rest, g->rest), least = rest;
    size_t last = *steps; /* when `least` was half of the one before */
    while (largest_rest(g) > system->tolerance && *steps < g->limit &&
           (rest > small * small || *steps - last < PATIENCE)) {
        const aur_progress progress = progress_of(g);
        g->steps = *steps;
        if (aur_progress_stops(&progress, NULL, 0, 0))
            return aur_fail(error, AUR_ERROR_CANCELLED, "solving: cancelled");
        aur_result result = synthesise(g, g->direction, g->t, error);
        for (size_t i = 0; i < system->points.count; ++i)
            g->t[i] *= system->near[i];
        if (result == AUR_OK)
            result = analyse(g, g->t, g->image, error);
        if (result != AUR_OK)
            return result;
        ++*steps;
        const double curvature = square(g->size, g->direction, g->image);
        if (!(curvature > 1e-14 * square(g->size, g->direction, g->direction)))
            return AUR_OK; /* the residual cannot be reduced by weights */
        const double length = rest / curvature;
        for (size_t i = 0; i < system->points.count; ++i)
            weights[i] += length * g->t[i];
        for (size_t j = 0; j < g->size; ++j)
            g->rest[j] -= length * g->image[j];
        const double next = square(g->size, g->rest, g->rest);
        for (size_t j = 0; j < g->size; ++j)
            g->direction[j] = g->rest[j] + next / rest * g->direction[j];
        rest = next;
        if (rest < 0.25 * least) {
            least = rest;
            last = *steps;
        }
    }
    return AUR_OK;
}

static aur_result solve(gradients *g, double *weights, aur_exact_found *found, aur_error *error) {
    memcpy(weights, g->system->near, g->system->points.count * sizeof *weights);
    aur_result result = find_rest(g, weights, error);
    for (int pass = 0; pass < PASSES && result == AUR_OK && largest_rest(g) > g->system->tolerance; ++pass) {
        result = descend(g, weights, &found->iterations, error);
        if (result == AUR_OK)
            result = find_rest(g, weights, error);
    }
    found->residual = largest_rest(g);
    found->exact = found->residual <= fmax(AUR_EXACT_TOLERANCE, g->system->tolerance);
    return result;
}

/* The transforms to a degree, and memory for the steps. */
static aur_result open_gradients(const aur_exact_system *system, size_t degree, aur_basis *basis,
                                 gradients *g, aur_error *error) {
    aur_exact_space *const space = system->space;
    *basis = (aur_basis){0};
    const aur_result result = space != NULL
                                  ? aur_exact_space_fill(space, degree, error)
                                  : aur_basis_create(degree, system->lowest, system->exponent, basis, error);
    if (result != AUR_OK)
        return result;
    const size_t size = space != NULL ? aur_exact_space_size(space, degree) : aur_coefficient_count(degree);
    const size_t room = space != NULL ? 0 : AUR_TRANSFORM_BANDS * aur_transform_room(degree);
    *g = (gradients){.system = system,
                     .transform = {.basis = basis, .points = &system->points, .threads = system->threads},
                     .size = size,
                     .storage = malloc((room + 3 * size + system->points.count) * sizeof(double))};
    if (g->storage == NULL) {
        aur_basis_release(basis);
        return aur_fail_memory(error);
    }
    g->transform.sums = g->storage;
    g->transform.progress = progress_of(g);
    g->rest = g->storage + room;
    g->direction = g->rest + size;
    g->image = g->direction + size;
    g->t = g->image + size;
    return AUR_OK;
}

aur_result aur_exact_iterate(const aur_exact_system *system, size_t degree, size_t steps, double *weights,
                             aur_exact_found *found, aur_error *error) {
    aur_basis basis;
    gradients g;
    aur_result result = open_gradients(system, degree, &basis, &g, error);
    if (result != AUR_OK)
        return result;
    *found = (aur_exact_found){.degree = degree};
    g.limit = steps;
    const bool fast = system->space == NULL && system->lowest == -1.0 &&
                      system->points.count >= FAST_POINTS && degree >= FAST_DEGREE;
    if (fast)
        result = aur_fast_transform_create(&basis, &system->points, system->threads, progress_of(&g), &g.fast,
                                           error);
    if (result == AUR_OK)
        result = solve(&g, weights, found, error);
    aur_fast_transform_destroy(g.fast);
    aur_exact_positive(system, weights, found);
    free(g.storage);
    aur_basis_release(&basis);
    return result;
}

aur_result aur_exact_residual(const aur_exact_system *system, size_t degree, const double *weights,
                              aur_exact_found *found, aur_error *error) {
    aur_basis basis;
    gradients g;
    aur_result result = open_gradients(system, degree, &basis, &g, error);
    if (result != AUR_OK)
        return result;
    result = find_rest(&g, weights, error);
    found->residual = largest_rest(&g);
    free(g.storage);
    aur_basis_release(&basis);
    return result;
}

size_t aur_exact_functions(const aur_exact_system *system, size_t degree) {
    return system->space != NULL ? aur_exact_space_size(system->space, degree) : (degree + 1) * (degree + 1);
}

bool aur_exact_factoring_stops(const aur_progress *progress, aur_exact_factoring *factoring, size_t at,
                               size_t end) {
    const double done = pow((double)at, 4.0), left = end > 0 ? pow((double)end, 4.0) - done : INFINITY;
    return progress->function != NULL && aur_progress_report_work(progress, "factoring", &factoring->share,
                                                                  factoring->earlier + done, left) != 0;
}

bool aur_exact_positive(const aur_exact_system *system, const double *weights, aur_exact_found *found) {
    found->least = INFINITY;
    found->largest = -INFINITY;
    for (size_t i = 0; i < system->points.count; ++i)
        if (system->near[i] > 0.0) {
            found->least = fmin(found->least, weights[i]);
            found->largest = fmax(found->largest, weights[i]);
        }
    return found->least > 0.0;
}
