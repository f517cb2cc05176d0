/* Estimators: each adds to the sums the light that one lobe of some places gathers. Only shade.c calls them,
 * and none calls another. `lanes` are places whose lobe number `lobe` is gathered by `rule`. */
#pragma once

#include "transport/gather/aim.h"

/* By this sample's part of a rule. */
void aur_gather_by_rule(const aur_gather_plan *plan, const aur_gather_places *places,
                        const aur_gather_lobe_rule *rule, size_t lobe, uint32_t lanes, aur_gather_sums *sums,
                        aur_gather_scratch *scratch);

/* By as many levels of a rule as the light asks for (Marques 2019, section 6.2). */
void aur_gather_by_levels(const aur_gather_plan *plan, const aur_gather_places *places,
                          const aur_gather_lobe_rule *rule, size_t lobe, uint32_t lanes,
                          aur_gather_sums *sums, aur_gather_scratch *scratch);

/* Lobes that have no formula, by the BSDF's own sampling. */
void aur_gather_by_sampling(const aur_gather_plan *plan, const aur_gather_places *places, size_t lobe,
                            uint32_t lanes, aur_gather_sums *sums, aur_gather_scratch *scratch);

/* All lobes of places that have a merged rule, and of diffuse places that are among them. Returns the places
 * that are left. */
uint32_t aur_gather_by_merged(const aur_gather_plan *plan, const aur_gather_places *places,
                              aur_gather_sums *sums, aur_gather_scratch *scratch);
