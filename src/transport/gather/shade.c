/* The one file that calls estimators: for each lobe it takes the one that the plan has for it. */
#include "transport/gather/shade.h"

#include "transport/gather/drawn_light.h"
#include "transport/gather/estimators.h"

/* The lanes, among `lanes`, whose lobe number `lobe` is gathered by the rule. */
static uint32_t lanes_of_rule(const aur_gather_places *places, uint32_t lanes, size_t lobe,
                              const aur_gather_lobe_rule *rule) {
    uint32_t found = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (places->at[lane].rules[lobe] == rule)
            found |= 1u << lane;
    }
    return found;
}

/* The lobe number `lobe` of all lanes that have one. */
static void gather_lobe(const aur_gather_plan *plan, const aur_gather_places *places, uint32_t lanes,
                        size_t lobe, aur_gather_sums *sums, aur_gather_scratch *scratch) {
    uint32_t ruled = 0, sampled = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_place *const place = &places->at[lane];
        const aur_bsdf_lobe *const own = &place->lobes[lobe];
        if (lobe >= place->lobe_count || !aur_gather_plan_gathers(plan, own) ||
            !aur_gather_place_has(place, lobe))
            continue;
        if (own->shape == AUR_LOBE_SHAPE_SAMPLED)
            sampled |= 1u << lane;
        else
            ruled |= 1u << lane;
    }
    while (ruled != 0) {
        const aur_gather_lobe_rule *const rule = places->at[aur_first_lane(ruled)].rules[lobe];
        const uint32_t alike = lanes_of_rule(places, ruled, lobe, rule);
        if (rule->levels.count > 0)
            aur_gather_by_levels(plan, places, rule, lobe, alike, sums, scratch);
        else
            aur_gather_by_rule(plan, places, rule, lobe, alike, sums, scratch);
        ruled &= ~alike;
    }
    if (sampled != 0)
        aur_gather_by_sampling(plan, places, lobe, sampled, sums, scratch);
}

void aur_gather_shade(const aur_gather_plan *plan, const aur_gather_places *places, aur_gather_sums *sums,
                      aur_gather_scratch *scratch) {
    if (plan->policy.direct == AUR_DIRECT_NEE && plan->policy.max_depth >= 2 &&
        aur_scene_emitter_count(plan->scene) > 0)
        aur_gather_add_direct_light(plan, places, sums, scratch);
    if (plan->light.bright_draws > 0)
        aur_gather_add_bright_light(plan, places, sums, scratch);
    if (!plan->gathers)
        return;
    const uint32_t lanes =
        plan->rules.merged != NULL ? aur_gather_by_merged(plan, places, sums, scratch) : places->lanes;
    for (size_t lobe = 0; lobe < AUR_BSDF_LOBE_CAPACITY && lanes != 0; ++lobe)
        gather_lobe(plan, places, lanes, lobe, sums, scratch);
}
