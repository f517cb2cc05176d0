/* Samples that contribute to all pixels within the filter's reach. Pixels then share samples, and the result
 * must not depend on the order in which threads, ranks or parts of an image add them. So each square cell of
 * pixels has separate sums for all pixels that its samples reach, including a border around it. Within a
 * cell, samples are added in the order of their numbers and pixels; the image adds the cells that reach a
 * pixel in the order of their positions. All pixels of a cell have the same number of samples, and the cell's
 * sums are divided by it. So cells may have different numbers of samples without shifting the filter's
 * centre. */
#pragma once

#include "render/film/tile.h"
#include "render/scene/sensor.h"

struct aur_film;
struct aur_film_layout;
struct aur_film_targets;
struct aur_film_before;

/* Bins of the table over a pixel, which is interpolated linearly, with an error of 2e-6 of a Gaussian's peak.
 */
enum { AUR_SPREAD_BINS = 512, AUR_SPREAD_WIDTH_MAX = 2 * AUR_FILTER_REACH_MAX + 1 };

/* Samples of a pixel that are stored to be added in order, at most this many per call. */
enum { AUR_SPREAD_PIECE = 32 };

typedef struct aur_spread {
    size_t reach;       /* pixels on each side */
    size_t cell;        /* pixels along a cell's side: divides AUR_TILE_SIZE */
    size_t side;        /* the same with the borders */
    size_t channels;    /* of a pixel's sums: the film's and, last, the filter's weights */
    size_t tile_cells;  /* cells of a tile */
    size_t cell_values; /* doubles of a cell's sums */
    float *table;       /* [AUR_SPREAD_BINS + 1][2 reach + 1], by the sample's position in its pixel */
    /* Cells tile by tile: their sums; the samples that each of their pixels was given; and steps. */
    double *sums;
    uint32_t *given, *steps;
    /* For each pixel of a cell with its borders, over the steps of n samples that summed to s (R, G, B) with
     * weights w: the sums of s^2 / n, s w / n and w^2 / n. NULL: not computed. */
    double *moments;
} aur_spread;

enum { AUR_SPREAD_MOMENTS = 7 };

/* The pixels on each side that a sample reaches. */
size_t aur_spread_reach(const aur_filter *filter);
/* Where the noise of samples is white: the sum over all pixels of the squared correlation with one pixel. */
double aur_spread_overlap(const aur_spread *spread);
/* Computes the sizes in `spread` for a filter and cells; allocates nothing. */
void aur_spread_measure(const aur_filter *filter, size_t cell, size_t channel_count, aur_spread *spread);
/* Allocates for `tile_count` tiles. False: out of memory. Must be released in every case. */
bool aur_spread_create(const aur_filter *filter, size_t cell, size_t channel_count, size_t tile_count,
                       aur_spread **spread);
void aur_spread_destroy(aur_spread *spread);

static inline size_t aur_spread_cell_of(const aur_spread *spread, size_t x, size_t y) {
    const size_t across = AUR_TILE_SIZE / spread->cell;
    return y % AUR_TILE_SIZE / spread->cell * across + x % AUR_TILE_SIZE / spread->cell;
}

/* The filter's weights along one axis, 2 reach + 1 of them, for a sample `offset` from its pixel's centre. */
static inline void aur_spread_weights(const aur_spread *spread, float offset, float *weights) {
    const size_t width = 2 * spread->reach + 1;
    const float at = (offset + 0.5f) * (float)AUR_SPREAD_BINS;
    size_t bin = at > 0.0f ? (size_t)at : 0;
    bin = bin < AUR_SPREAD_BINS ? bin : AUR_SPREAD_BINS - 1;
    const float part = at - (float)bin;
    const float *const low = &spread->table[bin * width], *const high = low + width;
    for (size_t i = 0; i < width; ++i)
        weights[i] = low[i] + part * (high[i] - low[i]);
}

/* Adds a sample of pixel (x, y) to the sums of a tile's cells: values[c] times `weight` and the filter. If
 * `counts`, their product is also added to the sum of weights. */
void aur_spread_add(const aur_spread *spread, double *cells, size_t x, size_t y, const float offset[2],
                    double weight, const float *values, bool counts);

/* What aur_film_open_tile, aur_film_take_tile and aur_film_close_tile do for such films. */
void aur_spread_set_targets(const struct aur_film *film, size_t index, const struct aur_film_targets *targets,
                            const aur_tile *tile, struct aur_film_before *before);
aur_result aur_spread_open_tile(const struct aur_film *film, aur_tile *tile, struct aur_film_before *before);
void aur_spread_take_tile(struct aur_film *film, aur_tile *tile);
void aur_spread_close_tile(struct aur_film *film, const aur_tile *tile, const struct aur_film_before *before);

/* The values in `count` channels, 3 at most, of the pixels of a rectangle with these corners, at most a tile:
 * values[pixel][channel], row by row. */
void aur_spread_values(const struct aur_film *film, const size_t corners[2], size_t first, size_t count,
                       double *values);
/* A pixel's squared standard error; false if there are too few steps. */
bool aur_spread_error(const struct aur_film *film, size_t pixel, double squares[3]);

/* Adds another film's cells, of the same layout. */
void aur_spread_merge(struct aur_film *film, const struct aur_film *part);
