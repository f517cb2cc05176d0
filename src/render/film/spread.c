#include "render/film/spread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/film/film.h"

size_t aur_spread_reach(const aur_filter *filter) {
    return (size_t)ceil(aur_filter_radius(filter) - 0.5);
}

void aur_spread_measure(const aur_filter *filter, size_t cell, size_t channel_count, aur_spread *spread) {
    *spread = (aur_spread){.reach = aur_spread_reach(filter), .cell = cell, .channels = channel_count + 1};
    spread->side = cell + 2 * spread->reach;
    spread->tile_cells = (AUR_TILE_SIZE / cell) * (AUR_TILE_SIZE / cell);
    spread->cell_values = spread->side * spread->side * spread->channels;
}

static void fill_table(const aur_filter *filter, aur_spread *spread) {
    const size_t width = 2 * spread->reach + 1;
    for (size_t bin = 0; bin <= AUR_SPREAD_BINS; ++bin)
        for (size_t i = 0; i < width; ++i) {
            const double offset = (double)bin / AUR_SPREAD_BINS - 0.5;
            spread->table[bin * width + i] =
                (float)aur_filter_value(filter, offset + (double)spread->reach - (double)i);
        }
}

bool aur_spread_create(const aur_filter *filter, size_t cell, size_t channel_count, size_t tile_count,
                       aur_spread **out) {
    aur_spread *const spread = *out = calloc(1, sizeof *spread);
    if (spread == NULL)
        return false;
    aur_spread_measure(filter, cell, channel_count, spread);
    const size_t cells = tile_count * spread->tile_cells, pixels = spread->side * spread->side;
    spread->table = malloc((AUR_SPREAD_BINS + 1) * (2 * spread->reach + 1) * sizeof *spread->table);
    spread->sums = calloc(cells, spread->cell_values * sizeof *spread->sums);
    spread->given = calloc(cells, sizeof *spread->given);
    spread->steps = calloc(cells, sizeof *spread->steps);
    if (cell == AUR_TILE_SIZE)
        spread->moments = calloc(cells, pixels * AUR_SPREAD_MOMENTS * sizeof *spread->moments);
    if (spread->table == NULL || spread->sums == NULL || spread->given == NULL || spread->steps == NULL ||
        (cell == AUR_TILE_SIZE && spread->moments == NULL))
        return false;
    fill_table(filter, spread);
    return true;
}

double aur_spread_overlap(const aur_spread *spread) {
    const size_t width = 2 * spread->reach + 1;
    double covariances[AUR_SPREAD_WIDTH_MAX] = {0.0}, sum = 0.0;
    for (size_t bin = 0; bin < AUR_SPREAD_BINS; ++bin)
        for (size_t i = 0; i < width; ++i)
            for (size_t j = i; j < width; ++j)
                covariances[j - i] +=
                    (double)spread->table[bin * width + i] * (double)spread->table[bin * width + j];
    for (size_t k = 0; k < width; ++k)
        sum += (k > 0 ? 2.0 : 1.0) * covariances[k] * covariances[k] / (covariances[0] * covariances[0]);
    return sum * sum; /* the filter is a product of one along each axis */
}

void aur_spread_destroy(aur_spread *spread) {
    if (spread == NULL)
        return;
    free(spread->table);
    free(spread->sums);
    free(spread->given);
    free(spread->steps);
    free(spread->moments);
    free(spread);
}

/* --- samples */

/* Adds a row of pixels; inlined with a constant `channels` for images without extra ones. */
static inline void add_row(size_t width, size_t channels, const float *across, double weight,
                           const double *values, double *sums) {
    for (size_t i = 0; i < width; ++i) {
        const double share = weight * (double)across[i];
        for (size_t c = 0; c < channels; ++c)
            sums[i * channels + c] += share * values[c];
    }
}

