/* Internals of a film: sums of samples for each pixel, and the progress of each tile. */
#pragma once

#include <aureole-render/film.h>
#include <pthread.h>
#include <stdio.h>

#include "render/film/spread.h"
#include "render/film/tile.h"

/* What a channel shows of its sums. */
typedef enum aur_channel_kind {
    AUR_CHANNEL_MEAN,
    /* The number of samples. */
    AUR_CHANNEL_COUNT,
    /* The variance of one sample of channel 0, 1 or 2; the sums are of squares. */
    AUR_CHANNEL_VARIANCE_R,
    AUR_CHANNEL_VARIANCE_G,
    AUR_CHANNEL_VARIANCE_B,
    AUR_CHANNEL_KIND_COUNT
} aur_channel_kind;

typedef struct aur_film_channel {
    char name[AUR_CHANNEL_NAME_CAPACITY];
    aur_channel_kind kind;
} aur_film_channel;

/* The first three channels are R, G, B. */
typedef struct aur_film_layout {
    /* Of the whole image. */
    size_t width, height;
    /* The film's pixels: x0 <= x < x1, y0 <= y < y1. */
    size_t x0, x1, y0, y1;
    size_t channel_count;
    /* Pixels share samples by this filter, in cells of this many pixels along a side; 0: they do not. */
    size_t cell;
    aur_filter filter;
} aur_film_layout;

/* The pixels whose samples contribute to those of a film. */
typedef struct aur_film_area {
    size_t x0, x1, y0, y1;
} aur_film_area;

static inline aur_film_area aur_film_area_of(const aur_film_layout *layout) {
    const size_t reach = layout->cell > 0 ? aur_spread_reach(&layout->filter) : 0;
    return (aur_film_area){layout->x0 > reach ? layout->x0 - reach : 0,
                           layout->x1 + reach < layout->width ? layout->x1 + reach : layout->width,
                           layout->y0 > reach ? layout->y0 - reach : 0,
                           layout->y1 + reach < layout->height ? layout->y1 + reach : layout->height};
}

struct aur_film {
    aur_film_layout layout;
    aur_film_channel *channels;
    /* The first tile on the grid over the whole image, and the number of tiles: those of all pixels whose
     * samples contribute. */
    size_t column0, row0, columns, tile_count;
    /* For each pixel, row by row: the samples taken, the sums of each channel, and the number of samples in
     * the sums, which excludes invalid ones. Where pixels share samples, `spread` has the sums, and `sums`
     * and `squares` are unused. */
    uint32_t *given;
    double *sums;
    uint32_t *counts;
    /* For each pixel: steps with samples, and over them the sum of n_b * m_b^2 for R, G, B (aur_film_error).
     */
    uint32_t *steps;
    double *squares;
    aur_spread *spread;    /* NULL: pixels share no samples */
    aur_counters counters; /* of all samples */
    /* Held while a tile's sums are written or the whole film is read, so that it can be read while it is
     * rendered. */
    pthread_mutex_t *lock;
};

static inline size_t aur_film_pixel_count(const aur_film *film) {
    return (film->layout.x1 - film->layout.x0) * (film->layout.y1 - film->layout.y0);
}

/* Whether the film contains pixel (x, y) of the image, and its index. */
static inline bool aur_film_has(const aur_film *film, size_t x, size_t y, size_t *at) {
    const aur_film_layout *const layout = &film->layout;
    if (x < layout->x0 || x >= layout->x1 || y < layout->y0 || y >= layout->y1)
        return false;
    *at = (y - layout->y0) * (layout->x1 - layout->x0) + (x - layout->x0);
    return true;
}

/* The tile of pixel (x, y) of the image. */
static inline size_t aur_film_tile_at(const aur_film *film, size_t x, size_t y) {
    return (y / AUR_TILE_SIZE - film->row0) * film->columns + x / AUR_TILE_SIZE - film->column0;
}

/* Cells of films whose pixels may have different numbers of samples; other films have one cell per tile. */
enum { AUR_FILM_CELL = 4 };

/* Computes the fields that depend only on the layout. */
void aur_film_compute_area(aur_film *film);

/* An empty film; the caller names its channels after the first three. Errors: ARGUMENT, MEMORY. */
aur_result aur_film_create(const aur_film_layout *layout, aur_film **film, aur_error *error);

/* The sample counts of a tile's pixels before a step, row by row, and their targets. */
typedef struct aur_film_before {
    double sums[AUR_TILE_SIZE * AUR_TILE_SIZE][3];
    uint32_t counts[AUR_TILE_SIZE * AUR_TILE_SIZE];
    uint32_t given[AUR_TILE_SIZE * AUR_TILE_SIZE], targets[AUR_TILE_SIZE * AUR_TILE_SIZE];
    double *cells; /* where pixels share samples: the cells' sums; NULL: not needed */
} aur_film_before;

/* The tile that a pixel lies in. */
static inline size_t aur_film_tile_of(const aur_film *film, size_t pixel) {
    const aur_film_layout *const layout = &film->layout;
    const size_t width = layout->x1 - layout->x0;
    return aur_film_tile_at(film, layout->x0 + pixel % width, layout->y0 + pixel / width);
}

/* The units that receive samples as a whole: pixels, or cells where pixels share samples. */
static inline size_t aur_film_unit_count(const aur_film *film) {
    return film->spread != NULL ? film->tile_count * film->spread->tile_cells : aur_film_pixel_count(film);
}

