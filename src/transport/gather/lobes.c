/* Gathering at the places of a group: which turn of a pattern each lane has, and its directions traced. */
#include "transport/gather/estimate_merged.h"
#include "transport/gather/group.h"
#include "transport/lights/shading.h"

/* --- randomisations of the patterns
 * ----------------------------------------------------------------------------- */

/* Whether the pixels of a block gather with parts of one pattern. */
static bool shares_pattern(const aur_group *group, const aur_gather_rule *rule) {
    const aur_final_gather *const data = group->task->data;
    return data->shares_irradiance && rule == &data->diffuse && group->chain == 0;
}

aur_gather_turn aur_group_turn(const aur_group *group, const aur_gather_rule *rule, size_t lane,
                               uint64_t lobe) {
    const aur_final_gather *const data = group->task->data;
    if (data->decorrelation == AUR_DECORRELATION_NONE)
        return aur_gather_rule_turn(rule, 0);
    if (data->decorrelation == AUR_DECORRELATION_RANDOM || rule->rotations == 0) {
        const uint64_t pixel = group->samples[lane].stream.pixel;
        return aur_gather_rule_turn(rule, aur_hash4(data->pattern_seed, pixel, group->chain, lobe));
    }
    uint64_t tile =
        aur_hash4(data->pattern_seed, aur_hash2(group->task->y, group->task->x), group->chain, lobe);
    /* Where the samples of a pixel do not share a pattern out, each has it turned anew. */
    if (data->adaptive)
        tile = aur_hash2(tile, group->task->index);
    const uint32_t order = shares_pattern(group, rule) ? 0 : aur_group_rank(group->task->group);
    /* Sixteen patterns would show as texture, were they the same in every tile. */
    if (rule->scramble != AUR_SCRAMBLE_ROTATE) {
        const uint64_t k = (order ^ (tile & 15u)) * rule->rotations / 16;
        aur_gather_turn turn = aur_gather_rule_turn(rule, k);
        turn.word_v ^= rule->scramble != AUR_SCRAMBLE_NONE ? (uint32_t)(tile >> 32) : 0;
        return turn;
    }
    aur_gather_turn turn = aur_gather_rule_turn(rule, order * rule->rotations / 16);
    turn.word_v ^= (uint32_t)(tile >> 32);
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)tile);
    return aur_gather_turn_by(turn, cosf(angle), sinf(angle));
}

static bool shares_turns(const aur_group *group, const aur_gather_rule *rule) {
    const size_t how = group->task->data->decorrelation;
    return rule->square == NULL && (how == AUR_DECORRELATION_NONE || rule->scramble == AUR_SCRAMBLE_NONE ||
                                    (how == AUR_DECORRELATION_BLUE && rule->rotations > 0));
}

/* --- gathering
 * -------------------------------------------------------------------------------------------------- */

static bool gathers(const aur_final_gather *data) {
    return data->map != NULL ||
           (data->max_depth >= 2 && (aur_gathers_emitters(data) || data->direct == AUR_DIRECT_NEE));
}

bool aur_group_gathers(const aur_final_gather *data, const aur_bsdf_lobe *lobe) {
    if (!gathers(data) || lobe->shape == AUR_LOBE_SHAPE_SPECULAR)
        return false;
    return data->component == AUR_COMPONENT_ALL ||
           lobe->diffuse == (data->component == AUR_COMPONENT_DIFFUSE);
}

void aur_group_set_frame(aur_group *group, size_t lane, const aur_frame *frame, aur_lobe_frames *frames) {
    struct RTCRay16 *const rays = &group->rays.packet.query.ray;
    const aur_gather_place *const p = &group->places[lane];
    aur_set_column(frames->x, lane, frame->x);
    aur_set_column(frames->y, lane, frame->y);
    aur_set_column(frames->z, lane, frame->z);
    aur_set_column(frames->shading, lane, aur_vector_scale(p->surface.frame.z, p->side));
    aur_set_column(frames->geometric, lane, aur_vector_scale(p->surface.geometric_normal, p->side));
    rays->org_x[lane] = p->origin.x;
    rays->org_y[lane] = p->origin.y;
    rays->org_z[lane] = p->origin.z;
    rays->tnear[lane] = 0.0f;
    group->rays.reference[lane] = p->surface.position;
}