void aur_spread_add(const aur_spread *spread, double *cells, size_t x, size_t y, const float offset[2],
                    double weight, const float *values, bool counts) {
    enum { PLAIN = 4 };
    const size_t width = 2 * spread->reach + 1, channels = spread->channels;
    float across[AUR_SPREAD_WIDTH_MAX], down[AUR_SPREAD_WIDTH_MAX];
    double entry[3 + AUR_EXTRA_CHANNELS_MAX + 1];
    aur_spread_weights(spread, offset[0], across);
    aur_spread_weights(spread, offset[1], down);
    for (size_t c = 0; c + 1 < channels; ++c)
        entry[c] = (double)values[c];
    entry[channels - 1] = counts ? 1.0 : 0.0;
    double *const sums = cells + aur_spread_cell_of(spread, x, y) * spread->cell_values;
    for (size_t j = 0; j < width; ++j) {
        double *const row = sums + ((y % spread->cell + j) * spread->side + x % spread->cell) * channels;
        const double share = weight * (double)down[j];
        if (down[j] == 0.0f)
            continue;
        if (channels == PLAIN)
            add_row(width, PLAIN, across, share, entry, row);
        else
            add_row(width, channels, across, share, entry, row);
    }
}

/* --- tiles */

static size_t first_cell(const aur_film *film, const aur_tile *tile) {
    return aur_film_tile_at(film, tile->x0, tile->y0) * film->spread->tile_cells;
}

static size_t clamped(size_t at, size_t first, size_t end) {
    return at < first ? first : at < end ? at : end - 1;
}

/* Pixels outside a crop get as many samples as the nearest one in it. */
void aur_spread_set_targets(const aur_film *film, size_t index, const aur_film_targets *targets,
                            const aur_tile *tile, aur_film_before *before) {
    const aur_film_layout *const layout = &film->layout;
    const aur_spread *const spread = film->spread;
    const size_t width = layout->x1 - layout->x0, stride = tile->stride, rows = tile->y1 - tile->y0;
    uint32_t most[AUR_TILE_SIZE * AUR_TILE_SIZE] = {0};
    size_t columns[AUR_TILE_SIZE], at[AUR_TILE_SIZE];
    for (size_t i = 0; i < stride; ++i) {
        columns[i] = aur_spread_cell_of(spread, tile->x0 + i, 0);
        at[i] = clamped(tile->x0 + i, layout->x0, layout->x1) - layout->x0;
    }
    for (size_t j = 0; j < rows; ++j) {
        const size_t y = clamped(tile->y0 + j, layout->y0, layout->y1) - layout->y0;
        uint32_t *const of_row = most + aur_spread_cell_of(spread, 0, tile->y0 + j);
        for (size_t i = 0; i < stride; ++i) {
            const uint32_t target =
                targets->pixels != NULL ? targets->pixels[y * width + at[i]] : targets->all;
            of_row[columns[i]] = target > of_row[columns[i]] ? target : of_row[columns[i]];
        }
    }
    for (size_t j = 0; j < rows; ++j) {
        const size_t row = aur_spread_cell_of(spread, 0, tile->y0 + j);
        for (size_t i = 0; i < stride; ++i) {
            before->targets[j * stride + i] = most[row + columns[i]];
            before->given[j * stride + i] = spread->given[index * spread->tile_cells + row + columns[i]];
        }
    }
}

static bool has_samples(const aur_film *film, const aur_tile *tile) {
    const uint32_t *const given = film->spread->given + first_cell(film, tile);
    uint32_t any = 0;
    for (size_t cell = 0; cell < film->spread->tile_cells; ++cell)
        any |= given[cell];
    return any != 0;
}

aur_result aur_spread_open_tile(const aur_film *film, aur_tile *tile, aur_film_before *before) {
    const aur_spread *const spread = film->spread;
    const size_t pixels = tile->stride * (tile->y1 - tile->y0);
    const size_t bytes = spread->tile_cells * spread->cell_values * sizeof *tile->sums;
    tile->spread = spread;
    tile->sums = malloc(bytes);
    tile->counts = calloc(pixels, sizeof *tile->counts);
    before->cells = spread->moments != NULL ? malloc(bytes) : NULL;
    if (tile->sums == NULL || tile->counts == NULL || (spread->moments != NULL && before->cells == NULL))
        return AUR_ERROR_MEMORY;
    if (has_samples(film, tile))
        memcpy(tile->sums, &spread->sums[first_cell(film, tile) * spread->cell_values], bytes);
    else /* pages that were never written are not read either */
        memset(tile->sums, 0, bytes);
    if (before->cells != NULL)
        memcpy(before->cells, tile->sums, bytes);
    for (size_t k = 0; k < pixels; ++k) {
        size_t at;
        if (aur_film_has(film, tile->x0 + k % tile->stride, tile->y0 + k / tile->stride, &at))
            tile->counts[k] = film->counts[at];
    }
    return AUR_OK;
}

