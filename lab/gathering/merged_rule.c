#include "merged_rule.h"

#include <stdlib.h>

/* --- creation */

/* With this many angles, linear interpolation loses less than 0.2 % of the gain: 32 for m = 20, 64 for 200.
 */
static size_t angle_count(double exponent) {
    size_t count = 32;
    while (count < 256 && (double)(count * count) < 20.0 * exponent)
        count *= 2;
    return count;
}

static aur_oswa_options oswa_options(const lab_merged_options *options, const aur_weights_options *weights) {
    const lab_gather_settings *const o = options->settings;
    const aur_gather_common *const common = options->common;
    return (aur_oswa_options){.size = sizeof(aur_oswa_options),
                              .set = o->gather.pattern,
                              .count = options->count[0],
                              .mirror_count = options->count[1],
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = {.exponent = options->exponent},
                              .optimal_density = o->gather.density == AUR_GATHER_DENSITY_OPTIMAL,
                              .clipped = o->gather.clip && o->weights == LAB_WEIGHTS_OSWA,
                              .map = common->map,
                              .scramble = common->scramble,
                              .seed = common->seed,
                              .smoothness = o->gather.smoothness,
                              .weights = weights};
}

static aur_result allocate(lab_merged_rule *rule, aur_error *error) {
    float *next = malloc(3 * rule->rotations * (rule->count[0] + rule->count[1]) * sizeof *next);
    if (next == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu rotations of %zu + %zu directions",
                        rule->rotations, rule->count[0], rule->count[1]);
    for (size_t pattern = 0; pattern < 2; ++pattern)
        for (size_t k = 0; k < 3; ++k, next += rule->rotations * rule->count[pattern])
            rule->direction[pattern][k] = next;
    return AUR_OK;
}

/* The patterns in all their rotations; at the angle 0 both axes are +z. */
static aur_result fill_directions(lab_merged_rule *rule, const aur_oswa_options *options, aur_error *error) {
    const size_t size = rule->count[0] + rule->count[1];
    double *const xyz = malloc(3 * size * sizeof *xyz);
    if (xyz == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a rule");
    aur_result result = AUR_OK;
    if (rule->table == NULL)
        result = aur_oswa_create(options, &rule->oswa, error);
    for (size_t rotation = 0; rotation < rule->rotations && result == AUR_OK; ++rotation) {
        double angles[2];
        aur_oswa_turns(rule->seed, rotation, angles);
        result = rule->table != NULL
                     ? aur_weight_table_points(rule->table, 0.0, 0.0, rotation, false, 3 * size, xyz, error)
                     : aur_oswa_points(rule->oswa, 0.0, angles, false, 3 * size, xyz, error);
        const double *u = xyz;
        for (size_t pattern = 0; pattern < 2 && result == AUR_OK; ++pattern)
            for (size_t i = 0; i < rule->count[pattern]; ++i, u += 3) {
                const size_t at = rotation * rule->count[pattern] +
                                  i % rule->subsets * rule->subset_count[pattern] + i / rule->subsets;
                for (size_t k = 0; k < 3; ++k)
                    rule->direction[pattern][k][at] = (float)u[k];
            }
    }
    free(xyz);
    return result;
}

static void fill_densities(lab_merged_rule *rule) {
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        const double exponent = rule->drawn_exponent[pattern];
        const double scale = (double)rule->subset_count[pattern] * (exponent + 1.0) / (2.0 * LAB_PI);
        for (size_t i = 0; i <= LAB_MERGED_DENSITY_STEPS; ++i)
            rule->density[pattern][i] = (float)(scale * pow((double)i / LAB_MERGED_DENSITY_STEPS, exponent));
    }
}

/* The index of the weight of sample i (of both patterns) for a lobe in the order of subsets, each of which
 * has 2 * samples weights in sequence. */
static size_t slot_of(const lab_merged_rule *rule, size_t lobe, size_t i) {
    const size_t samples = lab_merged_rule_samples(rule);
    const size_t pattern = i < rule->count[0] ? 0 : 1, index = i - pattern * rule->count[0];
    return index % rule->subsets * 2 * samples + lobe * samples + pattern * rule->subset_count[0] +
           index / rule->subsets;
}

/* Copies the table's rows in that order and scales them to the lobes' integrals: pi for the diffuse lobe. The
 * integral of the glossy lobe depends on the angle and is applied at look-up. */
