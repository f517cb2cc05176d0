/* Which weights suit which integrand: equal, optimal (Marques 2018), areas of Voronoi cells, and exact to the
 * largest degree, on the whole sphere, as relative root mean square errors over axes and scramblings. */
#include <aureole/exact.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <math.h>
#include <stdlib.h>

#include "integrands.h"
#include "program/lab/lab.h"

enum { LARGEST = 1024, EQUAL = 0, OPTIMAL, VORONOI, EXACT, SMOOTH, SMOOTHEST, METHODS, AXES = 64 };

/* Of the kernels of the optimal weights. */
enum { KERNELS = 3 };
static const double smoothness[KERNELS] = {1.5, 2.5, 3.5};
static const size_t methods[KERNELS] = {OPTIMAL, SMOOTH, SMOOTHEST};

static const char *const columns[] = {"set",   "n",      "integrand",   "equal",       "optimal", "voronoi",
                                      "exact", "degree", "optimal_2.5", "optimal_3.5", NULL};

typedef struct weighed {
    size_t count;
    double *xyz, *weights[METHODS];
    size_t degree; /* summed over the seeds */
    double squares[LAB_CLASSES][METHODS];
} weighed;

/* Whether a set has no randomised forms, as native sets of the sphere. */
static bool is_fixed(const char *set) {
    const aur_set_description *const row = aur_set_find(set);
    return row != NULL && row->dimensions[0] == 3;
}

static aur_result draw(const char *set, size_t count, uint64_t seed, double *xyz, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    options.scramble = is_fixed(set) || strcmp(set, "random") == 0 ? AUR_SCRAMBLE_NONE : AUR_SCRAMBLE_OWEN;
    options.seed = seed;
    aur_directions *directions;
    aur_result result = aur_directions_create(set, &options, &directions, error);
    if (result != AUR_OK && options.scramble == AUR_SCRAMBLE_OWEN) {
        options.scramble = AUR_SCRAMBLE_SHIFT; /* lattices and files have no digits to scramble */
        result = aur_directions_create(set, &options, &directions, error);
    }
    if (result != AUR_OK)
        return result;
    result = aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, error);
    aur_directions_destroy(directions);
    return result;
}

static aur_result weigh(weighed *w, const aur_potential *const *potentials, size_t threads,
                        aur_error *error) {
    const size_t n = w->count;
    for (size_t i = 0; i < n; ++i)
        w->weights[EQUAL][i] = 1.0 / (double)n;
    aur_measure_options measure = {.size = sizeof measure};
    aur_measure_options_init(&measure, NULL);
    measure.threads = threads;
    aur_exact_options exact = {.size = sizeof exact};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &exact, NULL);
    exact.threads = threads;
    aur_exact_report report = {0};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < KERNELS && result == AUR_OK; ++k)
        result = aur_weights_solve(n, w->xyz, 1, potentials + k, NULL, n, w->weights[methods[k]], NULL, NULL,
                                   error);
    if (result == AUR_OK)
        result =
            aur_weights_voronoi(n, w->xyz, AUR_DOMAIN_SPHERE, NULL, &measure, n, w->weights[VORONOI], error);
    if (result == AUR_OK)
        result = aur_weights_exact(n, w->xyz, &exact, n, w->weights[EXACT], &report, error);
    w->degree += report.degree;
    return result;
}

/* Adds the squared relative errors for the axes of one seed. */
static void judge(weighed *w, uint64_t seed) {
    const double sphere = 4.0 * 3.14159265358979323846;
    for (lab_class kind = LAB_SMOOTH; kind < LAB_CLASSES; ++kind)
        for (uint64_t axis = 0; axis < AXES; ++axis) {
            const lab_integrand integrand = lab_integrand_make(kind, seed * AXES + axis);
            double sums[METHODS] = {0};
            for (size_t i = 0; i < w->count; ++i) {
                const double value = lab_integrand_value(&integrand, w->xyz + 3 * i);
                for (size_t k = 0; k < METHODS; ++k)
                    sums[k] += w->weights[k][i] * value;
            }
            for (size_t k = 0; k < METHODS; ++k) {
                const double error = sphere * sums[k] / lab_integrand_integral(&integrand) - 1.0;
                w->squares[kind][k] += error * error;
            }
        }
}

static aur_result study(lab_run *run, const char *set, weighed *w, const aur_potential *const *potentials,
                        aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    const uint64_t seeds = quick ? 2 : 16;
    w->degree = 0;
    memset(w->squares, 0, sizeof w->squares);
    aur_result result = AUR_OK;
    for (uint64_t seed = 0; seed < seeds && result == AUR_OK; ++seed) {
        if (seed == 0 || !is_fixed(set)) {
            result = draw(set, w->count, seed, w->xyz, error);
            if (result == AUR_OK)
                result = weigh(w, potentials, lab_run_options(run)->threads, error);
        }
        if (result == AUR_OK)
            judge(w, seed);
    }
    const size_t forms = is_fixed(set) ? 1 : (size_t)seeds;
    for (lab_class kind = LAB_SMOOTH; kind < LAB_CLASSES && result == AUR_OK; ++kind) {
        lab_text(run, set);
        lab_number(run, (double)w->count);
        lab_text(run, lab_class_name(kind));
        for (size_t k = 0; k < METHODS; ++k) {
            lab_number(run, sqrt(w->squares[kind][k] / (double)(seeds * AXES)));
            if (k == EXACT)
                lab_number(run, (double)w->degree / (double)forms);
        }
    }
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    density.kind = AUR_DENSITY_SPHERE;
    aur_potential *potentials[KERNELS] = {NULL};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < KERNELS && result == AUR_OK; ++k)
        result = aur_potential_create(&density, smoothness[k], &potentials[k], error);
    double *const room = malloc((3 + METHODS) * LARGEST * sizeof *room);
    if (result == AUR_OK && room == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    weighed w = {.xyz = room};
    for (size_t k = 0; k < METHODS && room != NULL; ++k)
        w.weights[k] = room + (3 + k) * LARGEST;
    const char *const sets[] = {"random", "sobol", "spherical-fibonacci", lab_run_options(run)->set};
    for (size_t i = 0; i < 4 && sets[i] != NULL; ++i)
        for (w.count = 64; w.count <= LARGEST && result == AUR_OK; w.count *= 4)
            if (w.count < LARGEST || !lab_run_options(run)->quick)
                result = lab_forgive(run, sets[i],
                                     study(run, sets[i], &w, (const aur_potential *const *)potentials, error),
                                     error);
    free(room);
    for (size_t k = 0; k < KERNELS; ++k)
        aur_potential_destroy(potentials[k]);
    return result;
}

static const report_plot plots[] = {
    {.name = "equal",
     .title = "Relative RMSE with equal weights against the number of points",
     .x = "n",
     .y = "equal",
     .series = "set",
     .panel = "integrand",
     .log_x = true,
     .log_y = true},
    {.name = "optimal",
     .title = "Relative RMSE with optimal weights against the number of points",
     .x = "n",
     .y = "optimal",
     .series = "set",
     .panel = "integrand",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_weights_choosing = {
    .name = "weights-choosing",
    .reproduces = "docs/choosing.md",
    .summary =
        "equal, optimal, Voronoi and exact weights for smooth, clipped, discontinuous and spiky integrands",
    .columns = columns,
    .seconds = 5,
    .quick_seconds = 0.1,
    .plots = plots,
    .run = run,
};
