#include "render/replicas/replicas.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "render/driver/renderer.h"
#include "render/film/clamp.h"
#include "render/film/film.h"

/* Correlation between pixels is estimated within blocks of this side and with the blocks around them, so that
 * no border cuts what filters or patterns share. */
enum { BLOCK = 4 };

/* A grid of blocks over a film, in the whole image's. */
typedef struct block_grid {
    size_t first_column, first_row, columns, rows;
} block_grid;

static block_grid grid_of(const aur_film_layout *layout) {
    const size_t column = layout->x0 / BLOCK, row = layout->y0 / BLOCK;
    return (block_grid){column, row, (layout->x1 - 1) / BLOCK + 1 - column,
                        (layout->y1 - 1) / BLOCK + 1 - row};
}

aur_result aur_replicas_create(aur_renderer *renderer, const aur_render_options *options,
                               const char *integrator, size_t count, aur_replicas *replicas,
                               aur_error *error) {
    aur_render_options replica_options = *options;
    replica_options.integrator = integrator;
    replica_options.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    *replicas = (aur_replicas){0};
    for (size_t r = 0; r < count; ++r) {
        if (count > 1)
            replica_options.seed = aur_hash3(UINT64_C(0x7265706c696361), options->seed, r);
        const aur_result result = aur_render_create(renderer, &replica_options, &replicas->renders[r], error);
        if (result != AUR_OK)
            return result;
        replica_options.warnings = (aur_warnings){0}; /* the first replica has given them */
        replicas->count = r + 1;
    }
    replicas->pixel_count = aur_film_pixel_count(aur_render_film(replicas->renders[0]));
    const block_grid grid = grid_of(&aur_render_film(replicas->renders[0])->layout);
    const size_t blocks = grid.columns * grid.rows, entries = AUR_GRAM_ENTRIES(count);
    replicas->columns = grid.columns;
    replicas->rows = grid.rows;
    replicas->products = calloc(blocks, entries * sizeof *replicas->products);
    replicas->blocks = calloc(blocks, sizeof *replicas->blocks);
    return replicas->products != NULL && replicas->blocks != NULL ? AUR_OK : aur_fail_memory(error);
}

void aur_replicas_release(aur_replicas *replicas) {
    for (size_t r = 0; r < replicas->count; ++r)
        aur_render_destroy(replicas->renders[r]);
    free(replicas->products);
    free(replicas->blocks);
    *replicas = (aur_replicas){0};
}

aur_result aur_replicas_step(aur_replicas *replicas, const uint32_t *targets, size_t stride, size_t *done,
                             const atomic_bool *cancelled, aur_error *error) {
    aur_result result = AUR_OK;
    for (*done = 0; *done < replicas->count && result == AUR_OK; *done += result == AUR_OK)
        result = atomic_load(cancelled)
                     ? AUR_ERROR_CANCELLED
                     : aur_render_step_pixels(replicas->renders[*done], replicas->pixel_count,
                                              targets + *done * stride, error);
    return result;
}

double aur_replicas_rays(const aur_replicas *replicas) {
    uint64_t rays = 0;
    for (size_t r = 0; r < replicas->count; ++r)
        rays += aur_film_counted(aur_render_film(replicas->renders[r])).rays;
    return (double)rays;
}

void aur_spent_add(aur_spent *sum, const aur_replicas *replicas, uint64_t prepared) {
    aur_render_statistics *const all = &sum->all;
    const uint64_t rays = (uint64_t)aur_replicas_rays(replicas);
    all->rays += prepared + rays;
    sum->budget += rays;
    for (size_t r = 0; r < replicas->count; ++r) {
        aur_render_statistics one = {.size = sizeof one};
        aur_render_get_statistics(replicas->renders[r], &one, NULL);
        all->samples += one.samples;
        all->invalid_samples += one.invalid_samples;
        all->cut_paths += one.cut_paths;
        all->unsolved_weights += one.unsolved_weights;
        for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
            all->levels[l] += one.levels[l];
        all->prepare_seconds += one.prepare_seconds;
        all->render_seconds += one.render_seconds;
        all->cpu_seconds += one.cpu_seconds;
    }
}

void aur_replicas_read(const aur_replicas *replicas, const size_t corners[2], size_t first, size_t stride,
                       double (*values)[3]) {
    for (size_t r = 0; r < replicas->count; ++r)
        aur_film_colours(aur_render_film(replicas->renders[r]), corners, first, values + r * stride);
}

