/* Strata of a pixel: its samples by the surfaces that they hit. */
#pragma once

#include "render/gather/sums.h"
#include "render/trace/interleave.h"

/* A key for what a lane's camera ray hit: the shape, and roughly the direction that it faces. 0: the ray left
 * the scene; no surface has this key. */
uint64_t aur_gather_surface_key(const aur_shape_class *classes, const aur_packet *packet, size_t lane);
#define AUR_SURFACE_KEY_EMITS (UINT64_C(1) << 63)

/* One stratum of a pixel: all samples whose first hit has the same key. */
typedef struct aur_stratum {
    uint64_t key;
    double seen;   /* samples that hit it */
    double shaded; /* samples whose radiance is in `sum` */
    double sum[3];
    double single[3]; /* the same before neighbours' irradiance is pooled */
    /* With pooled irradiance: the samples that gathered, and sums over them. */
    float gathers;
    aur_gather_pooled pooled;
    double pool_adds[3]; /* the pool's mean less what these samples gathered themselves */
} aur_stratum;

enum { AUR_STRATUM_COUNT = 6 }; /* the last one takes all further keys */

typedef struct aur_pixel_strata {
    uint32_t count;
    uint32_t samples;    /* with valid radiance */
    uint64_t directions; /* gathered with by the caller's method */
    aur_stratum strata[AUR_STRATUM_COUNT];
} aur_pixel_strata;

/* The pixel's stratum with a key, added if there is none yet: then `exists` is false. */
aur_stratum *aur_pixel_strata_find(aur_pixel_strata *pixel, uint64_t key, bool *exists);

/* Adds one lane's result, a sample of the pixel in that stratum. A sample with invalid radiance is counted as
 * such and otherwise ignored: false. */
bool aur_pixel_strata_add(aur_pixel_strata *pixel, aur_stratum *stratum, const aur_gather_sums *sums,
                          size_t lane);

/* The pixel's radiance, RGB: the mean of every stratum by its part of what the pixel sees. */
void aur_pixel_strata_mean(const aur_pixel_strata *pixel, double mean[3]);
/* The part of the mean that pooling added. */
void aur_pixel_strata_added(const aur_pixel_strata *pixel, double added[3]);

/* In a pixel that sees several surfaces, and above all part of a light, most of the error comes from how much
 * it sees of each, not from their reflected light. Such pixels get extra camera rays that only find which
 * surface they hit. The fractions that these rays find weigh the means of the shaded samples.
 *
 * What the neighbours of a pixel see: one surface, several, or a light among several. */
typedef enum aur_gather_edge { AUR_NO_EDGE, AUR_PLAIN_EDGE, AUR_LIGHT_EDGE } aur_gather_edge;

/* Edges of the pixels with samples, row by row; `strata` are those of the tile at (x, y). `equal_counts`: all
 * of its pixels have equally many samples; if not, one ray is traced for each of them. One ray is also traced
 * for each pixel around the tile. */
void aur_gather_find_edges(const aur_gather_plan *plan, const aur_view *view, size_t x, size_t y,
                           const aur_pixel_strata *strata, bool equal_counts,
                           aur_gather_edge edges[AUR_TILE_PIXELS]);

/* Pooled irradiance: one joint pattern is split among the pixels of a 4 x 4 block, the same way in all
 * blocks. Gathered irradiance is pooled among pixels that see one surface (a discontinuity buffer: Wald,
 * Benthin, Slusallek, Keller 2002).
 *
 * A pixel's pool is the window of 5 x 5 pixels centred on it, whose outer rows and columns have half weight.
 * Like every 4 x 4 window it has each part of the pattern once. It is symmetric, so irradiance that changes
 * linearly is not blurred. Windows at the tile's border are 4 wide and off-centre.
 *
 * `near`: every pixel has its separate pattern, complemented by those of its neighbours (aur_nested_shift).
 * Its pool is the 3 x 3 pixels around it.
 *
 * Adds diffuse light by the pooled irradiance to every stratum of a tile of AUR_TILE_PIXELS, row by row.
 * False: out of memory. */
bool aur_gather_pool_irradiance(bool near, aur_pixel_strata *strata);