static void set_frames(aur_group *group, uint32_t lanes, size_t lobe, aur_lobe_frames *frames) {
    memset(frames, 0, sizeof *frames);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_place *const p = &group->places[lane];
        const aur_frame frame = aur_frame_about(aur_frame_to_world(&p->surface.frame, p->lobes[lobe].axis));
        aur_group_set_frame(group, lane, &frame, frames);
        frames->times_cosine[lane] = p->lobes[lobe].times_cosine;
    }
}

uint32_t aur_group_aim(aur_group *group, uint32_t lanes, const aur_lobe_frames *restrict frames,
                       float local[3][AUR_PACKET_SIZE], float cosine[AUR_PACKET_SIZE]) {
    struct RTCRay16 *const rays = &group->rays.packet.query.ray;
    float above[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float x = local[0][k], y = local[1][k], z = local[2][k];
        const float dx = frames->x[0][k] * x + frames->y[0][k] * y + frames->z[0][k] * z;
        const float dy = frames->x[1][k] * x + frames->y[1][k] * y + frames->z[1][k] * z;
        const float dz = frames->x[2][k] * x + frames->y[2][k] * y + frames->z[2][k] * z;
        cosine[k] = frames->shading[0][k] * dx + frames->shading[1][k] * dy + frames->shading[2][k] * dz;
        const float beyond =
            frames->geometric[0][k] * dx + frames->geometric[1][k] * dy + frames->geometric[2][k] * dz;
        above[k] = beyond < cosine[k] ? beyond : cosine[k];
        rays->dir_x[k] = dx;
        rays->dir_y[k] = dy;
        rays->dir_z[k] = dz;
        rays->tfar[k] = INFINITY;
    }
    uint32_t aimed = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const bool wanted = (lanes >> k & 1u) != 0 && above[k] > 0.0f;
        group->rays.packet.valid[k] = wanted ? -1 : 0;
        aimed |= (uint32_t)wanted << k;
    }
    return aimed;
}

/* What lobes that dip below the surface are multiplied by; 1 for the others. */
static void horizon_factors(const aur_group *group, const aur_gather_rule *rule, uint32_t lanes,
                            const aur_lobe_frames *frames, const aur_gather_turn turns[AUR_PACKET_SIZE],
                            float factors[AUR_PACKET_SIZE]) {
    const aur_final_gather *const data = group->task->data;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        factors[lane] = 1.0f;
        if (rule == &data->diffuse || data->horizons == NULL)
            continue;
        aur_vector normal = {0};
        for (size_t c = 0; c < 3; ++c) {
            normal.x += frames->shading[c][lane] * frames->x[c][lane];
            normal.y += frames->shading[c][lane] * frames->y[c][lane];
            normal.z += frames->shading[c][lane] * frames->z[c][lane];
        }
        factors[lane] =
            aur_gather_horizon_factor(rule, data->horizons[rule - data->glossy], &turns[lane], normal);
    }
}

uint32_t aur_group_trace_direction(aur_group *group, const aur_rule_walk *walk, size_t index,
                                   float factor[AUR_PACKET_SIZE]) {
    const aur_gather_rule *const rule = walk->rule;
    float local[3][AUR_PACKET_SIZE] = {0}, cosine[AUR_PACKET_SIZE], weight[AUR_PACKET_SIZE] = {0};
    if (walk->shared) {
        aur_vector direction;
        const aur_gather_turn *const turn = &walk->turns[aur_first_lane(walk->lanes)];
        const float one = aur_gather_direction(rule, turn, index, &direction);
        const float density = rule->densities[turn->first + index] * walk->share;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            local[0][k] = direction.x;
            local[1][k] = direction.y;
            local[2][k] = direction.z;
            weight[k] = one;
            group->rays.density[k] = density;
        }
    } else {
        for (uint32_t rest = walk->lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            aur_vector direction;
            weight[lane] = aur_gather_direction(rule, &walk->turns[lane], index, &direction);
            aur_set_column(local, lane, direction);
            group->rays.density[lane] =
                walk->share * (rule->square != NULL ? aur_gather_density(rule, direction.z)
                                                    : rule->densities[walk->turns[lane].first + index]);
        }
    }
    const uint32_t aimed = aur_group_aim(group, walk->lanes, &walk->frames, local, cosine);
    if (aimed == 0)
        return 0;
    group->rays.hash = aur_hash3(group->samples[aur_first_lane(walk->lanes)].stream.pixel, index, walk->lobe);
    aur_gather_trace(group->task->data, walk->order, &group->rays, group->counters);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        factor[k] = (walk->weighs ? weight[k] : 1.0f) * (walk->frames.times_cosine[k] ? cosine[k] : 1.0f);
    for (uint32_t rest = walk->factored & aimed; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        factor[lane] *= aur_lobe_factor(&group->places[lane].lobes[walk->lobe], cosine[lane]);
    }
    return aimed;
}

