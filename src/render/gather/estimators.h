/* Estimators: each adds the light that some shading points reflect towards the camera to the sums. Only
 * shade.c calls them, and none calls another. */
#pragma once

#include "render/gather/aim.h"

/* Adds direct and gathered light reflected by all lobes but specular ones. */
void aur_gather_shade(const aur_gather_points *surface_points, aur_gather_sums *sums);

/* By the caller's method (gather.h): one lobe, which `rule` gathers in these lanes. */
void aur_gather_by_method(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                          size_t lobe, uint32_t lanes, aur_gather_sums *sums);
/* Pairs of lobes, and diffuse lobes if the method takes them. Returns the lanes that remain. */
uint32_t aur_gather_pairs(const aur_gather_points *surface_points, aur_gather_sums *sums);
/* The sampled lobe of shading points that have a state for it. */
void aur_gather_by_ggx(const aur_gather_points *surface_points, size_t lobe, uint32_t lanes,
                       aur_gather_sums *sums);

/* Adds samples of lights and of bright texels: one packet of shadow rays per draw. Both are combined with the
 * gather rays of each lobe by MIS. */
void aur_gather_add_direct_light(const aur_gather_points *surface_points, aur_gather_sums *sums);
void aur_gather_add_bright_light(const aur_gather_points *surface_points, aur_gather_sums *sums);

/* Dimension pairs used at one surface of a chain of specular bounces. */
enum {
    AUR_GATHER_PAIR_CHOICE,         /* of a light */
    AUR_GATHER_PAIR_POSITION,       /* on it */
    AUR_GATHER_PAIR_LOBE,           /* of a specular bounce: which lobe, */
    AUR_GATHER_PAIR_BOUNCE,         /* and its direction */
    AUR_GATHER_PAIR_TEXEL,          /* choice of a bright texel */
    AUR_GATHER_PAIR_TEXEL_POSITION, /* on it */
    AUR_GATHER_PAIRS
};

/* The first pair after this many bounces. */
static inline uint32_t aur_gather_first_pair(uint32_t bounces) {
    return AUR_PAIR_FIRST + AUR_GATHER_PAIRS * bounces;
}
