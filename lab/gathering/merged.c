/* Lanes with different glossy lobes are processed together, and diffuse points among them trace their single
 * pattern in the same packets, because a packet costs nearly the same for few lanes as for many. */
#include "merged.h"

#include <stdlib.h>

#include "merged_rule.h"

enum { LANES = AUR_GATHER_LANES };

/* --- the state of a pattern */

typedef struct merged_state {
    aur_gather_directions pattern;
    size_t subsets;
    lab_merged_rule *rule; /* of a glossy pattern; NULL: the diffuse one */
    /* Of the diffuse pattern: the first glossy one's rule. All rules have the same diffuse directions. */
    const lab_merged_rule *first;
} merged_state;

aur_result lab_merged_prepare(const lab_gather_settings *o, const aur_gather_common *common,
                              const aur_gather_directions *pattern, void *diffuse, void **state,
                              aur_error *error) {
    merged_state *const created = calloc(1, sizeof *created), *const shared = diffuse;
    *state = created;
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "finalgather-lab: out of memory for weights");
    *created = (merged_state){.pattern = *pattern, .subsets = common->subsets};
    if (shared == NULL)
        return AUR_OK;
    const lab_merged_options options = {.settings = o,
                                        .common = common,
                                        .count = {shared->pattern.count, pattern->count},
                                        .exponent = pattern->exponent};
    const aur_result result = lab_merged_rule_create(&options, &created->rule, error);
    if (shared->first == NULL)
        shared->first = created->rule;
    return result;
}

void lab_merged_release(void *state) {
    merged_state *const merged = state;
    if (merged != NULL)
        lab_merged_rule_destroy(merged->rule);
    free(merged);
}

float lab_merged_density(const void *glossy, const float cosines[2]) {
    return lab_merged_rule_density(((const merged_state *)glossy)->rule, cosines[0], cosines[1]);
}

/* --- at shading points */

/* One pattern's part of this sample, and the lanes that send it. */
typedef struct merged_pattern {
    uint32_t lanes;
    bool uniform; /* all lanes have the same local directions */
    const float *directions[3][LANES];
    size_t stride[LANES];     /* from one direction to the next */
    float frame[3][3][LANES]; /* axis, coordinate */
} merged_pattern;

/* One subset of both patterns. */
typedef struct merged {
    const merged_state *state; /* of the diffuse pattern */
    merged_pattern patterns[2];
    uint32_t diffuse;                /* lanes that send the first pattern only, their rule's */
    size_t subset;                   /* this sample's */
    size_t subset_count[2], samples; /* directions in a subset, of each pattern and of both */
    /* Of each sample, sixteen lanes, for one lobe and then the other, followed by space for one lane's. */
    float *weights;
    const float *densities[LANES];      /* of the first pattern's directions, in diffuse lanes */
    const lab_merged_rule *rule[LANES]; /* in the others */
    lab_vector axes[LANES][2];          /* of the lobes, in the others */
    float colours[LANES][2][3];
    float times_cosine[LANES]; /* 1: the glossy lobe's integrand includes the cosine; else 0 */
    float sum[2][3][LANES];    /* of weight * radiance, by lobe and channel */
} merged;

static bool has_lane(uint32_t lanes, size_t lane) {
    return (lanes >> lane & 1u) != 0;
}

/* The weights of a sample for a lobe, one per lane. Values of inactive lanes are never used. */
static float *weights_of(const merged *work, size_t lobe, size_t sample) {
    return work->weights + (lobe * work->samples + sample) * LANES;
}

static void set_frame(merged_pattern *pattern, size_t lane, const lab_frame *frame) {
    const lab_vector axes[3] = {frame->x, frame->y, frame->z};
    pattern->lanes |= 1u << lane;
    for (size_t axis = 0; axis < 3; ++axis) {
        pattern->frame[axis][0][lane] = axes[axis].x;
        pattern->frame[axis][1][lane] = axes[axis].y;
        pattern->frame[axis][2][lane] = axes[axis].z;
    }
}

static void set_colours(merged *work, size_t lane, const aur_gather_shading_point *point) {
    for (size_t k = 0; k < 2; ++k)
        for (size_t c = 0; c < 3; ++c)
            work->colours[lane][k][c] = point->colours[k][c];
}