static void start_walk(aur_group *group, const aur_gather_rule *rule, size_t lobe, uint32_t lanes,
                       aur_rule_walk *walk) {
    *walk = (aur_rule_walk){.rule = rule,
                            .lobe = lobe,
                            .lanes = lanes,
                            .shared = shares_turns(group, rule),
                            .weighs = true,
                            .share = aur_final_gather_share(group->task->data, rule),
                            .order = group->flat ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT};
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (group->places[lane].lobes[lobe].factor != NULL)
            walk->factored |= 1u << lane;
        walk->turns[lane] = walk->shared && lane != aur_first_lane(lanes)
                                ? walk->turns[aur_first_lane(lanes)]
                                : aur_group_turn(group, rule, lane, lobe);
    }
    set_frames(group, lanes, lobe, &walk->frames);
}

/* The lobes' integrals over the hemisphere by this sample's share of a rule, added to the lanes' sums. */
static void keep_for_sharing(aur_group *group, const aur_rule_walk *walk, size_t lane, aur_vector gathered) {
    const aur_gather_place *const p = &group->places[lane];
    group->shared |= 1u << lane;
    group->irradiance[lane] = aur_vector_scale(gathered, 1.0f / walk->share);
    group->coefficient[lane] = aur_vector_multiply(group->throughput[lane], p->lobes[walk->lobe].coefficient);
    group->shared_position[lane] = p->surface.position;
    group->shared_normal[lane] = aur_vector_scale(p->surface.frame.z, p->side);
}

static void gather_share(aur_group *group, const aur_rule_walk *walk) {
    float factors[AUR_PACKET_SIZE];
    horizon_factors(group, walk->rule, walk->lanes, &walk->frames, walk->turns, factors);
    const bool split = shares_pattern(group, walk->rule);
    size_t shares = group->task->data->samples_per_pixel, share = group->task->index % shares;
    if (split) {
        share = share * AUR_PACKET_SIZE + aur_group_rank(group->task->group);
        shares *= AUR_PACKET_SIZE;
    }
    float sum[3][AUR_PACKET_SIZE] = {0};
    for (size_t i = share; i < walk->rule->count; i += shares) {
        float factor[AUR_PACKET_SIZE];
        if (aur_group_trace_direction(group, walk, i, factor) == 0)
            continue;
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                sum[c][k] += factor[k] * group->rays.radiance[c][k];
    }
    for (uint32_t rest = walk->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_vector gathered = {sum[0][lane], sum[1][lane], sum[2][lane]};
        if (split) {
            keep_for_sharing(group, walk, lane, gathered);
            continue;
        }
        const aur_vector reflected =
            aur_vector_multiply(gathered, group->places[lane].lobes[walk->lobe].coefficient);
        group->sum[lane] = aur_vector_add_scaled(group->sum[lane], factors[lane] / walk->share,
                                                 aur_vector_multiply(group->throughput[lane], reflected));
    }
}

static void gather_rule(aur_group *group, const aur_gather_rule *rule, size_t lobe, uint32_t lanes) {
    aur_rule_walk walk;
    start_walk(group, rule, lobe, lanes, &walk);
    const aur_gather_levels *const levels = aur_final_gather_levels(group->task->data, rule);
    if (levels == NULL) {
        gather_share(group, &walk);
        return;
    }
    walk.weighs = false;
    aur_group_gather_adaptive(group, &walk, levels);
}

