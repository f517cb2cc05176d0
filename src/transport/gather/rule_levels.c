#include "transport/gather/rule_levels.h"

#include <aureole/quadrature.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/error.h"

/* Beyond it a system for optimal weights takes longer than a picture. */
enum { MOST_DIRECTIONS = 1 << 24, MOST_OPTIMAL = 4096 };

aur_result aur_gather_levels_set(const aur_gather_levels_options *options, size_t capacity, char *set,
                                 size_t *count, aur_error *error) {
    *count = options->base;
    for (size_t l = 0; l < options->extensions; ++l) {
        *count *= options->factor;
        if (*count > MOST_DIRECTIONS)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "finalgather: %zu directions extended %zu times by %zu are more than %d; use "
                            "fewer levels",
                            options->base, options->extensions, options->factor, MOST_DIRECTIONS);
    }
    if (options->optimal && *count > MOST_OPTIMAL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "finalgather: optimal weights of levels of up to %zu directions would take too long "
                        "(at most %d); use fewer levels or weights=ratio",
                        *count, MOST_OPTIMAL);
    const size_t quadruplings = options->factor == 4 ? options->extensions : (options->extensions + 1) / 2;
    snprintf(set, capacity, "esfg:base=%zu,levels=%zu,progression=%zu", options->base, quadruplings,
             options->factor);
    return AUR_OK;
}

/* Weights p/q of the first `count` directions, a mean. */
static void plain_weights(const aur_gather_rule *rule, size_t count, double *weights) {
    for (size_t i = 0; i < count; ++i)
        weights[i] = (double)rule->weights[i] / (double)count;
}

static aur_result measure_level(const aur_gather_levels_options *options, const aur_potential *potential,
                                size_t count, const double *xyz, const double *weights, float *value,
                                aur_error *error) {
    const double mass = aur_potential_mass(potential);
    double *const normalised = malloc(count * sizeof *normalised);
    if (normalised == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i)
        normalised[i] = weights[i] / mass;
    double found = 0.0;
    const aur_result result = aur_worst_case_error(count, xyz, normalised, potential, 1, NULL, &found, error);
    free(normalised);
    /* K of a direction with itself, less the self-energy: the squared error of one random direction. */
    const double diagonal = pow(2.0, 2.0 * options->smoothness - 1.0) / options->smoothness;
    *value = (float)(found / sqrt(diagonal - aur_potential_self_energy(potential)));
    return result;
}

static aur_result make_level(const aur_gather_levels_options *options, const aur_gather_rule *rule,
                             const aur_potential *potential, const double *xyz, aur_gather_levels *levels,
                             size_t level, aur_error *error) {
    const size_t count = levels->ends[level];
    double *const weights = malloc(count * sizeof *weights);
    levels->weights[level] = malloc(count * sizeof *levels->weights[level]);
    aur_result result = AUR_OK;
    if (weights == NULL || levels->weights[level] == NULL) {
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the weights of %zu directions", count);
    } else if (options->optimal) {
        const aur_weights_options solve = {.regularization = options->regularization, .sum_constraint = 1};
        result = aur_weights_solve(count, xyz, 1, &potential, &solve, weights, NULL, NULL, error);
        for (size_t i = 0; i < count && result == AUR_OK; ++i)
            weights[i] *= aur_potential_mass(potential);
    } else {
        plain_weights(rule, count, weights);
    }
    if (result == AUR_OK)
        result = measure_level(options, potential, count, xyz, weights, &levels->errors[level], error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        levels->weights[level][i] = (float)weights[i];
    free(weights);
    return result;
}

aur_result aur_gather_levels_create(const aur_gather_levels_options *options, const aur_gather_rule *rule,
                                    aur_gather_levels *levels, aur_error *error) {
    *levels = (aur_gather_levels){.count = options->extensions + 1};
    const aur_density density = {.kind = AUR_DENSITY_COSINE_POWER, .exponent = rule->exponent};
    aur_potential *potential = NULL;
    double *const xyz = malloc(3 * rule->count * sizeof *xyz);
    aur_result result = xyz != NULL ? aur_potential_create(&density, options->smoothness, &potential, error)
                                    : aur_fail_memory(error);
    for (size_t i = 0; i < rule->count && result == AUR_OK; ++i) {
        /* Floats are no unit vectors to the solver's liking. */
        const double x = (double)rule->x[i], y = (double)rule->y[i], z = (double)rule->z[i];
        const double length = sqrt(x * x + y * y + z * z);
        xyz[3 * i] = x / length;
        xyz[3 * i + 1] = y / length;
        xyz[3 * i + 2] = z / length;
    }
    size_t end = options->base;
    for (size_t l = 0; l < levels->count && result == AUR_OK; ++l, end *= options->factor) {
        levels->ends[l] = end;
        result = make_level(options, rule, potential, xyz, levels, l, error);
    }
    aur_potential_destroy(potential);
    free(xyz);
    if (result != AUR_OK)
        aur_gather_levels_release(levels);
    return result;
}

void aur_gather_levels_release(aur_gather_levels *levels) {
    for (size_t l = 0; l < AUR_GATHER_LEVEL_CAPACITY; ++l)
        free(levels->weights[l]);
    *levels = (aur_gather_levels){0};
}