void aur_spread_take_tile(aur_film *film, aur_tile *tile) {
    aur_spread *const spread = film->spread;
    const size_t first = first_cell(film, tile), pixels = tile->stride * (tile->y1 - tile->y0);
    memcpy(&spread->sums[first * spread->cell_values], tile->sums,
           spread->tile_cells * spread->cell_values * sizeof *tile->sums);
    const uint32_t last = tile->first + tile->count;
    bool empty[AUR_TILE_SIZE * AUR_TILE_SIZE];
    memset(empty, true, sizeof empty);
    for (size_t k = 0; k < pixels; ++k) {
        const size_t x = tile->x0 + k % tile->stride, y = tile->y0 + k / tile->stride;
        const size_t cell = aur_spread_cell_of(spread, x, y);
        uint32_t *const given = &spread->given[first + cell];
        empty[cell] = false;
        const uint32_t end = tile->ends != NULL && tile->ends[k] < last ? tile->ends[k] : last;
        size_t at;
        *given = end > *given ? end : *given;
        if (!aur_film_has(film, x, y, &at))
            continue;
        film->counts[at] = tile->counts[k];
        film->given[at] = *given;
    }
    for (size_t cell = 0; cell < spread->tile_cells; ++cell) /* without pixels, and never short of samples */
        if (empty[cell])
            spread->given[first + cell] = last;
}

/* Records a step of `count` samples of each pixel, after which a cell has the sums `now`. */
static void note_step(const aur_spread *spread, uint32_t count, const double *before, const double *now,
                      double *moments) {
    for (size_t i = 0; i < spread->side * spread->side; ++i) {
        double step[4];
        for (size_t c = 0; c < 4; ++c) {
            const size_t value = i * spread->channels + (c < 3 ? c : spread->channels - 1);
            step[c] = now[value] - before[value];
        }
        double *const entry = &moments[i * AUR_SPREAD_MOMENTS];
        for (size_t c = 0; c < 3; ++c) {
            entry[c] += step[c] * step[c] / (double)count;
            entry[3 + c] += step[c] * step[3] / (double)count;
        }
        entry[6] += step[3] * step[3] / (double)count;
    }
}

void aur_spread_close_tile(aur_film *film, const aur_tile *tile, const aur_film_before *before) {
    aur_spread *const spread = film->spread;
    const size_t first = first_cell(film, tile), pixels = tile->stride * (tile->y1 - tile->y0);
    uint32_t given[AUR_TILE_SIZE * AUR_TILE_SIZE] = {0}; /* before, by cells */
    for (size_t k = 0; k < pixels; ++k)
        given[aur_spread_cell_of(spread, tile->x0 + k % tile->stride, tile->y0 + k / tile->stride)] =
            before->given[k];
    for (size_t cell = 0; cell < spread->tile_cells; ++cell) {
        if (spread->given[first + cell] <= given[cell])
            continue;
        ++spread->steps[first + cell];
        if (spread->moments != NULL)
            note_step(spread, spread->given[first + cell] - given[cell],
                      before->cells + cell * spread->cell_values,
                      &spread->sums[(first + cell) * spread->cell_values],
                      &spread->moments[(first + cell) * spread->side * spread->side * AUR_SPREAD_MOMENTS]);
    }
}

/* --- the image */

/* A cell that reaches a pixel. */
typedef struct reaching_cell {
    size_t cell;    /* of the film */
    size_t in_cell; /* of the pixel in it */
} reaching_cell;

enum { CELLS_MAX = (2 * AUR_FILTER_REACH_MAX / 4 + 2) * (2 * AUR_FILTER_REACH_MAX / 4 + 2) };