static aur_result compile(lab_merged_rule *rule, aur_error *error) {
    const size_t size = rule->count[0] + rule->count[1];
    const size_t row_count = aur_weight_table_rows(rule->table);
    rule->rows = malloc(row_count * 2 * size * sizeof *rule->rows);
    if (rule->rows == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the weights of %zu directions", size);
    for (size_t row = 0; row < row_count; ++row)
        for (size_t i = 0; i < 2 * size; ++i) {
            const size_t lobe = i / size;
            rule->rows[row * 2 * size + slot_of(rule, lobe, i % size)] =
                (float)rule->subsets * (lobe == 0 ? (float)LAB_PI : 1.0f) *
                aur_weight_table_row(rule->table, row)[i];
        }
    return AUR_OK;
}

static aur_result prepare(lab_merged_rule *rule, const lab_merged_options *options, aur_error *error) {
    const lab_gather_settings *const o = options->settings;
    const aur_gather_common *const common = options->common;
    /* The published method does not constrain the sum. */
    const aur_weights_options weights = {.size = sizeof weights,
                                         .regularization = o->regularization,
                                         .sum_constraint = o->weights == LAB_WEIGHTS_OSWA};
    aur_oswa_options requested = oswa_options(options, &weights);
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = angle_count(options->exponent),
                                        .roughness_count = 1,
                                        .rotation_count = rule->rotations};
    aur_result result = AUR_OK;
    if (o->weights == LAB_WEIGHTS_OSWA)
        result = common->use_cache ? aur_weight_table_find(&requested, &grid, common->threads,
                                                           common->progress, &rule->table, error)
                                   : aur_weight_table_build(&requested, &grid, common->threads,
                                                            common->progress, &rule->table, error);
    if (o->weights == LAB_WEIGHTS_SOLVE)
        requested.published_z = (aur_z_grid){
            .angle_count = 64, .exponent_count = 32, .largest_exponent = fmax(1.0, options->exponent)};
    if (result == AUR_OK)
        result = fill_directions(rule, &requested, error);
    if (result == AUR_OK && rule->table != NULL)
        result = compile(rule, error);
    return result;
}

static aur_result create(lab_merged_rule *rule, const lab_merged_options *options, aur_error *error) {
    const aur_gather_settings *const shared = &options->settings->gather;
    const double power =
        shared->density == AUR_GATHER_DENSITY_OPTIMAL ? 2.0 / (shared->smoothness + 1.0) : 1.0;
    *rule = (lab_merged_rule){.method = options->settings->weights,
                              .subsets = options->common->subsets,
                              .rotations = shared->rotations,
                              .count = {options->count[0], options->count[1]},
                              .exponent = options->exponent,
                              .drawn_exponent = {power, power * options->exponent},
                              .seed = options->common->seed};
    for (size_t pattern = 0; pattern < 2; ++pattern)
        rule->subset_count[pattern] = rule->count[pattern] / rule->subsets;
    fill_densities(rule);
    const aur_result result = allocate(rule, error);
    return result == AUR_OK ? prepare(rule, options, error) : result;
}

aur_result lab_merged_rule_create(const lab_merged_options *options, lab_merged_rule **rule,
                                  aur_error *error) {
    const size_t diffuse = options->count[0], glossy = options->count[1], parts = options->common->subsets;
    *rule = NULL;
    if (options->settings->gather.rotations == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "weights of merged samples need prepared rotations: at least 1, not 0");
    if (parts == 0 || diffuse % parts != 0 || glossy % parts != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%zu + %zu directions are not split evenly by %zu samples",
                        diffuse, glossy, parts);
    lab_merged_rule *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a rule");
    const aur_result result = create(created, options, error);
    if (result != AUR_OK) {
        lab_merged_rule_destroy(created);
        return result;
    }
    *rule = created;
    return AUR_OK;
}

void lab_merged_rule_destroy(lab_merged_rule *rule) {
    if (rule == NULL)
        return;
    aur_weight_table_destroy(rule->table);
    aur_oswa_destroy(rule->oswa);
    free(rule->rows);
    free(rule->direction[0][0]);
    free(rule);
}

/* --- at a shading point */

