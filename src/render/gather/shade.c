/* Radiance that leaves the shading points by all of their lobes, each by the estimator that the plan assigns.
 */
#include "points/base/random.h"
#include "render/gather/estimators.h"
#include "render/trace/interleave.h"
#include "render/vertex/shading.h"

/* --- the fixed rule: the same directions at every shading point except for their rotation */

/* What lobes that dip below the surface are multiplied by; 1 for the others. */
static float horizon_factor(const aur_gather_sweep *sweep, size_t lane) {
    const aur_lobe_frames *const frames = &sweep->frames;
    if (!sweep->rule->clipped)
        return 1.0f;
    const aur_frame frame = {aur_lane_vector(&frames->x, lane), aur_lane_vector(&frames->y, lane),
                             aur_lane_vector(&frames->z, lane)};
    const aur_vector normal = aur_frame_to_local(&frame, aur_lane_vector(&frames->shading, lane));
    return aur_gather_horizon_factor(&sweep->rule->rule, &sweep->rule->horizon, &sweep->rotations[lane],
                                     normal);
}

/* Keeps the gathered irradiance for the pool instead of adding it. */
static void add_to_pool(const aur_gather_points *surface_points, const aur_gather_sweep *sweep, size_t lane,
                        aur_vector gathered, aur_gather_sums *sums) {
    const aur_gather_point *const surface_point = &surface_points->at[lane];
    sums->pooled_lanes |= 1u << lane;
    sums->pooled[lane] =
        (aur_gather_pooled){.irradiance = aur_vector_scale(gathered, 1.0f / sweep->rule->directions),
                            .coefficient = aur_vector_multiply(surface_points->throughput[lane],
                                                               surface_point->lobes[sweep->lobe].coefficient),
                            .position = surface_point->surface.position,
                            .normal = aur_vector_scale(surface_point->surface.frame.z, surface_point->side)};
}

/* Sets the part of the rule's directions of each lane's sample; returns the number of parts. */
static size_t set_parts(aur_gather_sweep *sweep, const aur_gather_points *surface_points, bool splits) {
    size_t part = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if (k == 0 || !surface_points->grouped) {
            part = aur_gather_part(surface_points, k);
            if (splits)
                part = part * AUR_GROUP_COUNT + aur_group_rank(surface_points->group[k]);
        }
        sweep->part[k] = (uint32_t)part;
    }
    return surface_points->plan->samples_per_pattern * (splits ? AUR_GROUP_COUNT : 1);
}

/* Packets of directions whose radiance is computed before it is added: more paths wait together. */
enum { AHEAD = 8 };

/* By these samples' parts of the rule. */
static void by_rule(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule, size_t lobe,
                    uint32_t lanes, aur_gather_sums *sums) {
    aur_gather_sweep sweep;
    aur_gather_sweep_start(surface_points, rule, lobe, lanes, &sweep, &sums->rays);
    const size_t parts = set_parts(&sweep, surface_points, aur_gather_splits(surface_points, rule));
    float sum[3][AUR_PACKET_SIZE] = {0};
    for (size_t i = 0; i < rule->rule.count;) {
        float factor[AHEAD][AUR_PACKET_SIZE], radiance[AHEAD][3][AUR_PACKET_SIZE];
        size_t traced = 0;
        for (; i < rule->rule.count && traced < AHEAD; i += parts) {
            sums->rays.radiance = radiance[traced];
            traced += aur_gather_sweep_trace(surface_points, &sweep, i, true, sums, factor[traced]) != 0;
        }
        aur_gather_rays_finish(surface_points->plan, &sums->rays);
        for (size_t n = 0; n < traced; ++n)
            for (size_t c = 0; c < 3; ++c)
                for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                    sum[c][k] += factor[n][k] * radiance[n][c][k];
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_vector gathered = {sum[0][lane], sum[1][lane], sum[2][lane]};
        if (aur_gather_pools(surface_points, rule)) {
            add_to_pool(surface_points, &sweep, lane, gathered, sums);
            continue;
        }
        const aur_vector reflected =
            aur_vector_multiply(gathered, surface_points->at[lane].lobes[lobe].coefficient);
        sums->radiance[lane] =
            aur_vector_add_scaled(sums->radiance[lane], horizon_factor(&sweep, lane) / rule->directions,
                                  aur_vector_multiply(surface_points->throughput[lane], reflected));
    }
}

/* --- lobes without a formula: the rule's points of the square drive the BSDF's sampling */

/* Lobes without a formula, by sampling the BSDF. */
typedef struct sampled_packet {
    uint32_t aimed;
    aur_vector value[AUR_PACKET_SIZE];
    float radiance[3][AUR_PACKET_SIZE];
} sampled_packet;

