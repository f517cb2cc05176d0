/* Places with a diffuse and one glossy lobe, gathered with both patterns' rays for both lobes. Lanes with
 * different glossy lobes go together, and diffuse places among them send their one pattern in the same
 * packets: a packet costs nearly the same for few lanes as for many. */
#include "transport/gather/estimate_merged.h"

const aur_gather_pair *aur_group_pair(const aur_final_gather *data, const aur_gather_place *p,
                                      size_t lobes[2]) {
    if (data->pair_count == 0)
        return NULL;
    bool found[2] = {false, false};
    for (size_t i = 0; i < p->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &p->lobes[i];
        const size_t which = lobe->diffuse ? 0 : 1;
        if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR || aur_vector_is_zero(lobe->coefficient))
            continue;
        if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || lobe->factor != NULL || found[which] ||
            (which == 0 && lobe->exponent != 1.0f))
            return NULL;
        found[which] = true;
        lobes[which] = i;
    }
    for (size_t i = 0; found[0] && found[1] && i < data->pair_count; ++i)
        if ((float)data->pairs[i]->exponent == p->lobes[lobes[1]].exponent)
            return data->pairs[i];
    return NULL;
}

static aur_vector lobe_axis(const aur_gather_place *p, size_t lobe) {
    return aur_frame_to_world(&p->surface.frame, p->lobes[lobe].axis);
}

float aur_group_pair_density(const aur_gather_pair *pair, const aur_gather_place *p, const size_t lobes[2],
                             aur_vector local) {
    return aur_gather_pair_density(pair, aur_vector_dot(p->lobes[lobes[0]].axis, local),
                                   aur_vector_dot(p->lobes[lobes[1]].axis, local));
}

/* Which of the prepared turns a lane has, and whether mirrored. Under "blue" all lanes of the group have the
 * same. */
static size_t rotation_of(const aur_group *group, const aur_gather_pair *pair, size_t lane, bool *mirrored) {
    const aur_final_gather *const data = group->task->data;
    *mirrored = false;
    if (data->decorrelation == AUR_DECORRELATION_NONE)
        return 0;
    if (data->decorrelation == AUR_DECORRELATION_RANDOM) {
        const uint64_t pixel = group->samples[lane].stream.pixel;
        const uint64_t hash = aur_hash3(data->pattern_seed, pixel, group->chain);
        *mirrored = hash >> 63 != 0;
        return (hash & UINT32_MAX) % pair->rotations;
    }
    const uint64_t hash =
        aur_hash3(data->pattern_seed, aur_hash2(group->task->y, group->task->x), group->chain);
    *mirrored = hash >> 63 != 0;
    return (aur_group_rank(group->task->group) ^ (hash & 15u)) * pair->rotations / 16;
}

/* One pattern's share, and the lanes that send it. */
typedef struct merged_pattern {
    uint32_t lanes;
    bool alike; /* all have the same directions in their frames */
    const float *directions[3][AUR_PACKET_SIZE];
    size_t stride[AUR_PACKET_SIZE]; /* from one direction to the next */
    aur_lobe_frames frames;
} merged_pattern;

/* One share of both patterns at the places of a group. */
typedef struct merged {
    merged_pattern patterns[2];
    uint32_t diffuse;               /* lanes that send the first pattern only, their rule's */
    size_t share_count[2], samples; /* of each pattern and of both */
    size_t share;
    const float *densities[AUR_PACKET_SIZE]; /* of the first pattern's directions, in diffuse lanes */
    aur_vector coefficients[AUR_PACKET_SIZE][2];
    float times_cosine[AUR_PACKET_SIZE]; /* 1: what the glossy lobe gathers is times the cosine, else 0 */
    float sum[2][3][AUR_PACKET_SIZE];    /* of weight * radiance, by lobe and channel */
} merged;

/* The weights of sample i for a lobe stand one lane after another. What idle lanes have is never used. */
static float *weights_of(const aur_group *group, const merged *work, size_t lobe, size_t sample) {
    return group->merged + (lobe * work->samples + sample) * AUR_PACKET_SIZE;
}

