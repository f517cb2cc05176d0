#include "render/gather/rules.h"

#include <aureole/quadrature.h>
#include <stdlib.h>

#include "points/base/error.h"

/* Copies directions first .. first + count - 1 from float to double and normalises them in double, as the
 * solver requires. */
static void widen(const aur_gather_rule *rule, size_t first, size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const double x = (double)rule->x[first + i], y = (double)rule->y[first + i],
                     z = (double)rule->z[first + i];
        const double scale = 1.0 / sqrt(x * x + y * y + z * z);
        xyz[3 * i] = scale * x;
        xyz[3 * i + 1] = scale * y;
        xyz[3 * i + 2] = scale * z;
    }
}

/* Optimal weights for the lobe of a potential; their sum is its mass. */
static aur_result solve(size_t count, const double *xyz, const aur_potential *potential,
                        double regularization, double *weights, aur_error *error) {
    const aur_weights_options options = {
        .size = sizeof options, .regularization = regularization, .sum_constraint = true};
    const aur_result result =
        aur_weights_solve(count, xyz, 1, &potential, &options, count, weights, NULL, NULL, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        weights[i] *= aur_potential_mass(potential);
    return result;
}

/* Allocates memory for `count` directions and numbers, and creates the potential of the rule's lobe. */
static aur_result begin(const aur_gather_rule *rule, size_t count, double smoothness, double **xyz,
                        aur_potential **potential, aur_error *error) {
    const aur_density density = {.size = sizeof density, .exponent = rule->exponent};
    *xyz = malloc(5 * count * sizeof **xyz);
    *potential = NULL;
    return *xyz != NULL ? aur_potential_create(&density, smoothness, potential, error)
                        : aur_fail_memory(error);
}

aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error) {
    if (rule->square != NULL)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "optimal weights need prepared rotations: a pattern scrambled at every shading point "
                        "would need a solve there");
    const size_t n = rule->count;
    aur_potential *potential;
    double *xyz;
    aur_result result = begin(rule, n, smoothness, &xyz, &potential, error);
    for (size_t copy = 0; copy < rule->copies && result == AUR_OK; ++copy) {
        double *const weights = xyz + 3 * n;
        widen(rule, copy * n, n, xyz);
        result = solve(n, xyz, potential, regularization, weights, error);
        for (size_t i = 0; i < n && result == AUR_OK; ++i)
            rule->weights[copy * n + i] = (float)((double)n * weights[i]);
    }
    free(xyz);
    aur_potential_destroy(potential);
    return result;
}

/* --- lobes that dip below the surface */

/* The lobe is a product in the angles along and across the plane of its tilt (see quadrature/lune.h): what is
 * hidden is half the integral of sin^exponent up to the tilt over that up to 90 degrees. */
void aur_gather_horizon_fill(double exponent, aur_gather_horizon *horizon) {
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
        horizon->visible[i] = (float)(1.0 - 0.5 * hidden[i] / hidden[AUR_HORIZON_STEPS]);
}

/* The mean over all directions of the weights of those above the surface. */
static float visible_mean(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                          aur_vector normal) {
    float sum = 0.0f;
    if (rule->square != NULL) {
        for (size_t i = 0; i < rule->count; ++i) {
            aur_vector direction;
            const float weight = aur_gather_rule_direction(rule, rotation, i, &direction);
            sum += aur_vector_dot(direction, normal) > 0.0f ? weight : 0.0f;
        }
        return sum / (float)rule->count;
    }
    /* The normal rotated back, rather than every direction forth. */
    const float nx = rotation->cosine * normal.x + rotation->sine * normal.y;
    const float ny = rotation->cosine * normal.y - rotation->sine * normal.x;
    const float *restrict x = rule->x + rotation->first, *restrict y = rule->y + rotation->first;
    const float *restrict z = rule->z + rotation->first, *restrict weights = rule->weights + rotation->first;
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

float aur_gather_horizon_factor(const aur_gather_rule *rule, const aur_gather_horizon *horizon,
                                const aur_gather_rotation *rotation, aur_vector normal) {
    const float cosine = normal.z > 0.0f ? (normal.z < 1.0f ? normal.z : 1.0f) : 0.0f;
    const float position = acosf(cosine) * ((float)AUR_HORIZON_STEPS / (0.5f * AUR_PI_F));
    const size_t step = position < (float)AUR_HORIZON_STEPS ? (size_t)position : AUR_HORIZON_STEPS - 1;
    const float part = position - (float)step;
    const float *const table = horizon->visible;
    const float visible = table[step] + part * (table[step + 1] - table[step]);
    if (visible > 0.9999f)
        return 1.0f;
    const float whole = (float)(2.0 * AUR_PI / (rule->exponent + 1.0));
    const float mean = visible_mean(rule, rotation, normal);
    return mean > 0.0f ? whole * visible / mean : 0.0f;
}