/* The mean of a pixel's values, values[replica * stride], over the replicas, and their deviations from it. */
static void find_deviations(size_t count, size_t stride, const double (*values)[3], double mean[3],
                            double d[3][AUR_REPLICAS_MAX]) {
    mean[0] = mean[1] = mean[2] = 0.0;
    for (size_t r = 0; r < count; ++r)
        for (size_t c = 0; c < 3; ++c) {
            d[c][r] = values[r * stride][c];
            mean[c] += values[r * stride][c] / (double)count;
        }
    for (size_t c = 0; c < 3; ++c)
        for (size_t r = 0; r < count; ++r)
            d[c][r] -= mean[c];
}

/* Converts the replicas' deviations d[channel][replica] from `mean` to those of a pixel's differences by
 * steps of `part` of these deviations, scaled back. */
static void weigh_steps(size_t count, aur_weighing weighing, size_t pixel, double part, const double mean[3],
                        double d[3][AUR_REPLICAS_MAX]) {
    double steps[AUR_REPLICAS_MAX][3], differences[AUR_REPLICAS_MAX][3];
    if (weighing.weights == NULL)
        return;
    for (size_t r = 0; r < count; ++r)
        for (size_t c = 0; c < 3; ++c)
            steps[r][c] = part * d[c][r];
    aur_error_apply(weighing.measure, &weighing.weights[pixel], mean, count, (const double(*)[3])steps,
                    differences);
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (size_t r = 0; r < count; ++r)
            sum += d[c][r] = differences[r][c] / part;
        for (size_t r = 0; r < count; ++r)
            d[c][r] -= sum / (double)count;
    }
}

/* Nonlinear differences are taken to the means of the other replicas (jackknife, Efron and Stein 1981):
 * longer steps overestimate the error of skewed values. */
void aur_replicas_weigh(size_t count, aur_weighing weighing, size_t pixel, const double mean[3],
                        double d[3][AUR_REPLICAS_MAX]) {
    weigh_steps(count, weighing, pixel, -1.0 / (double)(count - 1), mean, d);
}

/* The pixels of a film within a cell of a grid over the whole image. */
typedef struct pixel_range {
    size_t x0, x1, y0, y1; /* from the film's corner on */
} pixel_range;

static pixel_range cell_of(const aur_film_layout *layout, size_t side, size_t column, size_t row) {
    const size_t x = column * side, y = row * side;
    return (pixel_range){.x0 = (x > layout->x0 ? x : layout->x0) - layout->x0,
                         .x1 = (x + side < layout->x1 ? x + side : layout->x1) - layout->x0,
                         .y0 = (y > layout->y0 ? y : layout->y0) - layout->y0,
                         .y1 = (y + side < layout->y1 ? y + side : layout->y1) - layout->y0};
}

/* Values of a tile's pixels in all replicas: of pixel i in replica r the entry r * TILE_PIXELS + i. */
enum { TILE = AUR_TILE_SIZE, TILE_PIXELS = TILE * TILE };
typedef double tile_values[AUR_REPLICAS_MAX * TILE_PIXELS][3];

static void read_tile(const aur_replicas *replicas, const pixel_range *tile, size_t first,
                      tile_values values) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0;
    const size_t corners[2] = {tile->y0 * width + tile->x0, (tile->y1 - 1) * width + tile->x1 - 1};
    aur_replicas_read(replicas, corners, first, TILE_PIXELS, values);
}

/* Takes a tile's values over into `light`, and adds them to its means. */
static void add_tile(const aur_replicas *replicas, const pixel_range *tile, size_t width, double (*light)[3],
                     double (*means)[3]) {
    tile_values read;
    const size_t across = tile->x1 - tile->x0;
    read_tile(replicas, tile, 0, read);
    for (size_t y = tile->y0; y < tile->y1; ++y) {
        const size_t pixel = y * width + tile->x0;
        double *const mean = means[pixel];
        memset(mean, 0, across * sizeof *means);
        for (size_t r = 0; r < replicas->count; ++r) {
            const double *const values = read[r * TILE_PIXELS + (y - tile->y0) * across];
            memcpy(light[r * replicas->pixel_count + pixel], values, across * sizeof *light);
            for (size_t i = 0; i < 3 * across; ++i)
                mean[i] += values[i] / (double)replicas->count;
        }
    }
}

