#include "render/film/film.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/image/format.h"

static bool is_good(const aur_film_layout *layout) {
    enum { LARGEST_SIDE = 1 << 24, MOST_CHANNELS = 1 << 16 };
    return layout->x0 < layout->x1 && layout->x1 <= layout->width && layout->width <= LARGEST_SIDE &&
           layout->y0 < layout->y1 && layout->y1 <= layout->height && layout->height <= LARGEST_SIDE &&
           layout->channel_count >= 3 && layout->channel_count <= MOST_CHANNELS &&
           (layout->cell == 0 || layout->cell == AUR_FILM_CELL || layout->cell == AUR_TILE_SIZE) &&
           (layout->cell == 0 || aur_spread_reach(&layout->filter) <= AUR_FILTER_REACH_MAX);
}

void aur_film_compute_area(aur_film *film) {
    const aur_film_area area = aur_film_area_of(&film->layout);
    film->column0 = area.x0 / AUR_TILE_SIZE;
    film->row0 = area.y0 / AUR_TILE_SIZE;
    film->columns = (area.x1 + AUR_TILE_SIZE - 1) / AUR_TILE_SIZE - film->column0;
    film->tile_count = film->columns * ((area.y1 + AUR_TILE_SIZE - 1) / AUR_TILE_SIZE - film->row0);
}

aur_result aur_film_create(const aur_film_layout *layout, aur_film **out, aur_error *error) {
    *out = NULL;
    if (!is_good(layout))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no film has %zu x %zu pixels and %zu channels",
                        layout->width, layout->height, layout->channel_count);
    aur_film *const film = calloc(1, sizeof *film);
    if (film == NULL)
        return aur_fail_memory(error);
    film->layout = *layout;
    aur_film_compute_area(film);
    const size_t pixels = aur_film_pixel_count(film), stored = layout->cell == 0 ? pixels : 0;
    film->channels = calloc(layout->channel_count, sizeof *film->channels);
    film->given = calloc(pixels, sizeof *film->given);
    film->sums = calloc(stored + 1, layout->channel_count * sizeof *film->sums);
    film->counts = calloc(pixels, sizeof *film->counts);
    film->steps = calloc(pixels, sizeof *film->steps);
    film->squares = calloc(stored + 1, 3 * sizeof *film->squares);
    const bool spread =
        layout->cell == 0 || aur_spread_create(&layout->filter, layout->cell, layout->channel_count,
                                               film->tile_count, &film->spread);
    film->lock = malloc(sizeof *film->lock);
    if (film->lock != NULL && pthread_mutex_init(film->lock, NULL) != 0) {
        free(film->lock);
        film->lock = NULL;
    }
    if (film->channels == NULL || film->given == NULL || film->sums == NULL || film->counts == NULL ||
        film->steps == NULL || film->squares == NULL || film->lock == NULL || !spread) {
        aur_film_destroy(film);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for an image of %zu x %zu", layout->width,
                        layout->height);
    }
    for (size_t c = 0; c < 3; ++c)
        film->channels[c].name[0] = "RGB"[c];
    *out = film;
    return AUR_OK;
}

