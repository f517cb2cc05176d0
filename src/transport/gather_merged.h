/* Two lobes of a place gathered with the union of their samples. */
#ifndef AUR_TRANSPORT_GATHER_MERGED_H
#define AUR_TRANSPORT_GATHER_MERGED_H

#include "transport/gather_group.h"

/* What serves a place with just a diffuse and a glossy lobe, whose numbers are `lobes`; else NULL. */
const aur_gather_pair *aur_group_pair(const aur_final_gather *data, const aur_gather_place *p,
                                      size_t lobes[2]);

/* The density of both patterns' directions towards a local one. */
float aur_group_pair_density(const aur_gather_pair *pair, const aur_gather_place *p, const size_t lobes[2],
                             aur_vector local);

/* Adds both lobes' light to the lanes, whose places the pair serves. */
void aur_group_gather_merged(aur_group *group, const aur_gather_pair *pair, uint32_t lanes);

#endif
