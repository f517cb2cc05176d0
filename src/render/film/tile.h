/* What an integrator sees of the film: a part of the image, the camera samples of its pixels, and their
 * sums. */
#pragma once

#include <aureole-render/render.h>

#include <stdatomic.h>

#include "points/base/parallel.h"
#include "render/sampling/stream.h"
#include "render/scene/scene.h"

/* Counted by each tile for itself and added up afterwards. */
typedef struct aur_counters {
    uint64_t rays;      /* of all kinds; set by the driver from aur_rays_traced */
    uint64_t edge_rays; /* of these, rays that only measure how much of each surface a pixel at an edge sees;
                           not stored in film files */
    uint64_t samples;   /* of the camera */
    uint64_t invalid;   /* samples with invalid radiance */
    uint64_t cut;       /* paths cut after too many mirrors, hidden lights or null collisions in sequence */
    uint64_t unsolved;  /* shading points whose system for optimal weights could not be solved */
    bool stopped; /* a sample was left unfinished because the work is to stop: the sums are of no use; never
                     added */
    uint64_t levels[AUR_RENDER_LEVELS]; /* adaptive gathering: shading points that ended at each level */
} aur_counters;

void aur_counters_add(aur_counters *sum, const aur_counters *added);

/* A camera ray with the numbers of its light path. */
typedef struct aur_camera_sample {
    aur_ray ray;
    aur_stream stream;
    float offset[2]; /* of the film point from the pixel's centre, in pixels */
    float first_pairs[AUR_STREAM_BLOCK]
                     [2]; /* of the stream: those of the camera, and the first of an integrator */
} aur_camera_sample;

/* Dimension pairs that the camera uses; those of integrators begin after them. */
enum { AUR_PAIR_FILTER = 0, AUR_PAIR_LENS = 1, AUR_PAIR_FIRST = 2 };

/* The generator of camera samples; constant while an image is rendered. */
typedef struct aur_view {
    const aur_scene *scene;
    float factor; /* of radiance (aur_camera_factor); 0: 1 */
    const aur_sampler *sampler;
    const aur_filter *filter; /* that samples are drawn by: box where pixels share samples */
    size_t reach;             /* radius in pixels within which samples contribute to a pixel */
    size_t width, height;     /* of the whole image */
    uint64_t seed;
    bool pixel_centre; /* every camera ray goes through the centre of its pixel */
    bool has_lens;     /* the camera's rays depend on a point of its lens */
} aur_view;

/* Sample `index` of pixel (x, y), a function of these alone. */
void aur_view_sample(const aur_view *view, size_t x, size_t y, uint32_t index, aur_camera_sample *sample);

/* Samples indices[k] of `count` pixels (at most AUR_TILE_SIZE) at columns x[k] and rows y[k]; first_pairs are
 * not set. */
void aur_view_samples(const aur_view *view, size_t count, const size_t *x, const size_t *y,
                      const uint32_t *indices, aur_camera_sample *samples);

enum { AUR_TILE_SIZE = 16, AUR_EXTRA_CHANNELS_MAX = 64 };

struct aur_spread;

/* Part of a sample that was stored separately, with its image position. */
typedef struct aur_tile_light {
    size_t slot, number; /* of the sample, and of the light */
    float offset[2], part, radiance[3];
} aur_tile_light;

/* Samples that are stored to be added in the order of their numbers and pixels. For each sample and pixel:
 * its offset from the pixel's centre, 1 if present, and its channels. */
typedef struct aur_tile_slots {
    float *values;
    size_t light_count, light_capacity;
    aur_tile_light *lights;
    bool failed; /* out of memory */
} aur_tile_slots;

/* Tiles lie on a grid of AUR_TILE_SIZE pixels over the whole image, so that a crop does not change other
 * pixels. */
