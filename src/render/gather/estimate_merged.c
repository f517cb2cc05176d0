/* Shading points with a diffuse and one glossy lobe: the rays of both patterns count for both lobes. Lanes
 * with different glossy lobes are processed together, and diffuse points among them trace their single
 * pattern in the same packets, because a packet costs nearly the same for few lanes as for many. */
#include "points/base/random.h"
#include "render/gather/estimators.h"
#include "render/trace/interleave.h"

/* One pattern's part of this sample, and the lanes that send it. */
typedef struct merged_pattern {
    uint32_t lanes;
    bool uniform; /* all lanes have the same local directions */
    const float *directions[3][AUR_PACKET_SIZE];
    size_t stride[AUR_PACKET_SIZE]; /* from one direction to the next */
    aur_lobe_frames frames;
} merged_pattern;

/* One subset of both patterns at the shading points of a group. */
typedef struct merged {
    const aur_gather_points *surface_points;
    merged_pattern patterns[2];
    uint32_t diffuse;                        /* lanes that send the first pattern only, their rule's */
    size_t subset;                           /* this sample's */
    size_t subset_count[2], samples;         /* directions in a subset, of each pattern and of both */
    float *weights;                          /* see aur_gather_sums */
    const float *densities[AUR_PACKET_SIZE]; /* of the first pattern's directions, in diffuse lanes */
    aur_vector coefficients[AUR_PACKET_SIZE][2];
    float times_cosine[AUR_PACKET_SIZE]; /* 1: the glossy lobe's integrand includes the cosine; else 0 */
    float sum[2][3][AUR_PACKET_SIZE];    /* of weight * radiance, by lobe and channel */
} merged;

/* The weights of a sample for a lobe, one per lane. Values of inactive lanes are never used. */
static float *weights_of(const merged *work, size_t lobe, size_t sample) {
    return work->weights + (lobe * work->samples + sample) * AUR_PACKET_SIZE;
}

static void set_merged(merged *work, size_t lane, aur_gather_rays *rays, aur_counters *counters) {
    const aur_gather_point *const surface_point = &work->surface_points->at[lane];
    const aur_merged_rule *const rule = surface_point->merged;
    const size_t *const lobes = surface_point->merged_lobes;
    const aur_vector normal = aur_gather_point_axis(surface_point, lobes[0]);
    const aur_vector mirror = aur_gather_point_axis(surface_point, lobes[1]);
    bool mirrored;
    aur_frame frames[2];
    const size_t rotation =
        aur_gather_prepared_rotation(work->surface_points, rule->rotations, lane, &mirrored);
    aur_merged_rule_frames(normal, mirror, mirrored, frames);
    rays->merged[lane] = rule;
    rays->axes[lane][0] = normal;
    rays->axes[lane][1] = mirror;
    work->times_cosine[lane] = surface_point->lobes[lobes[1]].times_cosine ? 1.0f : 0.0f;
    for (size_t k = 0; k < 2; ++k) {
        merged_pattern *const pattern = &work->patterns[k];
        const aur_merged_rule *const from = k == 0 ? work->surface_points->plan->rules.merged : rule;
        const size_t first = rotation * rule->count[k] + work->subset * rule->subset_count[k];
        for (size_t c = 0; c < 3; ++c)
            pattern->directions[c][lane] = from->direction[k][c] + first;
        pattern->stride[lane] = 1;
        aur_gather_set_frame(surface_point, lane, &frames[k], &pattern->frames, rays);
        if (aur_gather_plan_gathers(work->surface_points->plan, &surface_point->lobes[lobes[k]]))
            work->coefficients[lane][k] = surface_point->lobes[lobes[k]].coefficient;
    }
    float *const looked_up = weights_of(work, 2, 0);
    if (!aur_merged_rule_weights(rule, rotation, work->subset, aur_vector_dot(normal, mirror), looked_up))
        ++counters->unsolved;
    for (size_t i = 0; i < 2 * work->samples; ++i)
        work->weights[i * AUR_PACKET_SIZE + lane] = looked_up[i];
}