void aur_film_destroy(aur_film *film) {
    if (film == NULL)
        return;
    free(film->channels);
    free(film->given);
    free(film->sums);
    free(film->counts);
    free(film->steps);
    free(film->squares);
    aur_spread_destroy(film->spread);
    if (film->lock != NULL)
        pthread_mutex_destroy(film->lock);
    free(film->lock);
    free(film);
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

/* The index in the film of the tile's first pixel. */
static size_t first_pixel(const aur_film *film, const aur_tile *tile) {
    const aur_film_layout *const layout = &film->layout;
    return (tile->y0 - layout->y0) * (layout->x1 - layout->x0) + (tile->x0 - layout->x0);
}

/* Which samples the pixels of a tile lack. */
static void set_targets(const aur_film *film, size_t index, const aur_film_targets *targets, aur_tile *tile,
                        aur_film_before *before) {
    const size_t width = film->layout.x1 - film->layout.x0;
    const size_t count = tile->stride * (tile->y1 - tile->y0);
    uint32_t begin = UINT32_MAX, end = 0, most = targets->all;
    bool even = true;
    if (film->spread != NULL)
        aur_spread_set_targets(film, index, targets, tile, before);
    for (size_t k = 0; k < count && film->spread == NULL; ++k) {
        const size_t at = first_pixel(film, tile) + k / tile->stride * width + k % tile->stride;
        before->given[k] = film->given[at];
        before->targets[k] = targets->pixels != NULL ? targets->pixels[at] : targets->all;
    }
    for (size_t k = 0; k < count; ++k)
        most = before->targets[k] > most ? before->targets[k] : most;
    for (size_t k = 0; k < count; ++k) {
        if (targets->whole_tiles)
            before->targets[k] = most;
        even = even && before->given[k] == before->given[0] && before->targets[k] == before->targets[0];
        if (before->given[k] >= before->targets[k])
            continue;
        begin = before->given[k] < begin ? before->given[k] : begin;
        end = before->targets[k] > end ? before->targets[k] : end;
    }
    tile->first = begin < end ? begin : end;
    tile->count = end - tile->first;
    tile->begins = even ? NULL : before->given;
    tile->ends = even ? NULL : before->targets;
}

void aur_film_set_tile(const aur_film *film, size_t index, aur_tile *tile) {
    const aur_film_area area = aur_film_area_of(&film->layout);
    const size_t x = (film->column0 + index % film->columns) * AUR_TILE_SIZE;
    const size_t y = (film->row0 + index / film->columns) * AUR_TILE_SIZE;
    tile->x0 = larger(x, area.x0);
    tile->x1 = smaller(x + AUR_TILE_SIZE, area.x1);
    tile->y0 = larger(y, area.y0);
    tile->y1 = smaller(y + AUR_TILE_SIZE, area.y1);
    tile->stride = tile->x1 - tile->x0;
}

aur_result aur_film_open_tile(aur_film *film, size_t index, const aur_film_targets *targets, aur_tile *tile,
                              aur_film_before *before) {
    const size_t channels = film->layout.channel_count, width = film->layout.x1 - film->layout.x0;
    aur_film_set_tile(film, index, tile);
    before->cells = NULL;
    set_targets(film, index, targets, tile, before);
    if (tile->count == 0)
        return AUR_OK;
    tile->channel_count = channels;
    if (film->spread != NULL)
        return aur_spread_open_tile(film, tile, before);
    const size_t rows = tile->y1 - tile->y0;
    tile->sums = malloc(tile->stride * rows * channels * sizeof *tile->sums);
    tile->counts = malloc(tile->stride * rows * sizeof *tile->counts);
    if (tile->sums == NULL || tile->counts == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t row = 0; row < rows; ++row) {
        const size_t from = first_pixel(film, tile) + row * width, to = row * tile->stride;
        memcpy(&tile->sums[to * channels], &film->sums[from * channels],
               tile->stride * channels * sizeof *tile->sums);
        memcpy(&tile->counts[to], &film->counts[from], tile->stride * sizeof *tile->counts);
    }
    for (size_t k = 0; k < tile->stride * rows; ++k) {
        memcpy(before->sums[k], &tile->sums[k * channels], sizeof before->sums[k]);
        before->counts[k] = tile->counts[k];
    }
    return AUR_OK;
}

void aur_film_take_tile(aur_film *film, aur_tile *tile) {
    const size_t channels = tile->channel_count, width = film->layout.x1 - film->layout.x0;
    pthread_mutex_lock(film->lock);
    if (film->spread != NULL)
        aur_spread_take_tile(film, tile);
    for (size_t row = 0; row < tile->y1 - tile->y0 && film->spread == NULL; ++row) {
        const size_t to = first_pixel(film, tile) + row * width, from = row * tile->stride;
        memcpy(&film->sums[to * channels], &tile->sums[from * channels],
               tile->stride * channels * sizeof *tile->sums);
        memcpy(&film->counts[to], &tile->counts[from], tile->stride * sizeof *tile->counts);
        for (size_t k = 0; k < tile->stride; ++k) {
            const uint32_t end = tile->ends != NULL && tile->ends[from + k] < tile->first + tile->count
                                     ? tile->ends[from + k]
                                     : tile->first + tile->count;
            film->given[to + k] = end > film->given[to + k] ? end : film->given[to + k];
        }
    }
    aur_counters_add(&film->counters, &tile->counters);
    pthread_mutex_unlock(film->lock);
    tile->counters = (aur_counters){0};
    tile->first += tile->count;
    tile->count = 0;
}

void aur_film_close_tile(aur_film *film, aur_tile *tile, aur_film_before *before) {
    const size_t width = film->layout.x1 - film->layout.x0;
    const bool open = tile->sums != NULL && tile->counts != NULL;
    pthread_mutex_lock(film->lock);
    if (film->spread != NULL && open && (film->spread->moments == NULL || before->cells != NULL))
        aur_spread_close_tile(film, tile, before);
    for (size_t k = 0; film->spread == NULL && open && k < (tile->y1 - tile->y0) * tile->stride; ++k) {
        const size_t at = first_pixel(film, tile) + k / tile->stride * width + k % tile->stride;
        const uint32_t count = film->counts[at] - before->counts[k];
        if (count == 0)
            continue;
        ++film->steps[at];
        for (size_t c = 0; c < 3; ++c) {
            const double sum = film->sums[at * tile->channel_count + c] - before->sums[k][c];
            film->squares[3 * at + c] += sum * sum / (double)count;
        }
    }
    pthread_mutex_unlock(film->lock);
    free(tile->sums);
    free(tile->counts);
    free(before->cells);
    aur_tile_free_slots(tile);
}

uint32_t aur_film_samples(const aur_film *film) {
    uint32_t least = UINT32_MAX;
    for (size_t i = 0; i < aur_film_unit_count(film); ++i)
        least = aur_film_unit_given(film, i) < least ? aur_film_unit_given(film, i) : least;
    return least;
}

aur_counters aur_film_counted(const aur_film *film) {
    pthread_mutex_lock(film->lock);
    const aur_counters counted = film->counters;
    pthread_mutex_unlock(film->lock);
    return counted;
}

/* Whether a side of the part lies on the same side of the film or between two tiles. */
static bool fits(size_t part, size_t whole) {
    return part == whole || part % AUR_TILE_SIZE == 0;
}

static aur_result check_part(const aur_film *film, const aur_film *part, aur_error *error) {
    const aur_film_layout *const a = &film->layout, *const b = &part->layout;
    if (a->width != b->width || a->height != b->height)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a part of an image of %zu x %zu cannot be added to one of %zu x %zu", b->width,
                        b->height, a->width, a->height);
    bool same = a->channel_count == b->channel_count;
    for (size_t c = 0; same && c < a->channel_count; ++c)
        same = strcmp(film->channels[c].name, part->channels[c].name) == 0 &&
               film->channels[c].kind == part->channels[c].kind;
    if (!same)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the part has other channels than the film");
    const bool same_crop = b->x0 == a->x0 && b->x1 == a->x1 && b->y0 == a->y0 && b->y1 == a->y1;
    if (a->cell != b->cell ||
        (a->cell > 0 && (!same_crop || memcmp(&a->filter, &b->filter, sizeof a->filter) != 0)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "pixels share samples by the filter, so a part must have the film's filter and crop");
    if (b->x0 < a->x0 || b->x1 > a->x1 || b->y0 < a->y0 || b->y1 > a->y1 || !fits(b->x0, a->x0) ||
        !fits(b->x1, a->x1) || !fits(b->y0, a->y0) || !fits(b->y1, a->y1))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the part's pixels %zu,%zu,%zu,%zu are not whole tiles of %d pixels of the film's "
                        "%zu,%zu,%zu,%zu",
                        b->x0, b->x1, b->y0, b->y1, (int)AUR_TILE_SIZE, a->x0, a->x1, a->y0, a->y1);
    return AUR_OK;
}