void aur_replicas_mean(const aur_replicas *replicas, double (*light)[3], double (*values)[3]) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    for (size_t row = layout->y0 / TILE; row * TILE < layout->y1; ++row)
        for (size_t column = layout->x0 / TILE; column * TILE < layout->x1; ++column) {
            const pixel_range tile = cell_of(layout, TILE, column, row);
            add_tile(replicas, &tile, layout->x1 - layout->x0, light, values);
        }
}

/* Each replica's variance of one sample of a pixel, by the deviations of the other replicas from their mean.
 * Their sum of squares is the one about the mean of all, without the replica's part, and has count - 2
 * degrees. */
static void find_variances(const aur_replicas *replicas, size_t pixel, const double *products,
                           double *variances) {
    const double others = (double)(replicas->count - 1);
    double shares[AUR_REPLICAS_MAX], all = 0.0, squares = 0.0; /* one over the replicas' samples */
    for (size_t r = 0; r < replicas->count; ++r) {
        const uint64_t samples = aur_render_film(replicas->renders[r])->counts[pixel];
        shares[r] = samples > 0 ? 1.0 / (double)samples : 1.0;
        all += shares[r];
        squares += products[AUR_GRAM_SQUARE(r)];
    }
    for (size_t r = 0; r < replicas->count; ++r)
        variances[r * replicas->pixel_count + pixel] =
            fmax(squares - products[AUR_GRAM_SQUARE(r)] * (others + 1.0) / others, 0.0) * others /
            ((others - 1.0) * (all - shares[r]));
}

static void find_products(size_t count, double d[3][AUR_REPLICAS_MAX], double *products) {
    for (size_t r = 0; r < count; ++r)
        for (size_t s = 0; s <= r; ++s)
            *products++ = d[0][r] * d[0][s] + d[1][r] * d[1][s] + d[2][r] * d[2][s];
}

/* The sums of a block, and what all its pixels have in common. */
typedef struct block_sums {
    const aur_replicas *replicas;
    const double (*light)[3];
    aur_weighing weighing;
    aur_replica_measure *measure;
    double *variances; /* of single pixels, or NULL */
    bool linear;       /* the measure is */
    double *products;
} block_sums;

/* Adds a pixel to the block, its cell and the measure, and sets its variances. */
static void measure_pixel(block_sums *block, size_t pixel, aur_cell *cell) {
    const aur_replicas *const replicas = block->replicas;
    const size_t count = replicas->count;
    double d[3][AUR_REPLICAS_MAX], single[3][AUR_REPLICAS_MAX], means[3];
    double products[AUR_GRAM_ENTRIES(AUR_REPLICAS_MAX)];
    find_deviations(count, replicas->pixel_count, block->light + pixel, means, d);
    for (size_t channel = 0; channel < 3; ++channel)
        block->measure->mean += means[channel];
    if (!block->linear)
        memcpy(single, d, sizeof d);
    aur_replicas_weigh(count, block->weighing, pixel, means, d);
    find_products(count, d, products);
    if (block->variances != NULL)
        find_variances(replicas, pixel, products, block->variances);
    double others = 0.0;
    for (size_t r = 0; r < count; ++r)
        others += products[AUR_GRAM_SQUARE(r)];
    if (!block->linear) {
        weigh_steps(count, block->weighing, pixel, 1.0, means, single);
        find_products(count, single, products);
    }
    aur_deviations_add_pixel(&block->measure->deviations, products, block->linear ? d : single, others, cell);
    for (size_t k = 0; k < AUR_GRAM_ENTRIES(count); ++k)
        block->products[k] += products[k];
}

/* Adds the pixels of a cell to its block and the measure. */
static void measure_cell(block_sums *block, const aur_film_layout *layout, size_t column, size_t row) {
    const pixel_range range = cell_of(layout, AUR_CELL_SIDE, column, row);
    aur_cell cell = {.count = block->replicas->count};
    for (size_t y = range.y0; y < range.y1; ++y)
        for (size_t x = range.x0; x < range.x1; ++x)
            measure_pixel(block, y * (layout->x1 - layout->x0) + x, &cell);
    aur_deviations_add_cell(&block->measure->deviations, &cell);
}

