/* Places with a diffuse and one glossy lobe, gathered with both patterns' rays for both lobes. */
#include "transport/gather_merged.h"

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
    return (aur_group_dither[group->task->group] ^ (hash & 15u)) * pair->rotations / 16;
}

/* One share of both patterns at the places of a group. */
typedef struct merged {
    const aur_gather_pair *pair;
    uint32_t lanes;
    bool alike; /* all lanes have the same turn */
    size_t rotation[AUR_PACKET_SIZE];
    aur_lobe_frames frames[2];
    aur_vector coefficients[AUR_PACKET_SIZE][2];
    bool times_cosine[AUR_PACKET_SIZE];
    float sum[2][3][AUR_PACKET_SIZE]; /* of weight * radiance, by lobe and channel */
} merged;

/* Frames and weights; those of sample i for a lobe stand one lane after another. */
static void prepare(aur_group *group, merged *work) {
    const aur_final_gather *const data = group->task->data;
    const size_t samples = aur_gather_pair_share(work->pair);
    float *const looked_up = group->merged + 2 * samples * AUR_PACKET_SIZE;
    memset(group->merged, 0, 2 * samples * AUR_PACKET_SIZE * sizeof *group->merged);
    for (uint32_t rest = work->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_place *const p = &group->places[lane];
        size_t lobes[2] = {0, 0};
        aur_group_pair(data, p, lobes);
        const aur_vector normal = lobe_axis(p, lobes[0]), mirror = lobe_axis(p, lobes[1]);
        bool mirrored;
        aur_frame frames[2];
        work->rotation[lane] = rotation_of(group, work->pair, lane, &mirrored);
        aur_gather_pair_frames(normal, mirror, mirrored, frames);
        group->rays.axes[lane][0] = normal;
        group->rays.axes[lane][1] = mirror;
        for (size_t k = 0; k < 2; ++k) {
            aur_group_set_frame(group, lane, &frames[k], &work->frames[k]);
            if (aur_group_gathers(data, &p->lobes[lobes[k]]))
                work->coefficients[lane][k] = p->lobes[lobes[k]].coefficient;
        }
        work->times_cosine[lane] = p->lobes[lobes[1]].times_cosine;
        aur_gather_pair_weights(work->pair, work->rotation[lane],
                                group->task->index % data->samples_per_pixel, aur_vector_dot(normal, mirror),
                                looked_up);
        for (size_t i = 0; i < 2 * samples; ++i)
            group->merged[i * AUR_PACKET_SIZE + lane] = looked_up[i];
    }
}

/* Direction `index` of a pattern's share in every lane's frame. */
static void set_directions(const aur_group *group, const merged *work, size_t pattern, size_t index,
                           float local[3][AUR_PACKET_SIZE]) {
    const aur_gather_pair *const pair = work->pair;
    const size_t at =
        group->task->index % group->task->data->samples_per_pixel * pair->share_count[pattern] + index;
    if (work->alike) {
        const size_t from = work->rotation[aur_first_lane(work->lanes)] * pair->count[pattern] + at;
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                local[c][k] = pair->direction[pattern][c][from];
        return;
    }
    for (uint32_t rest = work->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        for (size_t c = 0; c < 3; ++c)
            local[c][lane] = pair->direction[pattern][c][work->rotation[lane] * pair->count[pattern] + at];
    }
}

static void add_radiance(const aur_group *group, merged *work, size_t sample,
                         const float cosine[AUR_PACKET_SIZE]) {
    const size_t samples = aur_gather_pair_share(work->pair);
    const float *restrict diffuse = group->merged + sample * AUR_PACKET_SIZE;
    const float *restrict glossy = group->merged + (samples + sample) * AUR_PACKET_SIZE;
    float glossy_weight[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        glossy_weight[k] = work->times_cosine[k] ? cosine[k] * glossy[k] : glossy[k];
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            work->sum[0][c][k] += diffuse[k] * group->rays.radiance[c][k];
            work->sum[1][c][k] += glossy_weight[k] * group->rays.radiance[c][k];
        }
}

void aur_group_gather_merged(aur_group *group, const aur_gather_pair *pair, uint32_t lanes) {
    const aur_final_gather *const data = group->task->data;
    const aur_embree_order order = group->flat ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    merged work = {.pair = pair, .lanes = lanes, .alike = data->decorrelation != AUR_DECORRELATION_RANDOM};
    prepare(group, &work);
    group->rays.pair = pair;
    size_t sample = 0;
    for (size_t pattern = 0; pattern < 2; ++pattern)
        for (size_t i = 0; i < pair->share_count[pattern]; ++i, ++sample) {
            float local[3][AUR_PACKET_SIZE] = {0}, cosine[AUR_PACKET_SIZE];
            set_directions(group, &work, pattern, i, local);
            if (aur_group_aim(group, lanes, &work.frames[pattern], local, cosine) == 0)
                continue;
            group->rays.hash = aur_hash3(group->samples[aur_first_lane(lanes)].stream.pixel, sample, 0);
            aur_gather_trace(data, order, &group->rays, group->counters);
            add_radiance(group, &work, sample, cosine);
        }
    group->rays.pair = NULL;
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
}