typedef struct aur_tile {
    const aur_view *view;
    size_t x0, x1, y0, y1; /* the pixels to render: a whole tile or its part within the crop */
    uint32_t first, count; /* samples of each pixel: first .. first + count - 1 */
    size_t stride;         /* pixels from one row of sums to the next */
    /* Of each pixel, like `counts`: it needs the samples from begins to ends - 1 of the range. NULL: all. */
    const uint32_t *begins, *ends;
    size_t channel_count;
    /* Of pixel (x0, y0), channel_count values per pixel; where pixels share samples, of its cells. */
    double *sums;
    const struct aur_spread *spread; /* NULL: pixels share no samples */
    aur_tile_slots slots;
    uint32_t *counts; /* samples added to each pixel */
    aur_counters counters;
    const atomic_bool *stop; /* true: the samples are no longer needed; NULL: never cancelled */
    uint64_t rays_checked;   /* aur_rays_traced at the last call of aur_tile_stops */
} aur_tile;

/* Whether the tile may be left unfinished. Asks as often as rays are traced that take some milliseconds, so
 * that it may be called for every sample. */
static inline bool aur_tile_stops(aur_tile *tile) {
    enum { RAYS_BETWEEN = 1 << 14 };
    if (aur_rays_traced - tile->rays_checked < RAYS_BETWEEN)
        return false;
    tile->rays_checked = aur_rays_traced;
    return (tile->stop != NULL && atomic_load_explicit(tile->stop, memory_order_relaxed)) ||
           aur_parallel_stops();
}

/* Whether pixel (x, y) of the tile needs a sample of the range. */
static inline bool aur_tile_needs(const aur_tile *tile, size_t x, size_t y, uint32_t index) {
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    return tile->begins == NULL || (index >= tile->begins[pixel] && index < tile->ends[pixel]);
}

/* How many samples of the range pixel (x, y) needs. */
static inline uint32_t aur_tile_needed(const aur_tile *tile, size_t x, size_t y) {
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    if (tile->begins == NULL)
        return tile->count;
    const uint32_t last = tile->first + tile->count;
    const uint32_t begin = tile->begins[pixel] > tile->first ? tile->begins[pixel] : tile->first;
    const uint32_t end = tile->ends[pixel] < last ? tile->ends[pixel] : last;
    return begin < end ? end - begin : 0;
}

/* The sensor's response to a sample's radiance. */
static inline aur_vector aur_tile_measured(const aur_tile *tile, aur_vector radiance) {
    const float factor = tile->view != NULL ? tile->view->factor : 0.0f;
    return factor == 0.0f || factor == 1.0f ? radiance : aur_vector_scale(radiance, factor);
}

/* Whether finite and not negative. */
bool aur_is_radiance(aur_vector radiance);

/* Adds sample `index` of a pixel of the tile, at `offset` from its centre. Invalid samples are counted and
 * ignored. */
void aur_tile_add(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2],
                  aur_vector radiance);
/* One sample with all channels, the first three what the camera measures (aur_tile_measured). */
void aur_tile_add_channels(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2],
                           const float *values);
/* Where pixels share samples: adds the hit of one of the 1 / `part` probe rays of a sample. The probe rays'
 * hits determine where the sample's emission counts; its other light counts at its camera offset. So a
 * light's radiance and weights, which are correlated, come from the same rays. */
void aur_tile_add_light(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2], float part,
                        aur_vector radiance);
/* Adds one of the `sample_count` samples of a step that gives each pixel `tile->count`, in one call: for
 * integrators without `cuts`. */
void aur_tile_add_of(aur_tile *tile, size_t x, size_t y, size_t sample_count, const float offset[2],
                     aur_vector radiance);
/* Adds the mean of `count` samples, where pixels do not share samples. */
void aur_tile_add_mean(aur_tile *tile, size_t x, size_t y, uint32_t count, const double mean[3]);
/* Adds to a channel after the first three without counting a sample, where pixels do not share samples. */
void aur_tile_add_extra(aur_tile *tile, size_t x, size_t y, size_t channel, double value);
/* Where pixels share samples: adds the sums of `count` samples of a pixel to the (2 reach + 1)^2 pixels
 * around it, row by row, each with all channels and the weight. */
void aur_tile_add_sums(aur_tile *tile, size_t x, size_t y, uint32_t count, const double *sums);

/* Holds samples first .. first + count - 1 back from now on. False: out of memory. */
bool aur_tile_hold(aur_tile *tile);
/* Adds what was held back. */
void aur_tile_release(aur_tile *tile);
void aur_tile_free_slots(aur_tile *tile);
