/* Lobes gathered by a method that the caller supplies, and the functions that it calls. */
#include "render/gather/estimators.h"

_Static_assert((int)AUR_GATHER_LANES == (int)AUR_PACKET_SIZE,
               "a lane of a caller's method is one of a packet");

uint32_t aur_gather_trace(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                          float values[3][AUR_GATHER_LANES]) {
    float factor[AUR_PACKET_SIZE];
    sweep->lanes = lanes;
    const uint32_t aimed =
        aur_gather_sweep_trace(sweep->surface_points, sweep, index, false, sweep->sums, factor);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            values[c][k] = aur_has_lane(aimed, k) ? factor[k] * sweep->sums->rays.radiance[c][k] : 0.0f;
    return aimed;
}

void aur_gather_finish(aur_gather_sweep *sweep, size_t lane, const float integral[3], size_t directions,
                       size_t level) {
    aur_gather_sums *const sums = sweep->sums;
    aur_gather_add(sums, sweep->surface_points, lane,
                   aur_vector_multiply((aur_vector){integral[0], integral[1], integral[2]},
                                       sweep->surface_points->at[lane].lobes[sweep->lobe].coefficient));
    sums->directions[lane] += (uint32_t)directions;
    if (level < AUR_RENDER_LEVELS)
        ++sums->counters->levels[level];
}

void aur_gather_by_method(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                          size_t lobe, uint32_t lanes, aur_gather_sums *sums) {
    aur_gather_sweep sweep;
    aur_gather_sweep_start(surface_points, rule, lobe, lanes, &sweep, &sums->rays);
    sweep.surface_points = surface_points;
    sweep.sums = sums;
    surface_points->plan->rules.method->gather(rule->state, lanes, &sweep, sums->numbers);
}
