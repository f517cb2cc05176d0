/* Weights of lobes that dip below the surface. */
#include "render/gather/rules.h"

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