static void measure_block(block_sums *block, const aur_film_layout *layout, const pixel_range *range) {
    const size_t first = (range->x0 + layout->x0) / AUR_CELL_SIDE;
    for (size_t row = (range->y0 + layout->y0) / AUR_CELL_SIDE; row * AUR_CELL_SIDE < range->y1 + layout->y0;
         ++row)
        for (size_t column = first; column * AUR_CELL_SIDE < range->x1 + layout->x0; ++column)
            measure_cell(block, layout, column, row);
}

void aur_replicas_measure(const aur_replicas *replicas, const double (*light)[3], aur_weighing weighing,
                          aur_replica_measure *measure, double *variances) {
    const aur_film *const film = aur_render_film(replicas->renders[0]);
    const aur_film_layout *const layout = &film->layout;
    const bool linear = weighing.weights == NULL || weighing.measure != AUR_ERROR_MEASURE_DISPLAY;
    *measure = (aur_replica_measure){
        .deviations = {.overlap = film->spread != NULL ? aur_spread_overlap(film->spread) : 1.0}};
    const block_grid grid = grid_of(layout);
    const size_t blocks = grid.columns * grid.rows, entries = AUR_GRAM_ENTRIES(replicas->count);
    memset(replicas->products, 0, blocks * entries * sizeof *replicas->products);
    for (size_t i = 0; i < blocks; ++i) {
        block_sums block = {
            replicas, light, weighing, measure, variances, linear, replicas->products + i * entries};
        const pixel_range range =
            cell_of(layout, BLOCK, grid.first_column + i % grid.columns, grid.first_row + i / grid.columns);
        measure_block(&block, layout, &range);
    }
    aur_blocks_measure(replicas->count, grid.columns, grid.rows, replicas->products, replicas->blocks);
    aur_deviations_set_blocks(&measure->deviations, grid.columns, grid.rows, replicas->blocks);
    measure->mean /= 3.0 * (double)replicas->pixel_count;
}

/* Adds `part` of the mean of `values` over the pixels at most `reach` away to `sums`. */
static void add_means_about(size_t width, size_t height, const double *values, size_t reach, double part,
                            double *rows, double *sums) {
    for (size_t i = 0; i < width * height; ++i) {
        const size_t x = i % width, first = x > reach ? x - reach : 0;
        const size_t end = x + reach < width ? x + reach + 1 : width;
        double sum = 0.0;
        for (size_t k = first; k < end; ++k)
            sum += values[i - x + k];
        rows[i] = part * sum / (double)(end - first);
    }
    for (size_t y = 0; y < height; ++y) {
        const size_t first = y > reach ? y - reach : 0, end = y + reach < height ? y + reach + 1 : height;
        const double share = 1.0 / (double)(end - first);
        for (size_t j = first; j < end; ++j)
            for (size_t x = 0; x < width; ++x)
                sums[y * width + x] += share * rows[j * width + x];
    }
}

/* A sixteenth of the weight is spread over more pixels, so that no pixel is neglected because its first
 * samples and those of its neighbours agreed by chance. */
void aur_replicas_smooth(const aur_replicas *replicas, double *variances, double *scratch) {
    enum { NEAR = 1, FAR = 4 };
    const double far_part = 1.0 / 16;
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t pixels = replicas->pixel_count, width = layout->x1 - layout->x0;
    for (double *smoothed = variances; smoothed < variances + replicas->count * pixels; smoothed += pixels) {
        memcpy(scratch, smoothed, pixels * sizeof *scratch);
        memset(smoothed, 0, pixels * sizeof *smoothed);
        add_means_about(width, pixels / width, scratch, NEAR, 1.0 - far_part, scratch + pixels, smoothed);
        add_means_about(width, pixels / width, scratch, FAR, far_part, scratch + pixels, smoothed);
    }
}

void aur_replicas_average(const aur_replicas *replicas, size_t side, double *variances) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0, pixels = replicas->pixel_count;
    for (size_t row = layout->y0 / side; row * side < layout->y1; ++row)
        for (size_t column = layout->x0 / side; column * side < layout->x1; ++column) {
            const pixel_range cell = cell_of(layout, side, column, row);
            const size_t across = cell.x1 - cell.x0, count = across * (cell.y1 - cell.y0);
            for (size_t r = 0; r < replicas->count; ++r) {
                double *const averaged = variances + r * pixels + cell.y0 * width + cell.x0;
                double sum = 0.0;
                for (size_t k = 0; k < count; ++k)
                    sum += averaged[k / across * width + k % across];
                for (size_t k = 0; k < count; ++k)
                    averaged[k / across * width + k % across] = sum / (double)count;
            }
        }
}