/* The cells with samples that reach a pixel, in the order of their positions. */
static size_t find_cells(const aur_film *film, size_t pixel, reaching_cell *found) {
    const aur_film_layout *const layout = &film->layout;
    const aur_spread *const spread = film->spread;
    const size_t cell = spread->cell, reach = spread->reach, width = layout->x1 - layout->x0;
    const size_t x = layout->x0 + pixel % width, y = layout->y0 + pixel / width;
    const aur_film_area area = aur_film_area_of(layout);
    const size_t left = x > area.x0 + reach ? x - reach : area.x0;
    const size_t top = y > area.y0 + reach ? y - reach : area.y0;
    const size_t right = x + reach < area.x1 ? x + reach : area.x1 - 1;
    const size_t bottom = y + reach < area.y1 ? y + reach : area.y1 - 1;
    size_t count = 0;
    for (size_t row = top / cell; row <= bottom / cell; ++row)
        for (size_t column = left / cell; column <= right / cell; ++column) {
            const size_t at = aur_film_tile_at(film, column * cell, row * cell) * spread->tile_cells +
                              aur_spread_cell_of(spread, column * cell, row * cell);
            if (spread->given[at] > 0)
                found[count++] =
                    (reaching_cell){at, (y + reach - row * cell) * spread->side + x + reach - column * cell};
        }
    return count;
}

static double sum_of(const aur_spread *spread, const reaching_cell *at, size_t channel) {
    return spread->sums[at->cell * spread->cell_values + at->in_cell * spread->channels + channel] /
           (double)spread->given[at->cell];
}

/* Values of a pixel while they are summed: of 3 channels, and the weight. */
enum { TERMS = 4 };

/* Pixels of the image, and what is read of them. */
typedef struct reading {
    size_t x0, x1, y0, y1;
    size_t first, count; /* channels */
    double (*sums)[TERMS];
} reading;

/* Adds a row of a cell's means. A division by a power of two, which most numbers of samples are, is exact as
 * a product, and faster. Inlined with constants, because that is read most. */
static inline void add_means(size_t width, size_t channels, size_t count, const double *from,
                             const double *weights, uint32_t samples, double (*sums)[TERMS]) {
    const double divisor = (double)samples, factor = 1.0 / divisor;
    if ((samples & (samples - 1)) == 0)
        for (size_t i = 0; i < width; ++i) {
            for (size_t c = 0; c < count; ++c)
                sums[i][c] += from[i * channels + c] * factor;
            sums[i][TERMS - 1] += weights[i * channels] * factor;
        }
    else
        for (size_t i = 0; i < width; ++i) {
            for (size_t c = 0; c < count; ++c)
                sums[i][c] += from[i * channels + c] / divisor;
            sums[i][TERMS - 1] += weights[i * channels] / divisor;
        }
}

/* Adds what the cell at a column and row of the grid contributes. */
static void add_cell(const aur_film *film, size_t column, size_t row, const reading *to) {
    enum { PLAIN = 4 };
    const aur_spread *const spread = film->spread;
    const size_t x = column * spread->cell, y = row * spread->cell, reach = spread->reach;
    const size_t at = aur_film_tile_at(film, x, y) * spread->tile_cells + aur_spread_cell_of(spread, x, y);
    const size_t left = to->x0 + reach > x ? to->x0 : x - reach;
    const size_t right = to->x1 < x + spread->cell + reach ? to->x1 : x + spread->cell + reach;
    const size_t top = to->y0 + reach > y ? to->y0 : y - reach;
    const size_t bottom = to->y1 < y + spread->cell + reach ? to->y1 : y + spread->cell + reach;
    const size_t in_cell = (top + reach - y) * spread->side + left + reach - x;
    const double *from = &spread->sums[at * spread->cell_values + in_cell * spread->channels];
    double(*sums)[TERMS] = to->sums + (top - to->y0) * (to->x1 - to->x0) + left - to->x0;
    for (size_t j = top; j < bottom && spread->given[at] > 0; ++j) {
        const double *const first = from + to->first, *const weights = from + spread->channels - 1;
        if (spread->channels == PLAIN && to->count == 3)
            add_means(right - left, PLAIN, 3, first, first + 3, spread->given[at], sums);
        else if (to->count == 3)
            add_means(right - left, spread->channels, 3, first, weights, spread->given[at], sums);
        else
            add_means(right - left, spread->channels, to->count, first, weights, spread->given[at], sums);
        from += spread->side * spread->channels;
        sums += to->x1 - to->x0;
    }
}