/* Direction `index` of the lanes' parts; returns those that have a ray. */
static uint32_t trace_sampled(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                              size_t index, aur_gather_sums *sums, sampled_packet *packet) {
    const aur_gather_lobe_rule *const sampled = sweep->rule;
    const size_t first = aur_first_lane(sweep->lanes);
    aur_gather_rays *const rays = &sums->rays;
    float u[3] = {0.0f, 0.0f, 0.0f}, unused;
    packet->aimed = 0;
    aur_packet_empty(&rays->packet);
    aur_gather_set_probability(surface_points, sweep, index, rays);
    if (sweep->together && index + sweep->part[first] < sampled->rule.count)
        aur_gather_rule_square(&sampled->rule, &sweep->rotations[first], index + sweep->part[first], &u[1]);
    for (uint32_t rest = sweep->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest), number = index + sweep->part[lane];
        if (number >= sampled->rule.count)
            continue;
        if (!sweep->together)
            aur_gather_rule_square(&sampled->rule, &sweep->rotations[lane], number, &u[1]);
        u[0] = aur_unit_float((uint32_t)aur_mix64(aur_gather_rays_hash(rays, lane)));
        packet->aimed |=
            (uint32_t)aur_gather_aim_draw(&surface_points->at[lane], lane, u, sampled->directions, rays,
                                          &packet->value[lane], &unused)
            << lane;
    }
    rays->radiance = packet->radiance;
    if (packet->aimed != 0)
        aur_gather_rays_trace(surface_points->plan, surface_points->order, rays, sums->counters);
    return packet->aimed;
}

static void by_sampling(const aur_gather_points *surface_points, size_t lobe, uint32_t lanes,
                        aur_gather_sums *sums) {
    const aur_gather_plan *const plan = surface_points->plan;
    const aur_gather_lobe_rule *const sampled = &plan->rules.sampled;
    aur_gather_sweep sweep;
    aur_gather_sweep_start(surface_points, sampled, lobe, lanes, &sweep, &sums->rays);
    const size_t parts = set_parts(&sweep, surface_points, false);
    for (size_t i = 0; i < sampled->rule.count;) {
        sampled_packet packets[AHEAD];
        size_t traced = 0;
        for (; i < sampled->rule.count && traced < AHEAD; i += parts)
            traced += trace_sampled(surface_points, &sweep, i, sums, &packets[traced]) != 0;
        aur_gather_rays_finish(plan, &sums->rays);
        for (size_t n = 0; n < traced; ++n)
            for (uint32_t rest = packets[n].aimed; rest != 0; rest &= rest - 1) {
                const size_t lane = aur_first_lane(rest);
                const aur_vector incident = {packets[n].radiance[0][lane], packets[n].radiance[1][lane],
                                             packets[n].radiance[2][lane]};
                aur_gather_add(sums, surface_points, lane,
                               aur_vector_multiply(packets[n].value[lane], incident));
            }
    }
}

/* --- all lobes */

/* The subset of `lanes` whose lobe `lobe` is gathered by the rule. */
static uint32_t lanes_of_rule(const aur_gather_points *surface_points, uint32_t lanes, size_t lobe,
                              const aur_gather_lobe_rule *rule) {
    uint32_t found = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (surface_points->at[lane].rules[lobe] == rule)
            found |= 1u << lane;
    }
    return found;
}

/* Gathers for lobe `lobe` of all lanes that have it. */
static void gather_lobe(const aur_gather_points *surface_points, uint32_t lanes, size_t lobe,
                        aur_gather_sums *sums) {
    uint32_t ruled = 0, sampled = 0, ggx = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_point *const surface_point = &surface_points->at[lane];
        const aur_bsdf_lobe *const bsdf_lobe = &surface_point->lobes[lobe];
        if (lobe >= surface_point->lobe_count || !aur_gather_plan_gathers(surface_points->plan, bsdf_lobe) ||
            !aur_gather_point_has(surface_point, lobe))
            continue;
        if (bsdf_lobe->shape == AUR_LOBE_SHAPE_SAMPLED && surface_point->ggx != NULL)
            ggx |= 1u << lane;
        else if (bsdf_lobe->shape == AUR_LOBE_SHAPE_SAMPLED)
            sampled |= 1u << lane;
        else
            ruled |= 1u << lane;
    }
    while (ruled != 0) {
        const aur_gather_lobe_rule *const rule = surface_points->at[aur_first_lane(ruled)].rules[lobe];
        const uint32_t same_rule = lanes_of_rule(surface_points, ruled, lobe, rule);
        if (surface_points->plan->rules.whole)
            aur_gather_by_method(surface_points, rule, lobe, same_rule, sums);
        else
            by_rule(surface_points, rule, lobe, same_rule, sums);
        ruled &= ~same_rule;
    }
    if (ggx != 0)
        aur_gather_by_ggx(surface_points, lobe, ggx, sums);
    if (sampled != 0)
        by_sampling(surface_points, lobe, sampled, sums);
}

void aur_gather_shade(const aur_gather_points *surface_points, aur_gather_sums *sums) {
    const aur_gather_plan *const plan = surface_points->plan;
    if (plan->policy.direct == AUR_DIRECT_NEE && plan->policy.max_depth >= 2 &&
        aur_scene_emitter_count(plan->scene) > 0)
        aur_gather_add_direct_light(surface_points, sums);
    if (plan->light.bright_draws > 0)
        aur_gather_add_bright_light(surface_points, sums);
    if (!plan->gathers)
        return;
    const uint32_t lanes = plan->rules.pairs ? aur_gather_pairs(surface_points, sums) : surface_points->lanes;
    for (size_t lobe = 0; lobe < AUR_BSDF_LOBE_CAPACITY && lanes != 0; ++lobe)
        gather_lobe(surface_points, lanes, lobe, sums);
}