size_t aur_replicas_block_of(const aur_replicas *replicas, size_t pixel) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const block_grid grid = grid_of(layout);
    const size_t width = layout->x1 - layout->x0;
    return ((layout->y0 + pixel / width) / BLOCK - grid.first_row) * grid.columns +
           (layout->x0 + pixel % width) / BLOCK - grid.first_column;
}

bool aur_replicas_clamp(const aur_replicas *replicas) {
    const aur_film *const film = replicas->count > 0 ? aur_render_film(replicas->renders[0]) : NULL;
    return film != NULL && film->layout.channel_count >= 6 &&
           strcmp(film->channels[3].name, AUR_CLAMPED_CHANNEL) == 0;
}

/* A pixel's means of some replicas in three channels, and their standard errors. */
static void develop_pixel(size_t count, size_t first, size_t step, const double (*values)[3],
                          float developed[6]) {
    const double part = (double)((count - first + step - 1) / step);
    double mean[3], d[3][AUR_REPLICAS_MAX];
    find_deviations(count, TILE_PIXELS, values, mean, d);
    for (size_t c = 0; c < 3; ++c) {
        double squares = 0.0, sum = 0.0;
        for (size_t r = 0; r < count; ++r)
            squares += d[c][r] * d[c][r];
        for (size_t r = first; r < count; r += step)
            sum += d[c][r];
        developed[c] = (float)(step == 1 ? mean[c] : mean[c] + sum / part);
        developed[3 + c] = (float)sqrt(squares / (part * (double)(count - 1)));
    }
}

/* Three channels from `channel` on, and `most` - 3 of their errors, of a tile. */
static void develop_tile(const aur_replicas *replicas, const pixel_range *tile, size_t first, size_t step,
                         size_t channel, size_t most, aur_image *image) {
    const size_t width = tile->x1 - tile->x0, count = width * (tile->y1 - tile->y0);
    const size_t channels = aur_image_channel_count(image);
    tile_values values;
    read_tile(replicas, tile, channel, values);
    for (size_t i = 0; i < count; ++i) {
        const size_t pixel = (tile->y0 + i / width) * aur_image_width(image) + tile->x0 + i % width;
        float developed[6];
        develop_pixel(replicas->count, first, step, (const double(*)[3])values + i, developed);
        memcpy(aur_image_data(image) + pixel * channels + (channel == 0 ? 0 : channels - most), developed,
               most * sizeof *developed);
    }
}

aur_result aur_replicas_develop(const aur_replicas *replicas, size_t first, size_t step, bool errors,
                                aur_image **image, aur_error *error) {
    static const char *const names[] = {"R", "G", "B", "error.R", "error.G", "error.B"},
                             *const taken[] = {AUR_CLAMPED_CHANNEL, "clamped.G", "clamped.B"};
    if (replicas->pixel_count == 0) /* while they are being created */
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "no image yet");
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t main_channels = errors ? 6 : 3,
                 channels = main_channels + (aur_replicas_clamp(replicas) ? 3 : 0);
    const aur_result result =
        aur_image_create(layout->x1 - layout->x0, layout->y1 - layout->y0, channels, image, error);
    if (result != AUR_OK)
        return result;
    for (size_t c = 0; c < channels; ++c)
        aur_image_name_channel(*image, c, c < main_channels ? names[c] : taken[c - main_channels], NULL);
    for (size_t r = 0; r < replicas->count; ++r)
        pthread_mutex_lock(aur_render_film(replicas->renders[r])->lock);
    for (size_t row = layout->y0 / TILE; row * TILE < layout->y1; ++row)
        for (size_t column = layout->x0 / TILE; column * TILE < layout->x1; ++column) {
            const pixel_range tile = cell_of(layout, TILE, column, row);
            develop_tile(replicas, &tile, first, step, 0, main_channels, *image);
            if (channels > main_channels)
                develop_tile(replicas, &tile, first, step, 3, channels - main_channels, *image);
        }
    for (size_t r = 0; r < replicas->count; ++r)
        pthread_mutex_unlock(aur_render_film(replicas->renders[r])->lock);
    return AUR_OK;
}
