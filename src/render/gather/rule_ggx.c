#include "render/gather/rule_ggx.h"

#include <stdlib.h>

#include "points/base/error.h"

/* With more angles the worst-case error falls by less than .1 % for alpha from .05 to 1. */
enum { ANGLES = 64 };

static aur_result fill_square(aur_ggx_rule *rule, uint64_t seed, aur_error *error) {
    const double *const uniform = rule->table->oswa->uniform[1];
    rule->square = malloc(rule->rotations * rule->count * sizeof *rule->square);
    if (rule->square == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu rotations of %zu directions",
                        rule->rotations, rule->count);
    for (size_t rotation = 0; rotation < rule->rotations; ++rotation) {
        double turns[2];
        aur_oswa_turns(seed, rotation, turns);
        for (size_t i = 0; i < rule->count; ++i) {
            const double *const u = uniform + 3 * i;
            float *const point = rule->square[rotation * rule->count + i];
            point[0] = (float)(atan2(u[1], u[0]) / (2.0 * AUR_PI) + turns[1]);
            point[1] = fminf((float)(1.0 - u[2]), 0x1.fffffep-1f);
        }
    }
    return AUR_OK;
}

aur_result aur_ggx_rule_create(const aur_ggx_rule_options *options, aur_ggx_rule *rule, aur_error *error) {
    const aur_gather_rule_options *const pattern = &options->pattern;
    const aur_weights_options weights = {
        .size = sizeof weights, .regularization = options->regularization, .sum_constraint = true};
    const aur_oswa_options requested = {
        .size = sizeof requested,
        .set = pattern->set,
        .mirror_count = pattern->count,
        .mirror_lobe = {.kind = AUR_LOBE_GGX, .alpha = (double)options->alpha},
        .map = pattern->map,
        .scramble = pattern->scramble,
        .seed = pattern->seed,
        .smoothness = pattern->smoothness,
        .weights = &weights};
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = ANGLES,
                                        .roughness_count = 1,
                                        .rotation_count = pattern->rotations};
    *rule = (aur_ggx_rule){.alpha = options->alpha, .count = pattern->count, .rotations = pattern->rotations};
    aur_result result =
        aur_weight_table_build(&requested, &grid, options->threads, &options->progress, &rule->table, error);
    if (result == AUR_OK)
        result = fill_square(rule, pattern->seed, error);
    if (result != AUR_OK)
        aur_ggx_rule_release(rule);
    return result;
}

void aur_ggx_rule_release(aur_ggx_rule *rule) {
    aur_weight_table_destroy(rule->table);
    free(rule->square);
    *rule = (aur_ggx_rule){0};
}

/* Smith's Lambda of a direction at this height (Heitz 2014). */
static float lambda(float alpha, float height) {
    const float tangent2 = fmaxf(0.0f, 1.0f - height * height) / (height * height);
    return 0.5f * (sqrtf(1.0f + alpha * alpha * tangent2) - 1.0f);
}

aur_ggx_view aur_ggx_rule_view(const aur_ggx_rule *rule, size_t rotation, bool mirrored, aur_vector view) {
    const float height = fminf(fabsf(view.z), 1.0f), radians = acosf(height);
    aur_ggx_view rotated = {.square = (const float(*)[2])rule->square + rotation * rule->count,
                            .circles = atan2f(view.y, view.x) * (0.5f / AUR_PI_F),
                            .sign = mirrored ? -1.0f : 1.0f,
                            .mass = (float)aur_weight_table_mass(rule->table, (double)radians, 0.0),
                            .alpha = rule->alpha,
                            .lambda = lambda(rule->alpha, height)};
    const size_t row = aur_weight_table_locate(rule->table, rotation, radians, &rotated.part);
    rotated.below = aur_weight_table_row(rule->table, row);
    rotated.above = rotated.below + aur_weight_table_width(rule->table);
    return rotated;
}

float aur_ggx_view_weight(const aur_ggx_view *view, size_t index, float height) {
    const float weight = view->below[index] + view->part * (view->above[index] - view->below[index]);
    /* The lobe over its density of directions, G2 / G1 with height-correlated masking. */
    const float unmasked = (1.0f + view->lambda) / (1.0f + view->lambda + lambda(view->alpha, height));
    return weight * view->mass / unmasked;
}
