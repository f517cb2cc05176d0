/* Which half planes a patch looks along: their azimuths and where on the patch they end. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A patch in turned coordinates. */
typedef struct aur_slice_patch {
    float corner[3], edge[2][3];
    float inset; /* barycentric: how far half planes end off the edges, where other facets begin */
    double ahead[2], upright; /* the normal's way, of unit length, and how much of it there is */
} aur_slice_patch;

typedef struct aur_slice_sample {
    float way[2], place[2], jitter, weight;
    uint32_t randomization, bucket;
} aur_slice_sample;

/* Samples in the order of their azimuths, so that those of a packet go through the same boxes: one for each
 * of points[randomizations * count][4], all shifted by what `hash` says. `unordered` has place for as many.
 */
void aur_slice_samples_draw(const aur_slice_patch *patch, size_t randomizations, size_t count,
                            const float *points, uint64_t hash, aur_slice_sample *unordered,
                            aur_slice_sample *ordered);