/* A diffuse shading point uses its rule's directions and weights. */
static void set_diffuse(merged *work, size_t lane, size_t lobe, aur_gather_rays *rays) {
    const aur_gather_lobe_rule *const lobe_rule = &work->surface_points->plan->rules.lobes[0];
    const aur_gather_rule *const rule = &lobe_rule->rule;
    const aur_gather_point *const surface_point = &work->surface_points->at[lane];
    const size_t parts = work->surface_points->plan->samples_per_pattern;
    const aur_gather_rotation rotation = aur_gather_rotation_at(work->surface_points, lobe_rule, lane, lobe);
    const aur_frame about = aur_frame_about(aur_gather_point_axis(surface_point, lobe));
    const aur_frame rotated = {
        aur_vector_add_scaled(aur_vector_scale(about.x, rotation.cosine), rotation.sine, about.y),
        aur_vector_add_scaled(aur_vector_scale(about.y, rotation.cosine), -rotation.sine, about.x), about.z};
    aur_gather_set_frame(surface_point, lane, &rotated, &work->patterns[0].frames, rays);
    const size_t first = rotation.first + work->subset;
    const float *const directions[3] = {rule->x, rule->y, rule->z};
    for (size_t c = 0; c < 3; ++c)
        work->patterns[0].directions[c][lane] = directions[c] + first;
    work->densities[lane] = rule->densities + first;
    work->patterns[0].stride[lane] = parts;
    work->coefficients[lane][0] = surface_point->lobes[lobe].coefficient;
    for (size_t i = 0; i < work->subset_count[0]; ++i)
        weights_of(work, 0, i)[lane] = rule->weights[first + i * parts] / (float)work->subset_count[0];
    for (size_t i = work->subset_count[0]; i < 2 * work->samples; ++i)
        work->weights[i * AUR_PACKET_SIZE + lane] = 0.0f;
}

/* Whether a shading point gathers for one diffuse lobe only; its number goes to `lobe`. */
static bool is_diffuse(const aur_gather_plan *plan, const aur_gather_point *surface_point, size_t *lobe) {
    size_t gathered = 0;
    bool diffuse = false;
    for (size_t i = 0; i < surface_point->lobe_count; ++i) {
        const aur_bsdf_lobe *const bsdf_lobe = &surface_point->lobes[i];
        const bool has_formula = bsdf_lobe->shape == AUR_LOBE_SHAPE_COSINE_POWER;
        if (!aur_gather_plan_gathers(plan, bsdf_lobe) || !aur_gather_point_has(surface_point, i))
            continue;
        ++gathered;
        diffuse =
            has_formula && bsdf_lobe->diffuse && bsdf_lobe->exponent == 1.0f && bsdf_lobe->factor == NULL;
        *lobe = i;
    }
    return gathered == 1 && diffuse && plan->rules.lobes[0].rule.square == NULL;
}

/* Determines whether all lanes have the same directions. Lanes without any copy the first lane's, so that
 * loops over all lanes read valid memory; their results are masked out. */
static void finish_pattern(merged_pattern *pattern) {
    const size_t first = aur_first_lane(pattern->lanes);
    pattern->uniform = true;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        if (!aur_has_lane(pattern->lanes, lane)) {
            pattern->stride[lane] = pattern->stride[first];
            for (size_t c = 0; c < 3; ++c)
                pattern->directions[c][lane] = pattern->directions[c][first];
        }
        pattern->uniform = pattern->uniform && pattern->directions[0][lane] == pattern->directions[0][first];
    }
}

/* Sets frames, directions and weights of all lanes; returns the lanes that this estimator handles. */
static uint32_t prepare(merged *work, aur_gather_rays *rays, aur_counters *counters) {
    const aur_gather_plan *const plan = work->surface_points->plan;
    const uint32_t lanes = work->surface_points->lanes;
    uint32_t merged_lanes = 0, diffuse = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (work->surface_points->at[lane].merged == NULL)
            continue;
        merged_lanes |= 1u << lane;
        set_merged(work, lane, rays, counters);
    }
    for (uint32_t rest = merged_lanes != 0 ? lanes & ~merged_lanes : 0; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        size_t lobe = 0;
        if (!is_diffuse(plan, &work->surface_points->at[lane], &lobe))
            continue;
        diffuse |= 1u << lane;
        set_diffuse(work, lane, lobe, rays);
    }
    work->diffuse = diffuse;
    work->patterns[0].lanes = merged_lanes | diffuse;
    work->patterns[1].lanes = merged_lanes;
    for (size_t k = 0; k < 2 && merged_lanes != 0; ++k)
        finish_pattern(&work->patterns[k]);
    return merged_lanes | diffuse;
}