static void set_merged(merged *work, size_t lane, const aur_gather_shading_point *point,
                       aur_gather_sweep *sweep) {
    const lab_merged_rule *const rule = ((const merged_state *)point->state)->rule;
    const lab_vector normal = lab_vector_of(point->axes[0]), mirror = lab_vector_of(point->axes[1]);
    lab_frame frames[2];
    lab_merged_rule_frames(normal, mirror, point->mirrored, frames);
    work->rule[lane] = rule;
    work->axes[lane][0] = normal;
    work->axes[lane][1] = mirror;
    work->times_cosine[lane] = point->times_cosine ? 1.0f : 0.0f;
    set_colours(work, lane, point);
    for (size_t k = 0; k < 2; ++k) {
        merged_pattern *const pattern = &work->patterns[k];
        const lab_merged_rule *const from = k == 0 ? work->state->first : rule;
        const size_t first = point->rotation * rule->count[k] + work->subset * rule->subset_count[k];
        for (size_t c = 0; c < 3; ++c)
            pattern->directions[c][lane] = from->direction[k][c] + first;
        pattern->stride[lane] = 1;
        set_frame(pattern, lane, &frames[k]);
    }
    float *const looked_up = weights_of(work, 2, 0);
    if (!lab_merged_rule_weights(rule, point->rotation, work->subset, lab_dot(normal, mirror), looked_up))
        aur_gather_count_unsolved(sweep);
    for (size_t i = 0; i < 2 * work->samples; ++i)
        work->weights[i * LANES + lane] = looked_up[i];
}

/* A diffuse shading point uses its rule's directions and weights. */
static void set_diffuse(merged *work, size_t lane, const aur_gather_shading_point *point) {
    const aur_gather_directions *const rule = &work->state->pattern;
    const size_t parts = work->state->subsets, first = point->first + work->subset;
    const lab_frame about = lab_frame_about(lab_vector_of(point->axes[0]));
    const lab_frame rotated = {lab_add_scaled(lab_scale(about.x, point->cosine), point->sine, about.y),
                               lab_add_scaled(lab_scale(about.y, point->cosine), -point->sine, about.x),
                               about.z};
    const float *const directions[3] = {rule->x, rule->y, rule->z};
    set_frame(&work->patterns[0], lane, &rotated);
    for (size_t c = 0; c < 3; ++c)
        work->patterns[0].directions[c][lane] = directions[c] + first;
    work->densities[lane] = rule->densities + first;
    work->patterns[0].stride[lane] = parts;
    set_colours(work, lane, point);
    for (size_t i = 0; i < work->subset_count[0]; ++i)
        weights_of(work, 0, i)[lane] = rule->weights[first + i * parts] / (float)work->subset_count[0];
    for (size_t i = work->subset_count[0]; i < 2 * work->samples; ++i)
        work->weights[i * LANES + lane] = 0.0f;
}

/* Determines whether all lanes have the same directions. Lanes without any copy the first lane's, so that
 * loops over all lanes read valid memory; their results are masked out. */
static void finish_pattern(merged_pattern *pattern) {
    size_t first = 0;
    while (!has_lane(pattern->lanes, first))
        ++first;
    pattern->uniform = true;
    for (size_t lane = 0; lane < LANES; ++lane) {
        if (!has_lane(pattern->lanes, lane)) {
            pattern->stride[lane] = pattern->stride[first];
            for (size_t c = 0; c < 3; ++c)
                pattern->directions[c][lane] = pattern->directions[c][first];
        }
        pattern->uniform = pattern->uniform && pattern->directions[0][lane] == pattern->directions[0][first];
    }
}

/* Sets frames, directions and weights of all lanes; returns the lanes that are gathered: none without pairs.
 */
static uint32_t prepare(merged *work, aur_gather_sweep *sweep) {
    aur_gather_shading_point points[LANES];
    uint32_t described = 0, pairs = 0;
    for (size_t lane = 0; lane < LANES; ++lane) {
        if (!aur_gather_describe(sweep, lane, &points[lane]))
            continue;
        described |= 1u << lane;
        pairs |= (uint32_t)(points[lane].state != NULL) << lane;
    }
    if (pairs == 0)
        return 0;
    for (size_t lane = 0; lane < LANES; ++lane)
        if (has_lane(pairs, lane))
            set_merged(work, lane, &points[lane], sweep);
        else if (has_lane(described, lane))
            set_diffuse(work, lane, &points[lane]);
    work->diffuse = described & ~pairs;
    for (size_t k = 0; k < 2; ++k)
        finish_pattern(&work->patterns[k]);
    return described;
}

