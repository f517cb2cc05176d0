#include "ggx.h"

#include <stdlib.h>

#include "vectors.h"

enum { LANES = AUR_GATHER_LANES };

/* --- the rule */

/* With more angles the worst-case error falls by less than .1 % for alpha from .05 to 1. */
enum { ANGLES = 64 };

static aur_result fail_memory(const lab_ggx_rule *rule, aur_error *error) {
    return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu rotations of %zu directions",
                    rule->rotations, rule->count);
}

static aur_result fill_square(lab_ggx_rule *rule, uint64_t seed, aur_error *error) {
    double *const uniform = malloc(3 * rule->count * sizeof *uniform);
    rule->square = malloc(rule->rotations * rule->count * sizeof *rule->square);
    aur_result result = uniform != NULL && rule->square != NULL ? AUR_OK : fail_memory(rule, error);
    if (result == AUR_OK)
        result = aur_weight_table_uniform(rule->table, 3 * rule->count, uniform, error);
    for (size_t rotation = 0; rotation < rule->rotations && result == AUR_OK; ++rotation) {
        double turns[2];
        aur_oswa_turns(seed, rotation, turns);
        for (size_t i = 0; i < rule->count; ++i) {
            const double *const u = uniform + 3 * i;
            float *const point = rule->square[rotation * rule->count + i];
            point[0] = (float)(atan2(u[1], u[0]) / (2.0 * LAB_PI) + turns[1]);
            point[1] = fminf((float)(1.0 - u[2]), 0x1.fffffep-1f);
        }
    }
    free(uniform);
    return result;
}

aur_result lab_ggx_rule_create(const lab_gather_settings *o, const aur_gather_common *common, size_t count,
                               float alpha, lab_ggx_rule **rule, aur_error *error) {
    const aur_weights_options weights = {
        .size = sizeof weights, .regularization = o->regularization, .sum_constraint = true};
    const aur_oswa_options requested = {.size = sizeof requested,
                                        .set = o->gather.pattern,
                                        .mirror_count = count,
                                        .mirror_lobe = {.kind = AUR_LOBE_GGX, .alpha = (double)alpha},
                                        .map = common->map,
                                        .scramble = common->scramble,
                                        .seed = common->seed,
                                        .smoothness = o->gather.smoothness,
                                        .weights = &weights};
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = ANGLES,
                                        .roughness_count = 1,
                                        .rotation_count = o->gather.rotations};
    lab_ggx_rule *const created = calloc(1, sizeof *created);
    *rule = created;
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a rule");
    *created = (lab_ggx_rule){
        .alpha = alpha, .count = count, .rotations = o->gather.rotations, .subsets = common->subsets};
    aur_result result =
        aur_weight_table_build(&requested, &grid, common->threads, common->progress, &created->table, error);
    if (result == AUR_OK)
        result = fill_square(created, common->seed, error);
    if (result != AUR_OK) {
        lab_ggx_release(created);
        *rule = NULL;
    }
    return result;
}

aur_result lab_ggx_prepare(const aur_gather_settings *options, const aur_gather_common *common, size_t count,
                           float alpha, void **state, aur_error *error) {
    const lab_gather_settings *const o = lab_settings(options);
    lab_ggx_rule *rule = NULL;
    const aur_result result = options->rotations > 0 && lab_is_optimal(o)
                                  ? lab_ggx_rule_create(o, common, count, alpha, &rule, error)
                                  : AUR_OK;
    *state = rule;
    return result;
}

void lab_ggx_release(void *state) {
    lab_ggx_rule *const rule = state;
    if (rule == NULL)
        return;
    aur_weight_table_destroy(rule->table);
    free(rule->square);
    free(rule);
}

/* --- at a shading point */

/* Smith's Lambda of a direction at this height (Heitz 2014). */
static float lambda(float alpha, float height) {
    const float tangent2 = fmaxf(0.0f, 1.0f - height * height) / (height * height);
    return 0.5f * (sqrtf(1.0f + alpha * alpha * tangent2) - 1.0f);
}

lab_ggx_view lab_ggx_rule_view(const lab_ggx_rule *rule, size_t rotation, bool mirrored,
                               const float view[3]) {
    const float height = fminf(fabsf(view[2]), 1.0f), radians = acosf(height);
    lab_ggx_view rotated = {.square = (const float(*)[2])rule->square + rotation * rule->count,
                            .circles = atan2f(view[1], view[0]) * (0.5f / (float)LAB_PI),
                            .sign = mirrored ? -1.0f : 1.0f,
                            .mass = (float)aur_weight_table_mass(rule->table, (double)radians, 0.0),
                            .alpha = rule->alpha,
                            .lambda = lambda(rule->alpha, height)};
    const size_t row = aur_weight_table_locate(rule->table, rotation, radians, &rotated.part);
    rotated.below = aur_weight_table_row(rule->table, row);
    rotated.above = aur_weight_table_row(rule->table, row + 1);
    return rotated;
}

float lab_ggx_view_weight(const lab_ggx_view *view, size_t index, float height) {
    const float weight = view->below[index] + view->part * (view->above[index] - view->below[index]);
    /* The lobe over its density of directions, G2 / G1 with height-correlated masking. */
    const float unmasked = (1.0f + view->lambda) / (1.0f + view->lambda + lambda(view->alpha, height));
    return weight * view->mass / unmasked;
}

void lab_ggx_gather(uint32_t lanes, aur_gather_sweep *sweep) {
    lab_ggx_view views[LANES];
    const lab_ggx_rule *rule = NULL; /* rules of all roughnesses have as many directions and rotations */
    for (size_t lane = 0; lane < LANES; ++lane) {
        aur_gather_shading_point point;
        if (!aur_gather_describe(sweep, lane, &point))
            continue;
        rule = point.state;
        views[lane] = lab_ggx_rule_view(rule, point.rotation, point.mirrored, point.view);
    }
    const size_t count = rule->count, subsets = rule->subsets;
    for (size_t i = aur_gather_subset(sweep); i < count; i += subsets) {
        float square[2][LANES], values[3][LANES], heights[LANES], radiance[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            float point[2];
            if ((lanes >> lane & 1u) == 0)
                continue;
            lab_ggx_view_square(&views[lane], i, point);
            square[0][lane] = point[0];
            square[1][lane] = point[1];
        }
        const uint32_t aimed = aur_gather_trace_ggx(sweep, lanes, i, (float)count / (float)subsets,
                                                    (const float(*)[LANES])square, values, heights, radiance);
        for (size_t lane = 0; lane < LANES; ++lane) {
            if ((aimed >> lane & 1u) == 0)
                continue;
            const float weight = (float)count * lab_ggx_view_weight(&views[lane], i, heights[lane]);
            float reflected[3];
            for (size_t c = 0; c < 3; ++c)
                reflected[c] = values[c][lane] * weight * radiance[c][lane];
            aur_gather_reflect(sweep, lane, reflected);
        }
    }
}
