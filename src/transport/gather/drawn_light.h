/* Light of points drawn on lights and on bright texels: one packet of shadow rays a draw. */
#pragma once

#include "transport/gather/scratch.h"
#include "transport/gather/sums.h"

/* Both weigh each lobe's light beside what its gather rays find of it, and add it to the sums. */
void aur_gather_add_direct_light(const aur_gather_plan *plan, const aur_gather_places *places,
                                 aur_gather_sums *sums, aur_gather_scratch *scratch);
void aur_gather_add_bright_light(const aur_gather_plan *plan, const aur_gather_places *places,
                                 aur_gather_sums *sums, aur_gather_scratch *scratch);

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
