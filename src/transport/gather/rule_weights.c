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

/* One pattern for each prepared scrambling, or one that is turned. */
static size_t pattern_count(const aur_gather_rule *rule) {
    size_t count = 1;
    for (size_t k = 0; k < rule->rotations; ++k)
        if (rule->turns[k].first / rule->count + 1 > count)
            count = rule->turns[k].first / rule->count + 1;
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
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
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

/* The lobe is a product in the angles along and across the plane of its tilt (see quadrature/lune.h): what is
 * hidden is half the integral of sin^exponent up to the tilt over that up to 90 degrees. */
void aur_gather_horizon(double exponent, float visible[AUR_HORIZON_STEPS + 1]) {
    enum { PARTS = 16 };
    const double width = 0.5 * AUR_PI / (AUR_HORIZON_STEPS * PARTS);
    double hidden[AUR_HORIZON_STEPS + 1] = {0.0};
    for (size_t i = 0; i < AUR_HORIZON_STEPS; ++i) {
        double sum = 0.0;
        for (size_t k = 0; k < PARTS; ++k)
            sum += pow(sin(((double)(i * PARTS + k) + 0.5) * width), exponent);
        hidden[i + 1] = hidden[i] + sum;
    }
    for (size_t i = 0; i <= AUR_HORIZON_STEPS; ++i)
        visible[i] = (float)(1.0 - 0.5 * hidden[i] / hidden[AUR_HORIZON_STEPS]);
}

/* The mean weight over all directions, of those above the surface. */
static float visible_mean(const aur_gather_rule *rule, const aur_gather_turn *turn, aur_vector normal) {
    float sum = 0.0f;
    if (rule->square != NULL) {
        for (size_t i = 0; i < rule->count; ++i) {
            aur_vector direction;
            const float weight = aur_gather_direction(rule, turn, i, &direction);
            sum += aur_vector_dot(direction, normal) > 0.0f ? weight : 0.0f;
        }
        return sum / (float)rule->count;
    }
    /* The normal turned back, rather than every direction forth. */
    const float nx = turn->cosine * normal.x + turn->sine * normal.y;
    const float ny = turn->cosine * normal.y - turn->sine * normal.x;
    const float *restrict x = rule->x + turn->first, *restrict y = rule->y + turn->first;
    const float *restrict z = rule->z + turn->first, *restrict weights = rule->weights + turn->first;
    float lanes[8] = {0};
    size_t i = 0;
    for (; i + 8 <= rule->count; i += 8)
        for (size_t k = 0; k < 8; ++k)
            lanes[k] += nx * x[i + k] + ny * y[i + k] + normal.z * z[i + k] > 0.0f ? weights[i + k] : 0.0f;
    for (; i < rule->count; ++i)
        lanes[i % 8] += nx * x[i] + ny * y[i] + normal.z * z[i] > 0.0f ? weights[i] : 0.0f;
    for (size_t k = 0; k < 8; ++k)
        sum += lanes[k];
    return sum / (float)rule->count;
}

float aur_gather_horizon_factor(const aur_gather_rule *rule, const float visible[AUR_HORIZON_STEPS + 1],
                                const aur_gather_turn *turn, aur_vector normal) {
    const float cosine = normal.z > 0.0f ? (normal.z < 1.0f ? normal.z : 1.0f) : 0.0f;
    const float position = acosf(cosine) * ((float)AUR_HORIZON_STEPS / (0.5f * AUR_PI_F));
    const size_t step = position < (float)AUR_HORIZON_STEPS ? (size_t)position : AUR_HORIZON_STEPS - 1;
    const float part = position - (float)step;
    const float share = visible[step] + part * (visible[step + 1] - visible[step]);
    if (share > 0.9999f)
        return 1.0f;
    const float whole = (float)(2.0 * AUR_PI / (rule->exponent + 1.0));
    const float mean = visible_mean(rule, turn, normal);
    return mean > 0.0f ? whole * share / mean : 0.0f;
}
