#include "transport/gather/rule_weights.h"

#include <aureole/quadrature.h>
#include <math.h>
#include <stdlib.h>

#include "core/error.h"

/* Directions in float, of unit length in double. */
static void widen(const aur_gather_rule *rule, size_t first, double *xyz) {
    for (size_t i = 0; i < rule->count; ++i) {
        const double x = (double)rule->x[first + i], y = (double)rule->y[first + i],
                     z = (double)rule->z[first + i];
        const double scale = 1.0 / sqrt(x * x + y * y + z * z);
        xyz[3 * i] = scale * x;
        xyz[3 * i + 1] = scale * y;
        xyz[3 * i + 2] = scale * z;
    }
}

/* One copy of the pattern for each prepared scrambling, or one that is rotated. */
static size_t pattern_count(const aur_gather_rule *rule) {
    size_t count = 1;
    for (size_t k = 0; k < rule->rotation_count; ++k)
        if (rule->rotations[k].first / rule->count + 1 > count)
            count = rule->rotations[k].first / rule->count + 1;
    return count;
}

aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error) {
    if (rule->square != NULL)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "optimal weights need prepared rotations: patterns scrambled anew at every shading point "
            "would need a solve there");
    const size_t n = rule->count;
    const aur_density density = {.kind = AUR_DENSITY_COSINE_POWER, .exponent = rule->exponent};
    const aur_weights_options options = {.regularization = regularization, .sum_constraint = 1};
    aur_potential *potential = NULL;
    aur_result result = aur_potential_create(&density, smoothness, &potential, error);
    double *const xyz = malloc(4 * n * sizeof *xyz);
    if (result == AUR_OK && xyz == NULL)
        result = aur_fail_memory(error);
    for (size_t pattern = 0; pattern < pattern_count(rule) && result == AUR_OK; ++pattern) {
        const aur_potential *const one = potential;
        widen(rule, pattern * n, xyz);
        result = aur_weights_solve(n, xyz, 1, &one, &options, xyz + 3 * n, NULL, NULL, error);
        const double scale = (double)n * aur_potential_mass(potential);
        for (size_t i = 0; i < n && result == AUR_OK; ++i)
            rule->weights[pattern * n + i] = (float)(scale * xyz[3 * n + i]);
    }
    free(xyz);
    aur_potential_destroy(potential);
    return result;
}
