/* What the samples of a pixel have seen, by the surfaces that they saw. */
#pragma once

#include "render/gather/sums.h"
#include "render/trace/interleave.h"

/* A key for what a lane's ray of the eye hit: the shape, and roughly which way it faces. 0 means that the ray
 * left the scene, and is no surface's key. */
uint64_t aur_gather_surface_key(const aur_shape_class *classes, const aur_packet *packet, size_t lane);
#define AUR_SURFACE_KEY_EMITS (UINT64_C(1) << 63)

/* One stratum of a pixel: all samples whose first hit has the same key. */
typedef struct aur_stratum {
    uint64_t key;
    double seen;   /* samples that met it */
    double shaded; /* those whose radiance is in `sum` */
    double sum[3];
    double single[3]; /* the same before neighbours' irradiance is pooled */
    /* With pooled irradiance: the samples that gathered, and sums over them. */
    float gathers;
    aur_gather_pooled pooled;
    double pool_adds[3]; /* what the pool has over what these samples gathered themselves */
} aur_stratum;

enum { AUR_STRATUM_COUNT = 6 }; /* the last one takes what comes after */

typedef struct aur_pixel_strata {
    uint32_t count;
    uint32_t samples;    /* whose radiance was valid */
    uint64_t directions; /* gathered with by the caller's method */
    aur_stratum strata[AUR_STRATUM_COUNT];
} aur_pixel_strata;

/* The pixel's stratum of a key, which is added where there is none yet: then `known` is false. */
aur_stratum *aur_pixel_strata_find(aur_pixel_strata *pixel, uint64_t key, bool *known);

/* Adds what was found for one lane of the sums, a sample of the pixel in that stratum. A sample that is no
 * radiance is counted as invalid, and is as if it had not been drawn: false. */
bool aur_pixel_strata_add(aur_pixel_strata *pixel, aur_stratum *stratum, const aur_gather_sums *sums,
                          size_t lane);

/* The pixel's radiance, RGB: the mean of every stratum by its part of what the pixel sees. */
void aur_pixel_strata_mean(const aur_pixel_strata *pixel, double mean[3]);
/* What pooling has added to that. */
void aur_pixel_strata_added(const aur_pixel_strata *pixel, double added[3]);

/* A pixel that sees several things - above all a part of a light - has its error from how much it sees of
 * each, not from the light that they reflect. So such pixels get more rays of the eye that only tell what
 * they meet, and what parts of the pixel these are weighs the means of what was shaded.
 *
 * Pixels of a tile whose neighbours see more than one thing, for aur_group_lanes_marked. */
typedef struct aur_gather_edges {
    uint32_t any[AUR_GROUP_COUNT];
    uint32_t lights[AUR_GROUP_COUNT]; /* those where one of the things is a light */
} aur_gather_edges;

/* `strata` are those of the tile at (x, y); `alike`: all of its pixels have as many samples. Pixels beside
 * the tile are looked at with one ray each, and so are those of the tile where they are not alike. */
void aur_gather_find_edges(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y,
                           const aur_pixel_strata *strata, bool alike, aur_gather_edges *edges);

/* Pooled irradiance: one joint pattern is split among the pixels of a 4 x 4 block, the same way in all
 * blocks, and what they gathered is pooled where they see one surface (a discontinuity buffer: Wald, Benthin,
 * Slusallek, Keller 2002).
 *
 * A pixel's pool is the window of 5 x 5 pixels about it whose outer rows and columns count half. Like every
 * 4 x 4 window it has each part of the pattern once, and its middle is the pixel: light that changes linearly
 * over it is not blurred. Windows at the tile's rim are 4 wide and lie beside their pixel.
 *
 * `near`: every pixel has a pattern of its own, which those of its neighbours complete (aur_nested_shift),
 * and its pool are the 3 x 3 pixels about it.
 *
 * Adds to every stratum of a tile, AUR_TILE_PIXELS row by row, its diffuse light by the irradiance that
 * neighbouring pixels pool. False: out of memory. */
bool aur_gather_pool_irradiance(bool near, aur_pixel_strata *strata);
