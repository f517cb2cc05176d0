/* Majorants: the largest extinction in each cell of a coarse grid, for tracking. */
#pragma once

#include "render/scene/medium.h"

typedef struct aur_majorants {
    const aur_volume *volume;
    size_t cells[3];
    float *values; /* inverse lengths, x fastest */
} aur_majorants;

/* From `volume` times `scale`; the volume is bounded. Errors: MEMORY. */
aur_result aur_majorants_create(const aur_volume *volume, float scale, aur_majorants *majorants,
                                aur_error *error);
void aur_majorants_release(aur_majorants *majorants);

/* Traversal of the grid's cells along a ray. */
typedef struct aur_majorant_walk {
    const aur_majorants *majorants;
    float position, end; /* distances along the ray */
    float next[3];       /* where the ray leaves the cell along each axis */
    float step[3];       /* from one cell to the next */
    ptrdiff_t way[3];    /* 1 or -1 */
    ptrdiff_t cell[3];
} aur_majorant_walk;

void aur_majorant_walk_begin(const aur_majorants *majorants, const aur_ray *ray, float distance,
                             aur_majorant_walk *walk);
/* The next interval of the ray in one cell; false at the end. */
bool aur_majorant_walk_next(aur_majorant_walk *walk, float *from, float *to, float *majorant);