aur_result aur_film_merge(aur_film *film, const aur_film *part, aur_error *error) {
    const aur_result result = check_part(film, part, error);
    if (result != AUR_OK)
        return result;
    const aur_film_layout *const a = &film->layout, *const b = &part->layout;
    const size_t channels = a->channel_count, has_sums = film->spread == NULL;
    if (film->spread != NULL)
        aur_spread_merge(film, part);
    for (size_t y = b->y0; y < b->y1; ++y)
        for (size_t x = b->x0; x < b->x1; ++x) {
            const size_t to = (y - a->y0) * (a->x1 - a->x0) + (x - a->x0);
            const size_t from = (y - b->y0) * (b->x1 - b->x0) + (x - b->x0);
            for (size_t c = 0; c < has_sums * channels; ++c)
                film->sums[to * channels + c] += part->sums[from * channels + c];
            for (size_t c = 0; c < has_sums * 3; ++c)
                film->squares[3 * to + c] += part->squares[3 * from + c];
            film->given[to] += part->given[from];
            film->counts[to] += part->counts[from];
            film->steps[to] += part->steps[from];
        }
    aur_counters_add(&film->counters, &part->counters);
    return AUR_OK;
}

/* The unbiased estimate of the variance of one sample, from the mean and the mean square. */
static double variance_of(uint32_t count, double mean, double mean_square) {
    const double spread = mean_square - mean * mean;
    return count > 1 && spread > 0.0 ? spread * (double)count / (double)(count - 1) : 0.0;
}