/* Direction `index` of a pattern's part in every lane's frame, and densities. */
static void set_directions(const merged *work, size_t k, size_t index, float directions[3][LANES],
                           float densities[LANES]) {
    const merged_pattern *const pattern = &work->patterns[k];
    const float(*const frame)[3][LANES] = pattern->frame;
    float local[3][LANES];
    for (size_t c = 0; c < 3; ++c) {
        const float *const *const from = pattern->directions[c];
        const float one = from[0][index * pattern->stride[0]];
        for (size_t lane = 0; lane < LANES; ++lane)
            local[c][lane] = pattern->uniform ? one : from[lane][index * pattern->stride[lane]];
    }
    for (size_t c = 0; c < 3; ++c)
        for (size_t lane = 0; lane < LANES; ++lane)
            directions[c][lane] = frame[0][c][lane] * local[0][lane] + frame[1][c][lane] * local[1][lane] +
                                  frame[2][c][lane] * local[2][lane];
    for (size_t lane = 0; lane < LANES; ++lane) {
        const lab_vector direction = {directions[0][lane], directions[1][lane], directions[2][lane]};
        densities[lane] = 0.0f;
        if (has_lane(work->diffuse, lane))
            densities[lane] =
                work->densities[lane][index * pattern->stride[lane]] * (float)work->subset_count[0];
        else if (has_lane(pattern->lanes, lane))
            densities[lane] =
                lab_merged_rule_density(work->rule[lane], lab_dot(work->axes[lane][0], direction),
                                        lab_dot(work->axes[lane][1], direction));
    }
}

static void add_radiance(merged *work, size_t sample, const float cosines[LANES],
                         const float radiance[3][LANES]) {
    const float *restrict diffuse = weights_of(work, 0, sample);
    const float *restrict glossy = weights_of(work, 1, sample);
    const float *restrict times = work->times_cosine;
    for (size_t c = 0; c < 3; ++c) {
        const float *restrict added = radiance[c];
        float *restrict diffuse_sum = work->sum[0][c], *restrict glossy_sum = work->sum[1][c];
        for (size_t k = 0; k < LANES; ++k) {
            diffuse_sum[k] += diffuse[k] * added[k];
            glossy_sum[k] += (1.0f + times[k] * (cosines[k] - 1.0f)) * (glossy[k] * added[k]);
        }
    }
}

static void trace_pattern(merged *work, size_t k, aur_gather_sweep *sweep) {
    for (size_t i = 0; i < work->subset_count[k]; ++i) {
        const size_t sample = k * work->subset_count[0] + i;
        float directions[3][LANES], densities[LANES], cosines[LANES], radiance[3][LANES];
        set_directions(work, k, i, directions, densities);
        if (aur_gather_trace_directions(sweep, work->patterns[k].lanes, sample,
                                        (const float(*)[LANES])directions, densities, cosines, radiance) != 0)
            add_radiance(work, sample, cosines, (const float(*)[LANES])radiance);
    }
}

uint32_t lab_merged_gather(const void *diffuse, uint32_t lanes, aur_gather_sweep *sweep, float *memory) {
    (void)lanes;
    const merged_state *const state = diffuse;
    const lab_merged_rule *const first = state->first;
    merged work = {.state = state,
                   .subset = aur_gather_subset(sweep),
                   .subset_count = {first->subset_count[0], first->subset_count[1]},
                   .samples = lab_merged_rule_samples(first),
                   .weights = memory};
    const uint32_t gathered = prepare(&work, sweep);
    for (size_t k = 0; k < 2 && gathered != 0; ++k)
        trace_pattern(&work, k, sweep);
    for (size_t lane = 0; lane < LANES; ++lane) {
        if (!has_lane(gathered, lane))
            continue;
        float reflected[3] = {0};
        for (size_t k = 0; k < 2; ++k)
            for (size_t c = 0; c < 3; ++c)
                reflected[c] += work.sum[k][c][lane] * work.colours[lane][k][c];
        aur_gather_reflect(sweep, lane, reflected);
    }
    return gathered;
}
