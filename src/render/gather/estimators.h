/* Estimators: each adds light that leaves some places towards the eye to the sums. Only shade.c calls them,
 * and none calls another. */
#pragma once

#include "render/gather/aim.h"

/* What the places reflect, by all lobes but specular ones, of direct and of gathered light. */
void aur_gather_shade(const aur_gather_points *surface_points, aur_gather_sums *sums);

/* One lobe, which `rule` gathers in these lanes by the caller's method. */
void aur_gather_by_method(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                          size_t lobe, uint32_t lanes, aur_gather_sums *sums);

/* All lobes of places that have a merged rule, and of diffuse places that are among them. Returns the places
 * that are left. */
uint32_t aur_gather_by_merged(const aur_gather_points *surface_points, aur_gather_sums *sums);

/* The sampled lobe of places that have a rule for it as a GGX lobe. */
void aur_gather_by_ggx(const aur_gather_points *surface_points, size_t lobe, uint32_t lanes,
                       aur_gather_sums *sums);

/* Points drawn on lights and on bright texels: one packet of shadow rays a draw. Both weigh each lobe's light
 * beside what its gather rays find of it. */
void aur_gather_add_direct_light(const aur_gather_points *surface_points, aur_gather_sums *sums);
void aur_gather_add_bright_light(const aur_gather_points *surface_points, aur_gather_sums *sums);

/* Dimension pairs of one surface along a chain of specular bounces. */
enum {
    AUR_GATHER_PAIR_CHOICE,         /* of a light */
    AUR_GATHER_PAIR_POSITION,       /* on it */
    AUR_GATHER_PAIR_LOBE,           /* of a specular bounce: which lobe, */
    AUR_GATHER_PAIR_BOUNCE,         /* and its direction */
    AUR_GATHER_PAIR_TEXEL,          /* choice of a bright texel */
    AUR_GATHER_PAIR_TEXEL_POSITION, /* on it */
    AUR_GATHER_PAIRS
};

/* The first pair after so many bounces. */
static inline uint32_t aur_gather_first_pair(uint32_t bounces) {
    return AUR_PAIR_FIRST + AUR_GATHER_PAIRS * bounces;
}