static inline uint32_t aur_film_unit_given(const aur_film *film, size_t unit) {
    return film->spread != NULL ? film->spread->given[unit] : film->given[unit];
}

static inline size_t aur_film_unit_tile(const aur_film *film, size_t unit) {
    return film->spread != NULL ? unit / film->spread->tile_cells : aur_film_tile_of(film, unit);
}

/* The target number of samples of each pixel. */
typedef struct aur_film_targets {
    const uint32_t *pixels; /* of the film, row by row; NULL: `all` */
    uint32_t all;
    bool whole_tiles; /* all pixels of a tile get the largest target of any of them */
} aur_film_targets;

/* Opens tile `index` for its missing samples, tile->first to tile->first + tile->count - 1; without sums if
 * none are missing. The tile's sums are copies. Different tiles may be open in different threads. Must be
 * closed in every case. Errors: MEMORY. */
aur_result aur_film_open_tile(aur_film *film, size_t index, const aur_film_targets *targets, aur_tile *tile,
                              aur_film_before *before);
/* Commits the tile's sums and counters for the samples from tile->first to tile->first + tile->count - 1, and
 * advances to the next ones. */
void aur_film_take_tile(aur_film *film, aur_tile *tile);
/* Records the step's samples, and discards uncommitted sums. */
void aur_film_close_tile(aur_film *film, aur_tile *tile, aur_film_before *before);

/* Sets the position of the tile in the film: x0 .. y1 and the stride. */
void aur_film_set_tile(const aur_film *film, size_t index, aur_tile *tile);

/* Serialises all data of a tile, with its counters, to and from another process that renders the same image.
 */
void aur_film_put_tile(const aur_film *film, size_t index, struct aur_bytes *bytes);
void aur_film_get_tile(aur_film *film, size_t index, const aur_counters *counted,
                       struct aur_bytes_reader *bytes);

/* What aur_film_save writes, to a stream that remembers its failures; and its bytes. */
void aur_film_write(const aur_film *film, FILE *stream);
size_t aur_film_file_size(const aur_film *film);

/* A pixel's mean in a channel; 0 without samples. */
double aur_film_mean(const aur_film *film, size_t pixel, size_t channel);
/* The same in three channels, from `first` on, of the pixels of a rectangle, row by row. `corners` are its
 * first and last pixel; it has at most AUR_TILE_SIZE pixels on a side. */
void aur_film_colours(const aur_film *film, const size_t corners[2], size_t first, double (*values)[3]);

/* Samples that every pixel was given. */
uint32_t aur_film_samples(const aur_film *film);
/* What is counted of all samples, also while tiles are being rendered. */
aur_counters aur_film_counted(const aur_film *film);

/* A checkpoint file of a long render: identity, progress and films. */

typedef struct aur_checkpoint {
    /* What the films depend on, one line "KEY VALUE" each: a render continues only from a checkpoint with the
     * same lines. */
    char *identity;
    size_t word_count;
    uint64_t *words; /* numbers of the creator */
    size_t film_count;
    aur_film **films;
} aur_checkpoint;

/* Replaces the file atomically. Errors: WRITE, MEMORY. */
aur_result aur_checkpoint_save(const char *path, const char *identity, size_t word_count,
                               const uint64_t *words, size_t film_count, const aur_film *const *films,
                               aur_error *error);
/* Must be released in every case. `input`: the file is an input that must not be overwritten
 * (points/base/file.h), unlike a checkpoint to continue from. Errors: OPEN, FORMAT, MEMORY; ARGUMENT for an
 * input that is an output. */
aur_result aur_checkpoint_load(const char *path, bool input, aur_checkpoint *checkpoint, aur_error *error);
aur_result aur_checkpoint_load_memory(const char *name, size_t size, const void *data,
                                      aur_checkpoint *checkpoint, aur_error *error);
void aur_checkpoint_release(aur_checkpoint *checkpoint);

/* Whether two identities are equal; lines that begin with `but` may differ (NULL: none). The error, ARGUMENT,
 * names `path` and the first line that differs. */
aur_result aur_identity_compare(const char *path, const char *saved, const char *current, const char *but,
                                aur_error *error);
/* The value of a key's line, or NULL; *length is its length. */
const char *aur_identity_find(const char *identity, const char *key, size_t *length);

/* Adds the samples of `part`, an image of the same size and channels. Its pixels are the film's or whole
 * tiles of them (16 x 16 pixels on a grid over the whole image). Pixels with samples in only one of the two
 * are copied bit for bit; where both have some, the sums are added in double precision. Where pixels share
 * samples, the part must have the same pixels as the film. The samples must be different ones, which cannot
 * be checked. Errors: ARGUMENT for another size, filter or channels, or pixels that do not fit. */
aur_result aur_film_merge(aur_film *film, const aur_film *part, aur_error *error);

/* Writes the whole film, little-endian, with a checksum; the file is replaced atomically. Errors: WRITE,
 * MEMORY. */
aur_result aur_film_save(const aur_film *film, const char *path, aur_error *error);
/* Errors: OPEN, FORMAT (not a film, damaged, or of another version), MEMORY. */
aur_result aur_film_load(const char *path, aur_film **film, aur_error *error);
/* The same from memory; `name` is used in messages. */
aur_result aur_film_load_memory(const char *name, size_t size, const void *data, aur_film **film,
                                aur_error *error);
