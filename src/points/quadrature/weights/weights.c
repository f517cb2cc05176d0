/* Optimal weights of one merged set for any number of densities (Marques 2018 sections 4.3 and 5.3). */

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/linear/solve.h"
#include "points/quadrature/check.h"
#include "points/quadrature/potential/potential.h"

/* Samples whose kernel values differ by less than the rounding of the matrix are coincident. */
static const double coincident = 1e-13;

typedef struct weights_system {
    aur_weights_options options;
    size_t potential_count;
    const aur_potential *const *potentials;
    const aur_kernel_rule *rule;
    size_t count;         /* samples in the system */
    size_t *sample;       /* their indices among all samples */
    double *xyz;          /* 3 * count */
    double *columns;      /* 3 * count */
    double *matrix;       /* count * count; the lower triangle is filled */
    double *right, *ones; /* potential_count * count: z of each density, followed by `count` ones */
    double *z;            /* potential_count * count, stored for the report */
    size_t *group;        /* count: the group of coincident samples, below group_count */
    size_t *group_size;   /* count */
    size_t *first;        /* count: the first sample of each group */
    size_t group_count;
    double pair_sum; /* of all entries of K */
    void *storage;
} weights_system;

static aur_result allocate(weights_system *system, size_t count, aur_error *error) {
    const aur_result result = aur_check_system_size(count, error);
    if (result != AUR_OK)
        return result;
    const size_t each = system->potential_count * count, doubles = 7 * count + 2 * each;
    system->storage = malloc(doubles * sizeof(double) + 4 * count * sizeof(size_t));
    system->matrix = malloc(count * count * sizeof *system->matrix);
    if (system->storage == NULL || system->matrix == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory: the weights of %zu samples take %.3g GB",
                        count, 1e-9 * (double)count * (double)count * sizeof(double));
    system->xyz = system->storage;
    system->columns = system->xyz + 3 * count;
    system->z = system->columns + 3 * count;
    system->right = system->z + each;
    system->sample = (size_t *)(void *)(system->xyz + doubles);
    system->group = system->sample + count;
    system->group_size = system->group + count;
    system->first = system->group_size + count;
    return AUR_OK;
}

/* Fills K and returns whether two samples are coincident. */
static bool assemble(weights_system *system) {
    const size_t n = system->count;
    const aur_columns columns = aur_columns_split(n, system->xyz, system->columns);
    const double limit = system->rule->top * (1.0 - coincident);
    bool shared = false;
    system->pair_sum = 0.0;
    for (size_t i = 0; i < n; ++i) {
        double *const row = system->matrix + i * n;
        aur_kernel_row(system->rule, system->xyz + 3 * i, i, columns, row);
        double lanes[8] = {0}, largest[8] = {0};
        size_t j = 0;
        for (; j + 8 <= i; j += 8) {
            for (size_t lane = 0; lane < 8; ++lane) {
                lanes[lane] += row[j + lane];
                largest[lane] = largest[lane] > row[j + lane] ? largest[lane] : row[j + lane];
            }
        }
        for (; j < i; ++j) {
            lanes[j % 8] += row[j];
            largest[j % 8] = largest[j % 8] > row[j] ? largest[j % 8] : row[j];
        }
        double sum = 0.0;
        for (size_t lane = 0; lane < 8; ++lane) {
            sum += lanes[lane];
            shared = shared || largest[lane] >= limit;
        }
        row[i] = system->rule->top;
        system->pair_sum += 2.0 * sum + system->rule->top;
        system->group[i] = i;
        system->group_size[i] = 1;
    }
    system->group_count = n;
    return shared;
}

/* One unknown for each group of coincident samples: c samples that share the weight W add sigma W^2 / c to
 * the objective. The first sample represents its group. */
static void merge(weights_system *system) {
    const size_t n = system->count;
    const double limit = system->rule->top * (1.0 - coincident);
    size_t *const first = system->first;
    size_t groups = 0;
    for (size_t i = 0; i < n; ++i) {
        const double *const row = system->matrix + i * n;
        size_t at = 0;
        while (at < groups && row[first[at]] < limit)
            ++at;
        system->group[i] = at;
        if (at < groups) {
            ++system->group_size[at];
        } else {
            first[groups] = i;
            system->group_size[groups++] = 1;
        }
    }
    /* In place: the write position never passes the read position. */
    for (size_t g = 0; g < groups; ++g)
        for (size_t h = 0; h <= g; ++h)
            system->matrix[g * groups + h] = system->matrix[first[g] * n + first[h]];
    for (size_t k = 0; k < system->potential_count; ++k)
        for (size_t g = 0; g < groups; ++g)
            system->right[k * groups + g] = system->z[k * n + first[g]];
    system->group_count = groups;
}