/* A draw of a place's sampled lobe becomes the lane's ray; false: there is none. */
static bool aim_sampled(aur_group *group, size_t lane, const float u[3], float share, aur_vector *value) {
    const aur_gather_place *const p = &group->places[lane];
    aur_bsdf_sample drawn;
    if (!aur_bsdf_draw(p->surface.bsdf, AUR_BSDF_SAMPLED_LOBES, p->surface.texture, p->view, u, &drawn) ||
        !(drawn.pdf > 0.0f))
        return false;
    const aur_vector light = aur_frame_to_world(&p->surface.frame, drawn.light);
    if (aur_vector_dot(p->surface.geometric_normal, light) * drawn.light.z <= 0.0f)
        return false;
    *value = aur_vector_scale(drawn.weight, 1.0f / share);
    const aur_ray ray = aur_surface_ray(&p->surface, light);
    aur_packet_set(&group->rays.packet, lane, &ray);
    group->rays.density[lane] = drawn.pdf * share;
    group->rays.reference[lane] = p->surface.position;
    return true;
}

/* Lobes that have no formula, by the pattern's points of the square and the BSDF's own sampling. */
static void gather_sampled(aur_group *group, size_t lobe, uint32_t lanes) {
    const aur_final_gather *const data = group->task->data;
    aur_rule_walk walk;
    start_walk(group, &data->visible, lobe, lanes, &walk);
    const size_t shares = data->samples_per_pixel, first = group->task->index % shares;
    for (size_t i = first; i < walk.rule->count; i += shares) {
        aur_vector value[AUR_PACKET_SIZE];
        float u[3] = {0.0f, 0.0f, 0.0f};
        uint32_t aimed = 0;
        aur_packet_empty(&group->rays.packet);
        group->rays.hash = aur_hash3(group->samples[aur_first_lane(lanes)].stream.pixel, i, lobe);
        if (walk.shared)
            aur_gather_square(walk.rule, &walk.turns[aur_first_lane(lanes)], i, &u[1]);
        for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            if (!walk.shared)
                aur_gather_square(walk.rule, &walk.turns[lane], i, &u[1]);
            u[0] = aur_unit_float((uint32_t)aur_hash2(group->rays.hash, ~(uint64_t)lane));
            aimed |= (uint32_t)aim_sampled(group, lane, u, walk.share, &value[lane]) << lane;
        }
        if (aimed == 0)
            continue;
        aur_gather_trace(data, walk.order, &group->rays, group->counters);
        for (uint32_t rest = aimed; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            const aur_vector incident = {group->rays.radiance[0][lane], group->rays.radiance[1][lane],
                                         group->rays.radiance[2][lane]};
            const aur_vector reflected = aur_vector_multiply(value[lane], incident);
            group->sum[lane] =
                aur_vector_add(group->sum[lane], aur_vector_multiply(group->throughput[lane], reflected));
        }
    }
}

/* The lanes whose lobe number `lobe` is gathered as that of the first such lane is. */
static uint32_t lanes_alike(const aur_group *group, uint32_t lanes, size_t lobe,
                            const aur_gather_rule *rule) {
    uint32_t alike = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (aur_final_gather_rule(group->task->data, &group->places[lane].lobes[lobe]) == rule)
            alike |= 1u << lane;
    }
    return alike;
}

void aur_group_gather(aur_group *group) {
    const aur_final_gather *const data = group->task->data;
    if (!gathers(data))
        return;
    const uint32_t lanes = data->pair_count > 0 ? aur_group_gather_merged(group) : group->lanes;
    for (size_t lobe = 0; lobe < AUR_BSDF_LOBE_CAPACITY; ++lobe) {
        uint32_t ruled = 0, sampled = 0;
        for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            const aur_gather_place *const p = &group->places[lane];
            if (lobe >= p->lobe_count || !aur_group_gathers(data, &p->lobes[lobe]) ||
                !aur_is_there(p, &p->lobes[lobe]))
                continue;
            if (p->lobes[lobe].shape == AUR_LOBE_SHAPE_SAMPLED)
                sampled |= 1u << lane;
            else
                ruled |= 1u << lane;
        }
        while (ruled != 0) {
            const aur_gather_rule *const rule =
                aur_final_gather_rule(data, &group->places[aur_first_lane(ruled)].lobes[lobe]);
            const uint32_t alike = lanes_alike(group, ruled, lobe, rule);
            gather_rule(group, rule, lobe, alike);
            ruled &= ~alike;
        }
        if (sampled != 0)
            gather_sampled(group, lobe, sampled);
    }
}
