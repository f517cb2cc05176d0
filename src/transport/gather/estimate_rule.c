/* The fixed rule: the same directions at every place but for their rotation, split among the samples of a
 * pixel. */
#include "transport/gather/estimators.h"
#include "transport/packets/interleave.h"

/* What lobes that dip below the surface are multiplied by; 1 for the others. */
static float horizon_factor(const aur_gather_sweep *sweep, size_t lane) {
    const aur_lobe_frames *const frames = &sweep->frames;
    if (!sweep->rule->clipped)
        return 1.0f;
    aur_vector normal = {0};
    for (size_t c = 0; c < 3; ++c) {
        normal.x += frames->shading[c][lane] * frames->x[c][lane];
        normal.y += frames->shading[c][lane] * frames->y[c][lane];
        normal.z += frames->shading[c][lane] * frames->z[c][lane];
    }
    return aur_gather_horizon_factor(&sweep->rule->rule, &sweep->rule->horizon, &sweep->rotations[lane],
                                     normal);
}

/* Keeps the gathered irradiance for the pool instead of adding it. */
static void keep_for_pool(const aur_gather_places *places, const aur_gather_sweep *sweep, size_t lane,
                          aur_vector gathered, aur_gather_sums *sums) {
    const aur_gather_place *const place = &places->at[lane];
    sums->pooled_lanes |= 1u << lane;
    sums->pooled[lane] = (aur_gather_pooled){
        .irradiance = aur_vector_scale(gathered, 1.0f / sweep->rule->directions),
        .coefficient = aur_vector_multiply(places->throughput[lane], place->lobes[sweep->lobe].coefficient),
        .position = place->surface.position,
        .normal = aur_vector_scale(place->surface.frame.z, place->side)};
}

void aur_gather_by_rule(const aur_gather_plan *plan, const aur_gather_places *places,
                        const aur_gather_lobe_rule *rule, size_t lobe, uint32_t lanes, aur_gather_sums *sums,
                        aur_gather_scratch *scratch) {
    aur_gather_sweep sweep;
    aur_gather_sweep_start(plan, places, rule, lobe, lanes, &sweep, &scratch->rays);
    const bool splits = aur_gather_splits(plan, places, rule);
    /* The rule's directions are in so many parts, of which this is one. */
    size_t parts = plan->samples_per_pixel, part = places->index % parts;
    if (splits) {
        part = part * AUR_PACKET_SIZE + aur_group_rank(places->group);
        parts *= AUR_PACKET_SIZE;
    }
    float sum[3][AUR_PACKET_SIZE] = {0};
    for (size_t i = part; i < rule->rule.count; i += parts) {
        float factor[AUR_PACKET_SIZE];
        if (aur_gather_sweep_trace(plan, places, &sweep, i, true, &scratch->rays, sums->counters, factor) ==
            0)
            continue;
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                sum[c][k] += factor[k] * scratch->rays.radiance[c][k];
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_vector gathered = {sum[0][lane], sum[1][lane], sum[2][lane]};
        if (splits) {
            keep_for_pool(places, &sweep, lane, gathered, sums);
            continue;
        }
        const aur_vector reflected = aur_vector_multiply(gathered, places->at[lane].lobes[lobe].coefficient);
        sums->radiance[lane] =
            aur_vector_add_scaled(sums->radiance[lane], horizon_factor(&sweep, lane) / rule->directions,
                                  aur_vector_multiply(places->throughput[lane], reflected));
    }
}