/* Chooses the samples in the system and fills the system. */
static aur_result prepare(weights_system *system, size_t count, const double *xyz, aur_error *error) {
    bool hides = false;
    for (size_t k = 0; k < system->potential_count; ++k)
        hides = hides || aur_potential_hides(system->potentials[k]);
    for (size_t i = 0; i < count; ++i) {
        if (hides && xyz[3 * i + 2] < 0.0)
            continue;
        memcpy(system->xyz + 3 * system->count, xyz + 3 * i, 3 * sizeof *xyz);
        system->sample[system->count++] = i;
    }
    const size_t n = system->count;
    if (n == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no sample lies above the surface");
    for (size_t k = 0; k < system->potential_count; ++k)
        aur_potential_evaluate(system->potentials[k], n, system->xyz, system->z + k * n);
    memcpy(system->right, system->z, system->potential_count * n * sizeof *system->right);
    if (assemble(system))
        merge(system);
    system->ones = system->right + system->potential_count * system->group_count;
    for (size_t g = 0; g < system->group_count; ++g) {
        system->ones[g] = 1.0;
        system->matrix[g * system->group_count + g] +=
            system->options.regularization / (double)system->group_size[g];
    }
    return AUR_OK;
}

/* From the solution of the system to the weights of density k. */
static void distribute(const weights_system *system, size_t k, double *weights, aur_weights_report *report) {
    double *const solution = system->right + k * system->group_count;
    const double *const z = system->z + k * system->count;
    const double multiplier =
        system->options.sum_constraint ? aur_constrain_sum(system->group_count, solution, system->ones) : 0.0;
    double total = 0.0, linear = 0.0, squares = 0.0, plain = 0.0;
    for (size_t i = 0; i < system->count; ++i) {
        const size_t g = system->group[i];
        const double weight = solution[g] / (double)system->group_size[g];
        weights[system->sample[i]] = weight;
        total += weight;
        linear += weight * z[i];
        plain += z[i];
        squares += weight * weight;
    }
    if (report == NULL)
        return;
    const double n = (double)system->count;
    const double self = aur_potential_self_energy(system->potentials[k]);
    /* (K + sigma) W = Z - multiplier, so W'KW needs no matrix. */
    const double pairs = linear - multiplier * total - system->options.regularization * squares;
    *report = (aur_weights_report){.equal_error =
                                       sqrt(fmax(0.0, system->pair_sum / (n * n) - 2.0 * plain / n + self)),
                                   .optimal_error = sqrt(fmax(0.0, pairs - 2.0 * linear + self)),
                                   .weight_sum = total,
                                   .visible = system->count};
}

static aur_result check(size_t count, const double *xyz, size_t potential_count,
                        const aur_potential *const *potentials, aur_error *error) {
    if (count == 0 || potential_count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "weights need at least one sample and one density");
    for (size_t k = 1; k < potential_count; ++k)
        if (aur_potential_smoothness(potentials[k]) != aur_potential_smoothness(potentials[0]))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "the densities have different smoothness: %g and %g",
                            aur_potential_smoothness(potentials[0]), aur_potential_smoothness(potentials[k]));
    return aur_check_directions(count, xyz, error);
}

aur_result aur_weights_solve(size_t count, const double *xyz, size_t potential_count,
                             const aur_potential *const *potentials, const aur_weights_options *options,
                             size_t capacity, double *weights, aur_weights_report *reports, double *condition,
                             aur_error *error) {
    aur_weights_options copy = {.size = sizeof copy};
    aur_weights_options_init(&copy, NULL);
    aur_result result = aur_weights_options_read(options, &copy, error);
    if (result == AUR_OK)
        result = check(count, xyz, potential_count, potentials, error);
    if (result == AUR_OK)
        result = aur_check_capacity(count, capacity / potential_count, error);
    if (result != AUR_OK)
        return result;
    weights_system system = {.options = copy,
                             .potential_count = potential_count,
                             .potentials = potentials,
                             .rule = &potentials[0]->rule};
    result = allocate(&system, count, error);
    if (result == AUR_OK)
        result = prepare(&system, count, xyz, error);
    if (result == AUR_OK)
        result = aur_solve_positive(system.group_count, system.matrix,
                                    potential_count + (copy.sum_constraint ? 1 : 0), system.right, condition,
                                    error);
    if (result == AUR_OK)
        memset(weights, 0, potential_count * count * sizeof *weights);
    for (size_t k = 0; k < potential_count && result == AUR_OK; ++k)
        distribute(&system, k, weights + k * count, reports != NULL ? &reports[k] : NULL);
    free(system.storage);
    free(system.matrix);
    return result;
}

static aur_result weigh(const aur_directions_options *points, const aur_weights_options *options,
                        const double *xyz, double *weights, aur_error *error) {
    const size_t count = (size_t)points->count;
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    aur_potential *potential = NULL;
    aur_result result = aur_density_from_lobe(&points->lobe, points->domain, &density, error);
    if (result == AUR_OK)
        result = aur_potential_create(&density, points->smoothness, &potential, error);
    const aur_potential *const one = potential;
    if (result == AUR_OK)
        result = aur_weights_solve(count, xyz, 1, &one, options, count, weights, NULL, NULL, error);
    aur_potential_destroy(potential);
    return result;
}

aur_result aur_rule_make(const aur_rule_options *options, size_t capacity, double *xyz, double *weights,
                         aur_error *error) {
    aur_rule_options copy = {.set = NULL};
    aur_directions_options points = {.size = sizeof points};
    aur_directions_options_init(0, AUR_DOMAIN_HEMISPHERE, &points, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_rule_options", error);
    if (result == AUR_OK)
        result = aur_options_read(copy.points, sizeof points, &points, "aur_directions_options", error);
    if (result == AUR_OK && points.count == 0)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "a rule needs at least one sample");
    if (result == AUR_OK)
        result = aur_check_capacity((size_t)points.count, capacity / 3, error);
    if (result == AUR_OK)
        result =
            aur_points_of_set(copy.set != NULL ? copy.set : aur_set_default, &points, xyz, weights, error);
    return result == AUR_OK && copy.optimal ? weigh(&points, copy.weights, xyz, weights, error) : result;
}

aur_result aur_rule_options_init(const aur_directions_options *points, aur_rule_options *options,
                                 aur_error *error) {
    static const aur_rule_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_rule_options", error);
    if (result == AUR_OK)
        options->points = points;
    return result;
}