void aur_spread_values(const aur_film *film, const size_t corners[2], size_t first, size_t count,
                       double *values) {
    double sums[AUR_TILE_SIZE * AUR_TILE_SIZE][TERMS];
    const aur_film_layout *const layout = &film->layout;
    const size_t cell = film->spread->cell, reach = film->spread->reach, width = layout->x1 - layout->x0;
    const reading to = {.x0 = layout->x0 + corners[0] % width,
                        .x1 = layout->x0 + corners[1] % width + 1,
                        .y0 = layout->y0 + corners[0] / width,
                        .y1 = layout->y0 + corners[1] / width + 1,
                        .first = first,
                        .count = count,
                        .sums = sums};
    const aur_film_area area = aur_film_area_of(layout);
    const size_t pixels = (to.x1 - to.x0) * (to.y1 - to.y0);
    const size_t right = to.x1 + reach < area.x1 ? to.x1 + reach : area.x1;
    const size_t bottom = to.y1 + reach < area.y1 ? to.y1 + reach : area.y1;
    memset(sums, 0, pixels * sizeof *sums);
    for (size_t row = (to.y0 > area.y0 + reach ? to.y0 - reach : area.y0) / cell; row * cell < bottom; ++row)
        for (size_t column = (to.x0 > area.x0 + reach ? to.x0 - reach : area.x0) / cell;
             column * cell < right; ++column)
            add_cell(film, column, row, &to);
    for (size_t i = 0; i < pixels; ++i) {
        const double weight = sums[i][TERMS - 1];
        for (size_t c = 0; c < count; ++c)
            *values++ = weight != 0.0 ? sums[i][c] / weight : 0.0;
    }
}

/* A value is the ratio of sums over the cells, s / w. Its variance, to first order, is that of s - (value) w
 * over w^2; the cells' steps are independent. */
bool aur_spread_error(const aur_film *film, size_t pixel, double squares[3]) {
    const aur_spread *const spread = film->spread;
    reaching_cell cells[CELLS_MAX];
    const size_t count = find_cells(film, pixel, cells);
    double values[3], weight = 0.0;
    bool good = count > 0 && spread->moments != NULL;
    aur_spread_values(film, (const size_t[2]){pixel, pixel}, 0, 3, values);
    for (size_t i = 0; i < count; ++i) {
        weight += sum_of(spread, &cells[i], spread->channels - 1);
        good = good && spread->steps[cells[i].cell] > 1;
    }
    for (size_t c = 0; good && c < 3; ++c) {
        const double value = values[c];
        squares[c] = 0.0;
        for (size_t i = 0; i < count; ++i) {
            const size_t cell = cells[i].cell;
            const double *const entry =
                &spread
                     ->moments[(cell * spread->side * spread->side + cells[i].in_cell) * AUR_SPREAD_MOMENTS];
            const double mean =
                sum_of(spread, &cells[i], c) - value * sum_of(spread, &cells[i], spread->channels - 1);
            const double given = spread->given[cell];
            const double square =
                entry[c] - 2.0 * value * entry[3 + c] + value * value * entry[6] - given * mean * mean;
            squares[c] += fmax(square, 0.0) / ((double)(spread->steps[cell] - 1) * given);
        }
        squares[c] /= weight * weight;
    }
    return good;
}

void aur_spread_merge(aur_film *film, const aur_film *part) {
    aur_spread *const to = film->spread;
    const aur_spread *const from = part->spread;
    const size_t cells = film->tile_count * to->tile_cells;
    for (size_t i = 0; i < cells * to->cell_values; ++i)
        to->sums[i] += from->sums[i];
    for (size_t i = 0; to->moments != NULL && i < cells * to->side * to->side * AUR_SPREAD_MOMENTS; ++i)
        to->moments[i] += from->moments[i];
    for (size_t i = 0; i < cells; ++i) {
        to->given[i] += from->given[i];
        to->steps[i] += from->steps[i];
    }
}