static void set_pair(aur_group *group, merged *work, size_t lane, const aur_gather_pair *pair,
                     const size_t lobes[2]) {
    const aur_final_gather *const data = group->task->data;
    const aur_gather_place *const p = &group->places[lane];
    const aur_vector normal = lobe_axis(p, lobes[0]), mirror = lobe_axis(p, lobes[1]);
    bool mirrored;
    aur_frame frames[2];
    const size_t rotation = rotation_of(group, pair, lane, &mirrored);
    aur_gather_pair_frames(normal, mirror, mirrored, frames);
    group->rays.pairs[lane] = pair;
    group->rays.axes[lane][0] = normal;
    group->rays.axes[lane][1] = mirror;
    work->times_cosine[lane] = p->lobes[lobes[1]].times_cosine ? 1.0f : 0.0f;
    for (size_t k = 0; k < 2; ++k) {
        merged_pattern *const pattern = &work->patterns[k];
        /* Pairs differ in the glossy lobe alone: all have the first one's diffuse pattern. */
        const aur_gather_pair *const from = k == 0 ? data->pairs[0] : pair;
        const size_t first = rotation * pair->count[k] + work->share * pair->share_count[k];
        for (size_t c = 0; c < 3; ++c)
            pattern->directions[c][lane] = from->direction[k][c] + first;
        pattern->stride[lane] = 1;
        aur_group_set_frame(group, lane, &frames[k], &pattern->frames);
        if (aur_group_gathers(data, &p->lobes[lobes[k]]))
            work->coefficients[lane][k] = p->lobes[lobes[k]].coefficient;
    }
    float *const looked_up = group->merged + 2 * work->samples * AUR_PACKET_SIZE;
    aur_gather_pair_weights(pair, rotation, work->share, aur_vector_dot(normal, mirror), looked_up);
    for (size_t i = 0; i < 2 * work->samples; ++i)
        group->merged[i * AUR_PACKET_SIZE + lane] = looked_up[i];
}

/* A diffuse place has its rule's directions and weights. */
static void set_diffuse(aur_group *group, merged *work, size_t lane, size_t lobe) {
    const aur_final_gather *const data = group->task->data;
    const aur_gather_rule *const rule = &data->diffuse;
    const aur_gather_place *const p = &group->places[lane];
    const aur_gather_turn turn = aur_group_turn(group, rule, lane, lobe);
    const aur_frame about = aur_frame_about(lobe_axis(p, lobe));
    const aur_frame turned = {
        aur_vector_add_scaled(aur_vector_scale(about.x, turn.cosine), turn.sine, about.y),
        aur_vector_add_scaled(aur_vector_scale(about.y, turn.cosine), -turn.sine, about.x), about.z};
    aur_group_set_frame(group, lane, &turned, &work->patterns[0].frames);
    const size_t first = turn.first + work->share;
    const float *const directions[3] = {rule->x, rule->y, rule->z};
    for (size_t c = 0; c < 3; ++c)
        work->patterns[0].directions[c][lane] = directions[c] + first;
    work->densities[lane] = rule->densities + first;
    work->patterns[0].stride[lane] = data->samples_per_pixel;
    work->coefficients[lane][0] = p->lobes[lobe].coefficient;
    for (size_t i = 0; i < work->share_count[0]; ++i)
        weights_of(group, work, 0, i)[lane] =
            rule->weights[first + i * data->samples_per_pixel] / (float)work->share_count[0];
    for (size_t i = work->share_count[0]; i < 2 * work->samples; ++i)
        group->merged[i * AUR_PACKET_SIZE + lane] = 0.0f;
}

/* A place whose only light to gather is that of one diffuse lobe, its number in `lobe`. */
static bool is_diffuse(const aur_final_gather *data, const aur_gather_place *p, size_t *lobe) {
    size_t gathered = 0;
    bool diffuse = false;
    for (size_t i = 0; i < p->lobe_count; ++i) {
        if (!aur_group_gathers(data, &p->lobes[i]) || !aur_is_there(p, &p->lobes[i]))
            continue;
        ++gathered;
        diffuse = p->lobes[i].shape == AUR_LOBE_SHAPE_COSINE_POWER && p->lobes[i].diffuse &&
                  p->lobes[i].exponent == 1.0f && p->lobes[i].factor == NULL;
        *lobe = i;
    }
    return gathered == 1 && diffuse && data->diffuse.square == NULL;
}

/* Lanes without directions get some to read. */
static void finish_pattern(merged_pattern *pattern) {
    const size_t first = aur_first_lane(pattern->lanes);
    pattern->alike = true;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        if ((pattern->lanes >> lane & 1u) == 0) {
            pattern->stride[lane] = pattern->stride[first];
            for (size_t c = 0; c < 3; ++c)
                pattern->directions[c][lane] = pattern->directions[c][first];
        }
        pattern->alike = pattern->alike && pattern->directions[0][lane] == pattern->directions[0][first];
    }
}

