/* Two lobes of a place gathered with the union of their samples. */
#ifndef AUR_TRANSPORT_GATHER_ESTIMATE_MERGED_H
#define AUR_TRANSPORT_GATHER_ESTIMATE_MERGED_H

#include "transport/gather/group.h"

/* What serves a place with just a diffuse and a glossy lobe, whose numbers are `lobes`; else NULL. */
const aur_gather_pair *aur_group_pair(const aur_final_gather *data, const aur_gather_place *p,
                                      size_t lobes[2]);

/* The density of both patterns' directions towards a local one. */
float aur_group_pair_density(const aur_gather_pair *pair, const aur_gather_place *p, const size_t lobes[2],
                             aur_vector local);

/* Adds the light of places that have a pair, and of diffuse places that are among them; returns the other
 * lanes, which are still to be gathered. */
uint32_t aur_group_gather_merged(aur_group *group);

#endif