static void look_up(const lab_merged_rule *rule, size_t rotation, size_t subset, float radians,
                    float *weights) {
    float part;
    const size_t row = aur_weight_table_locate(rule->table, rotation, radians, &part);
    const size_t samples = lab_merged_rule_samples(rule);
    const size_t row_size = 2 * samples * rule->subsets;
    const float *const below = rule->rows + row * row_size + subset * 2 * samples;
    const float *const above = below + row_size;
    for (size_t i = 0; i < 2 * samples; ++i)
        weights[i] = below[i] + part * (above[i] - below[i]);
    const float mass = (float)aur_weight_table_mass(rule->table, (double)radians, 0.0);
    for (size_t i = samples; i < 2 * samples; ++i)
        weights[i] *= mass;
}

/* cos^exponent / (n q + n' q') for each lobe and sample; below the surface there is no light. */
static void balance(const lab_merged_rule *rule, size_t rotation, size_t subset, float cosine,
                    float *weights) {
    const size_t samples = lab_merged_rule_samples(rule);
    const float sine = sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine));
    float scale[2], drawn[2];
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        drawn[pattern] = (float)rule->drawn_exponent[pattern];
        scale[pattern] =
            (float)rule->subset_count[pattern] * (drawn[pattern] + 1.0f) / (2.0f * (float)LAB_PI);
    }
    size_t at = 0;
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        const size_t first = rotation * rule->count[pattern] + subset * rule->subset_count[pattern];
        for (size_t i = 0; i < rule->subset_count[pattern]; ++i, ++at) {
            const float x = rule->direction[pattern][0][first + i],
                        z = rule->direction[pattern][2][first + i];
            const float other = pattern == 0 ? cosine * z - sine * x : cosine * z + sine * x;
            const float normal = pattern == 0 ? z : other, mirror = pattern == 0 ? other : z;
            const float on_normal = normal > 0.0f ? scale[0] * powf(normal, drawn[0]) : 0.0f;
            const float on_mirror = mirror > 0.0f ? scale[1] * powf(mirror, drawn[1]) : 0.0f;
            const float all = on_normal + on_mirror;
            weights[at] = normal > 0.0f ? normal / all : 0.0f;
            weights[samples + at] =
                normal > 0.0f && mirror > 0.0f ? powf(mirror, (float)rule->exponent) / all : 0.0f;
        }
    }
}

static bool solve(const lab_merged_rule *rule, size_t rotation, size_t subset, float radians,
                  float *weights) {
    const size_t size = rule->count[0] + rule->count[1], row = 2 * lab_merged_rule_samples(rule);
    double angles[2], mass = 0.0;
    aur_oswa_turns(rule->seed, rotation, angles);
    double *const found = malloc(2 * size * sizeof *found);
    bool solved = found != NULL &&
                  aur_oswa_solve(rule->oswa, (double)radians, angles, 2 * size, found, &mass, NULL) == AUR_OK;
    for (size_t i = 0; i < row; ++i)
        weights[i] = NAN;
    for (size_t i = 0; i < 2 * size && solved; ++i) {
        const size_t lobe = i / size, at = slot_of(rule, lobe, i % size);
        if (at / row != subset)
            continue;
        weights[at % row] = (float)((double)rule->subsets * (lobe == 0 ? LAB_PI : mass) * found[i]);
        solved = isfinite(weights[at % row]);
    }
    free(found);
    return solved;
}

bool lab_merged_rule_weights(const lab_merged_rule *rule, size_t rotation, size_t subset, float cosine,
                             float *weights) {
    const float inside = cosine > 0.0f ? (cosine < 1.0f ? cosine : 1.0f) : 0.0f;
    if (rule->method == LAB_WEIGHTS_SOLVE)
        return solve(rule, rotation, subset, acosf(inside), weights);
    if (rule->method == LAB_WEIGHTS_OSWA)
        look_up(rule, rotation, subset, acosf(inside), weights);
    else
        balance(rule, rotation, subset, inside, weights);
    return true;
}

void lab_merged_rule_frames(lab_vector normal, lab_vector mirror, bool mirrored, lab_frame frames[2]) {
    const float cosine = lab_dot(normal, mirror);
    const lab_vector along = lab_add_scaled(mirror, -cosine, normal);
    const float sine = sqrtf(lab_dot(along, along));
    /* Where the plane is lost any will do. */
    const lab_vector x = sine > 1e-6f ? lab_scale(along, -1.0f / sine) : lab_frame_about(normal).x;
    const lab_vector y = lab_scale(lab_cross(normal, x), mirrored ? -1.0f : 1.0f);
    frames[0] = (lab_frame){x, y, normal};
    frames[1] =
        (lab_frame){lab_add_scaled(lab_scale(x, cosine), sine > 1e-6f ? sine : 0.0f, normal), y, mirror};
}