/* Direction `index` of a pattern's part in every lane's frame. */
static void set_directions(const merged *work, size_t k, size_t index, aur_lane_vectors *local,
                           aur_gather_rays *rays) {
    const merged_pattern *const pattern = &work->patterns[k];
    float *const to[3] = {local->x, local->y, local->z};
    for (size_t c = 0; c < 3; ++c) {
        const float *const *const from = pattern->directions[c];
        const float one = from[0][index * pattern->stride[0]];
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
            to[c][lane] = pattern->uniform ? one : from[lane][index * pattern->stride[lane]];
    }
    for (uint32_t rest = k == 0 ? work->diffuse : 0; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        rays->density[lane] =
            work->densities[lane][index * pattern->stride[lane]] * (float)work->subset_count[0];
    }
}

static void add_radiance(merged *work, size_t sample, const float cosine[AUR_PACKET_SIZE],
                         const aur_gather_rays *rays) {
    const float *restrict diffuse = weights_of(work, 0, sample);
    const float *restrict glossy = weights_of(work, 1, sample);
    const float *restrict times = work->times_cosine;
    for (size_t c = 0; c < 3; ++c) {
        const float *restrict radiance = rays->radiance[c];
        float *restrict diffuse_sum = work->sum[0][c], *restrict glossy_sum = work->sum[1][c];
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            diffuse_sum[k] += diffuse[k] * radiance[k];
            glossy_sum[k] += (1.0f + times[k] * (cosine[k] - 1.0f)) * (glossy[k] * radiance[k]);
        }
    }
}

static void trace_pattern(merged *work, size_t k, aur_gather_sums *sums) {
    aur_gather_rays *const rays = &sums->rays;
    const merged_pattern *const pattern = &work->patterns[k];
    for (size_t i = 0; i < work->subset_count[k]; ++i) {
        const size_t sample = k * work->subset_count[0] + i;
        aur_lane_vectors local;
        float cosine[AUR_PACKET_SIZE];
        set_directions(work, k, i, &local, rays);
        if (aur_gather_aim(pattern->lanes, &pattern->frames, &local, &rays->packet, cosine) == 0)
            continue;
        aur_gather_set_probability(work->surface_points, 0, sample, rays);
        aur_gather_rays_trace(work->surface_points->plan, work->surface_points->order, rays, sums->counters);
        add_radiance(work, sample, cosine, rays);
    }
}

uint32_t aur_gather_by_merged(const aur_gather_points *surface_points, aur_gather_sums *sums) {
    const aur_merged_rule *const first = surface_points->plan->rules.merged;
    merged work = {.surface_points = surface_points,
                   .subset = aur_gather_part(surface_points),
                   .subset_count = {first->subset_count[0], first->subset_count[1]},
                   .samples = aur_merged_rule_samples(first),
                   .weights = sums->numbers};
    const uint32_t lanes = prepare(&work, &sums->rays, sums->counters);
    if (lanes == 0)
        return surface_points->lanes;
    for (size_t k = 0; k < 2; ++k)
        trace_pattern(&work, k, sums);
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        sums->rays.merged[lane] = NULL;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_vector reflected = {0};
        for (size_t k = 0; k < 2; ++k) {
            const aur_vector gathered = {work.sum[k][0][lane], work.sum[k][1][lane], work.sum[k][2][lane]};
            reflected = aur_vector_add(reflected, aur_vector_multiply(gathered, work.coefficients[lane][k]));
        }
        aur_gather_add(sums, surface_points, lane, reflected);
    }
    return surface_points->lanes & ~lanes;
}
