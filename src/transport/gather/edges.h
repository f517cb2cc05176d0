/* A pixel that sees several things - above all a part of a light - has its error from how much it sees of
 * each, not from the light that they reflect. So such pixels get more rays of the eye that only tell what
 * they meet, and what parts of the pixel these are weighs the means of what was shaded. */
#pragma once

#include "transport/gather/strata.h"
#include "transport/packets/interleave.h"

/* Pixels of a tile that see, or whose neighbours see, more than one thing: lanes of each group. */
typedef struct aur_gather_edges {
    uint32_t any[AUR_GROUP_COUNT];
    uint32_t lights[AUR_GROUP_COUNT]; /* those where one of the things is a light */
} aur_gather_edges;

/* `strata` are those of the tile at (x, y). Pixels beside the tile are looked at with one ray each. */
void aur_gather_find_edges(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y,
                           const aur_pixel_strata *strata, aur_gather_edges *edges, aur_counters *counters);