/* Frames, directions and weights of all lanes; those that are served. */
static uint32_t prepare(aur_group *group, merged *work) {
    const aur_final_gather *const data = group->task->data;
    for (size_t k = 0; k < 2; ++k)
        work->share_count[k] = data->pairs[0]->share_count[k];
    work->samples = aur_gather_pair_share(data->pairs[0]);
    work->share = group->task->index % data->samples_per_pixel;
    uint32_t paired = 0, diffuse = 0;
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        size_t lobes[2] = {0, 0};
        const aur_gather_pair *const pair = aur_group_pair(data, &group->places[lane], lobes);
        if (pair == NULL)
            continue;
        paired |= 1u << lane;
        set_pair(group, work, lane, pair, lobes);
    }
    for (uint32_t rest = paired != 0 ? group->lanes & ~paired : 0; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        size_t lobe = 0;
        if (!is_diffuse(data, &group->places[lane], &lobe))
            continue;
        diffuse |= 1u << lane;
        set_diffuse(group, work, lane, lobe);
    }
    work->diffuse = diffuse;
    work->patterns[0].lanes = paired | diffuse;
    work->patterns[1].lanes = paired;
    for (size_t k = 0; k < 2 && paired != 0; ++k)
        finish_pattern(&work->patterns[k]);
    return paired | diffuse;
}

/* Direction `index` of a pattern's share in every lane's frame. */
static void set_directions(aur_group *group, const merged *work, size_t k, size_t index,
                           float local[3][AUR_PACKET_SIZE]) {
    const merged_pattern *const pattern = &work->patterns[k];
    for (size_t c = 0; c < 3; ++c) {
        const float *const *const from = pattern->directions[c];
        if (pattern->alike) {
            const float one = from[0][index * pattern->stride[0]];
            for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
                local[c][lane] = one;
        } else {
            for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
                local[c][lane] = from[lane][index * pattern->stride[lane]];
        }
    }
    for (uint32_t rest = k == 0 ? work->diffuse : 0; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        group->rays.density[lane] =
            work->densities[lane][index * pattern->stride[lane]] * (float)work->share_count[0];
    }
}

static void add_radiance(const aur_group *group, merged *work, size_t sample,
                         const float cosine[AUR_PACKET_SIZE]) {
    const float *restrict diffuse = weights_of(group, work, 0, sample);
    const float *restrict glossy = weights_of(group, work, 1, sample);
    const float *restrict times = work->times_cosine;
    for (size_t c = 0; c < 3; ++c) {
        const float *restrict radiance = group->rays.radiance[c];
        float *restrict diffuse_sum = work->sum[0][c], *restrict glossy_sum = work->sum[1][c];
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            diffuse_sum[k] += diffuse[k] * radiance[k];
            glossy_sum[k] += (1.0f + times[k] * (cosine[k] - 1.0f)) * (glossy[k] * radiance[k]);
        }
    }
}

static void trace_pattern(aur_group *group, merged *work, size_t k) {
    const merged_pattern *const pattern = &work->patterns[k];
    const aur_embree_order order = group->flat ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    const uint64_t pixel = group->samples[aur_first_lane(pattern->lanes)].stream.pixel;
    for (size_t i = 0; i < work->share_count[k]; ++i) {
        const size_t sample = k * work->share_count[0] + i;
        float local[3][AUR_PACKET_SIZE], cosine[AUR_PACKET_SIZE];
        set_directions(group, work, k, i, local);
        if (aur_group_aim(group, pattern->lanes, &pattern->frames, local, cosine) == 0)
            continue;
        group->rays.hash = aur_hash3(pixel, sample, 0);
        aur_gather_trace(group->task->data, order, &group->rays, group->counters);
        add_radiance(group, work, sample, cosine);
    }
}

uint32_t aur_group_gather_merged(aur_group *group) {
    merged work = {0};
    const uint32_t lanes = prepare(group, &work);
    if (lanes == 0)
        return group->lanes;
    for (size_t k = 0; k < 2; ++k)
        trace_pattern(group, &work, k);
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        group->rays.pairs[lane] = NULL;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_vector reflected = {0};
        for (size_t k = 0; k < 2; ++k) {
            const aur_vector gathered = {work.sum[k][0][lane], work.sum[k][1][lane], work.sum[k][2][lane]};
            reflected = aur_vector_add(reflected, aur_vector_multiply(gathered, work.coefficients[lane][k]));
        }
        group->sum[lane] =
            aur_vector_add(group->sum[lane], aur_vector_multiply(group->throughput[lane], reflected));
    }
    return group->lanes & ~lanes;
}
