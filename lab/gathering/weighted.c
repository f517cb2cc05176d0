/* Methods that replace the weights of a pattern by the optimal ones for its lobe (Marques 2018, section 5.2),
 * which do not depend on rotations of the pattern about its axis. */
#include "weighted.h"

#include <math.h>
#include <stdlib.h>

#include "ggx.h"
#include "merged.h"

void lab_widen(const aur_gather_directions *pattern, size_t copy, double *xyz) {
    const size_t first = copy * pattern->count;
    for (size_t i = 0; i < pattern->count; ++i) {
        const double x = (double)pattern->x[first + i], y = (double)pattern->y[first + i],
                     z = (double)pattern->z[first + i];
        const double scale = 1.0 / sqrt(x * x + y * y + z * z);
        xyz[3 * i] = scale * x;
        xyz[3 * i + 1] = scale * y;
        xyz[3 * i + 2] = scale * z;
    }
}

aur_result lab_optimal_weights(size_t count, const double *xyz, const aur_potential *potential,
                               double regularization, double *weights, aur_error *error) {
    const aur_weights_options options = {
        .size = sizeof options, .regularization = regularization, .sum_constraint = true};
    const aur_result result =
        aur_weights_solve(count, xyz, 1, &potential, &options, count, weights, NULL, NULL, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        weights[i] *= aur_potential_mass(potential);
    return result;
}

/* Of all copies. */
static aur_result replace_weights(const lab_gather_settings *o, const aur_gather_directions *pattern,
                                  aur_error *error) {
    const size_t n = pattern->count;
    const aur_density density = {.size = sizeof density, .exponent = pattern->exponent};
    aur_potential *potential = NULL;
    double *const xyz = malloc(4 * n * sizeof *xyz), *const weights = xyz + 3 * n;
    aur_result result = AUR_OK;
    if (xyz == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "finalgather-lab: out of memory for %zu weights", n);
    if (result == AUR_OK)
        result = aur_potential_create(&density, o->gather.smoothness, &potential, error);
    for (size_t copy = 0; copy < pattern->copies && result == AUR_OK; ++copy) {
        lab_widen(pattern, copy, xyz);
        result = lab_optimal_weights(n, xyz, potential, o->regularization, weights, error);
        for (size_t i = 0; i < n && result == AUR_OK; ++i)
            pattern->weights[copy * n + i] = (float)((double)n * weights[i]);
    }
    free(xyz);
    aur_potential_destroy(potential);
    return result;
}

static aur_result prepare(const aur_gather_settings *options, const aur_gather_common *common, size_t base,
                          const aur_gather_directions *pattern, void *diffuse, void **state,
                          aur_error *error) {
    (void)common, (void)base, (void)diffuse, (void)state;
    return replace_weights(lab_settings(options), pattern, error);
}

const aur_gather_method lab_gather_weighted = {.prepare = prepare,
                                               .release = free,
                                               .prepare_ggx = lab_ggx_prepare,
                                               .release_ggx = lab_ggx_release,
                                               .gather_ggx = lab_ggx_gather};

static aur_result prepare_merged(const aur_gather_settings *options, const aur_gather_common *common,
                                 size_t base, const aur_gather_directions *pattern, void *diffuse,
                                 void **state, aur_error *error) {
    (void)base;
    const lab_gather_settings *const o = lab_settings(options);
    const aur_result result = lab_is_optimal(o) ? replace_weights(o, pattern, error) : AUR_OK;
    return result == AUR_OK ? lab_merged_prepare(o, common, pattern, diffuse, state, error) : result;
}

const aur_gather_method lab_gather_merged = {.prepare = prepare_merged,
                                             .release = lab_merged_release,
                                             .gather_pairs = lab_merged_gather,
                                             .pair_density = lab_merged_density,
                                             .prepare_ggx = lab_ggx_prepare,
                                             .release_ggx = lab_ggx_release,
                                             .gather_ggx = lab_ggx_gather};