/* `corners` as for aur_film_colours; values[pixel][channel]. */
static void find_means(const aur_film *film, const size_t corners[2], size_t first, size_t count,
                       double *means) {
    if (film->spread != NULL) {
        aur_spread_values(film, corners, first, count, means);
        return;
    }
    const size_t stride = film->layout.x1 - film->layout.x0,
                 width = corners[1] % stride - corners[0] % stride;
    for (size_t row = corners[0]; row <= corners[1]; row += stride)
        for (size_t pixel = row; pixel <= row + width; ++pixel) {
            const uint32_t samples = film->counts[pixel];
            const double *const sums = &film->sums[pixel * film->layout.channel_count + first];
            for (size_t c = 0; c < count; ++c)
                *means++ = samples > 0 ? sums[c] / (double)samples : 0.0;
        }
}

double aur_film_mean(const aur_film *film, size_t pixel, size_t channel) {
    double mean;
    find_means(film, (const size_t[2]){pixel, pixel}, channel, 1, &mean);
    return mean;
}

void aur_film_colours(const aur_film *film, const size_t corners[2], size_t first, double (*values)[3]) {
    find_means(film, corners, first, 3, *values);
}

static double channel_value(const aur_film *film, size_t pixel, size_t channel) {
    const aur_channel_kind kind = film->channels[channel].kind;
    const uint32_t count = film->counts[pixel];
    if (kind == AUR_CHANNEL_COUNT)
        return count;
    const double mean = aur_film_mean(film, pixel, channel);
    return kind == AUR_CHANNEL_MEAN
               ? mean
               : variance_of(count, aur_film_mean(film, pixel, kind - AUR_CHANNEL_VARIANCE_R), mean);
}

aur_result aur_film_develop(const aur_film *film, aur_image **out, aur_error *error) {
    const aur_film_layout *const layout = &film->layout;
    const size_t channels = layout->channel_count;
    *out = NULL;
    aur_image *image;
    const aur_result result =
        aur_image_create(layout->x1 - layout->x0, layout->y1 - layout->y0, channels, &image, error);
    if (result != AUR_OK)
        return result;
    for (size_t c = 0; c < channels; ++c)
        memcpy(image->channel_names[c], film->channels[c].name, AUR_CHANNEL_NAME_CAPACITY);
    pthread_mutex_lock(film->lock);
    for (size_t i = 0; i < aur_film_pixel_count(film); ++i)
        for (size_t c = 0; c < channels; ++c)
            image->data[i * channels + c] = (float)channel_value(film, i, c);
    pthread_mutex_unlock(film->lock);
    *out = image;
    return AUR_OK;
}

/* The squared standard errors of a pixel's R, G and B (aur_film_error); false before two steps. */
static bool squared_errors(const aur_film *film, size_t pixel, double squares[3]) {
    if (film->spread != NULL)
        return aur_spread_error(film, pixel, squares);
    if (film->steps[pixel] < 2)
        return false;
    const double count = film->counts[pixel];
    for (size_t c = 0; c < 3; ++c) {
        const double sum = film->sums[pixel * film->layout.channel_count + c];
        const double spread = film->squares[3 * pixel + c] - sum * sum / count;
        squares[c] = spread > 0.0 ? spread / ((double)(film->steps[pixel] - 1) * count) : 0.0;
    }
    return true;
}

aur_result aur_film_error(const aur_film *film, double rmse[4], aur_image **out, aur_error *error) {
    const size_t pixels = aur_film_pixel_count(film);
    double squares[3];
    if (out != NULL)
        *out = NULL;
    for (size_t i = 0; i < pixels; ++i)
        if (!squared_errors(film, i, squares))
            return aur_fail(
                error, AUR_ERROR_UNSUPPORTED,
                "a pixel has fewer than two steps of samples; an error is seen from two steps on");
    aur_image *image = NULL;
    if (out != NULL) {
        const aur_result result = aur_image_create(film->layout.x1 - film->layout.x0,
                                                   film->layout.y1 - film->layout.y0, 3, &image, error);
        if (result != AUR_OK)
            return result;
    }
    double total[4] = {0};
    for (size_t i = 0; i < pixels; ++i) {
        squared_errors(film, i, squares);
        for (size_t c = 0; c < 3; ++c) {
            total[c] += squares[c] / (double)pixels;
            total[3] += squares[c] / (3.0 * (double)pixels);
            if (image != NULL)
                image->data[3 * i + c] = (float)sqrt(squares[c]);
        }
    }
    for (size_t c = 0; rmse != NULL && c < 4; ++c)
        rmse[c] = sqrt(total[c]);
    if (out != NULL)
        *out = image;
    return AUR_OK;
}
