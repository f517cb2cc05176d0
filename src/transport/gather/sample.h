/* Samples of sixteen pixels at a time: what the eye sees, also by mirrors and through glass. */
#pragma once

#include "transport/gather/strata.h"

/* Which samples. */
typedef struct aur_gather_task {
    const aur_gather_plan *plan;
    const aur_view *view;
    size_t x, y;    /* of the tile's corner in the picture */
    uint32_t group; /* of the tile */
    uint32_t lanes; /* pixels of the group */
    uint32_t index; /* of the sample of each pixel */
    bool only_new;  /* only strata of which a pixel has no radiance yet are shaded */
} aur_gather_task;

/* Memory that samples of a plan are made in, one after another. */
typedef struct aur_gather_group aur_gather_group;

/* NULL when out of memory. */
aur_gather_group *aur_gather_group_create(const aur_gather_plan *plan);
void aur_gather_group_destroy(aur_gather_group *group); /* NULL is allowed */

/* Adds the samples to the pixels of a tile: `strata` has AUR_TILE_PIXELS, row by row. */
void aur_gather_add_samples(aur_gather_group *group, const aur_gather_task *task, aur_pixel_strata *strata,
                            aur_counters *counters);
