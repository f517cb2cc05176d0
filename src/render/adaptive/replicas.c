#include "render/adaptive/replicas.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "render/film/film.h"

aur_result aur_replicas_create(aur_renderer *renderer, const aur_render_options *options, size_t count,
                               aur_replicas *replicas, aur_error *error) {
    *replicas = (aur_replicas){0};
    for (size_t r = 0; r < count; ++r) {
        aur_render_options own = *options;
        own.seed = aur_hash3(UINT64_C(0x7265706c696361), options->seed, r);
        if (r > 0) /* the first has said it */
            own.warnings = (aur_warnings){0};
        const aur_result result = aur_render_create(renderer, &own, &replicas->renders[r], error);
        if (result != AUR_OK)
            return result;
        replicas->count = r + 1;
    }
    const aur_film *const film = aur_render_film(replicas->renders[0]);
    replicas->pixel_count = aur_film_pixel_count(film);
    return AUR_OK;
}

void aur_replicas_release(aur_replicas *replicas) {
    for (size_t r = 0; r < replicas->count; ++r)
        aur_render_destroy(replicas->renders[r]);
}

double aur_replicas_value(const aur_replicas *replicas, size_t r, size_t pixel, size_t channel) {
    return aur_film_mean(aur_render_film(replicas->renders[r]), pixel, channel);
}

/* The deviations of the replicas' values of channel R, G or B of a pixel from their mean, which is returned.
 */
static double deviations_at(const aur_replicas *replicas, size_t pixel, size_t channel, double *deviations) {
    double mean = 0.0;
    for (size_t r = 0; r < replicas->count; ++r) {
        deviations[r] = aur_replicas_value(replicas, r, pixel, channel);
        mean += deviations[r] / (double)replicas->count;
    }
    for (size_t r = 0; r < replicas->count; ++r)
        deviations[r] -= mean;
    return mean;
}

void aur_replicas_mean(const aur_replicas *replicas, double (*values)[3]) {
    double deviations[AUR_REPLICAS_MAX];
    for (size_t i = 0; i < replicas->pixel_count; ++i)
        for (size_t c = 0; c < 3; ++c)
            values[i][c] = deviations_at(replicas, i, c, deviations);
}

/* The replicas' deviations d[channel][replica] from `mean` become those of a pixel's differences. Where these
 * are not linear, they are the differences to the means of the other replicas (jackknife, Efron and Stein
 * 1981), scaled back: longer steps overestimate the error of skewed values. */
void aur_replicas_weigh(size_t count, aur_weighing weighing, size_t pixel, const double mean[3],
                        double d[3][AUR_REPLICAS_MAX]) {
    const double part = 1.0 / (double)(count - 1);
    double sums[3] = {0.0};
    if (weighing.weights == NULL)
        return;
    for (size_t r = 0; r < count; ++r) {
        double differences[3];
        const double step[3] = {-part * d[0][r], -part * d[1][r], -part * d[2][r]};
        aur_error_apply(weighing.measure, &weighing.weights[pixel], mean, step, differences);
        for (size_t c = 0; c < 3; ++c) {
            d[c][r] = -differences[c] / part;
            sums[c] += d[c][r];
        }
    }
    for (size_t r = 0; r < count; ++r)
        for (size_t c = 0; c < 3; ++c)
            d[c][r] -= sums[c] / (double)count;
}

/* Correlation between pixels is seen within blocks of so many pixels a side. */
enum { BLOCK = 8 };

/* The pixels of a film that lie in a cell of a grid over the whole image. */
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

/* One over the samples that each replica has of a pixel, and their sum. */
typedef struct sample_shares {
    double share[AUR_REPLICAS_MAX], sum;
} sample_shares;

static sample_shares shares_at(const aur_replicas *replicas, size_t pixel) {
    sample_shares shares = {.sum = 0.0};
    for (size_t r = 0; r < replicas->count; ++r) {
        const uint64_t samples = aur_render_film(replicas->renders[r])->counts[pixel];
        shares.share[r] = samples > 0 ? 1.0 / (double)samples : 1.0;
        shares.sum += shares.share[r];
    }
    return shares;
}

/* Adds to each replica's variance of one sample of a pixel what a channel's deviations of the others from
 * their own mean say: their sum of squares is that about the mean of all without the replica's part, and has
 * count - 2 degrees. */
static void add_variances(const aur_replicas *replicas, size_t pixel, const sample_shares *shares,
                          const double *deviations, double *variances) {
    const double others = (double)(replicas->count - 1);
    double squares = 0.0;
    for (size_t r = 0; r < replicas->count; ++r)
        squares += deviations[r] * deviations[r];
    for (size_t r = 0; r < replicas->count; ++r) {
        const double own = deviations[r] * deviations[r] * (others + 1.0) / others;
        variances[r * replicas->pixel_count + pixel] +=
            fmax(squares - own, 0.0) * others / ((others - 1.0) * (shares->sum - shares->share[r]));
    }
}

/* The covariances of R, G and B in a pixel times count - 1: of RR, GG, BB, RG, RB, GB. */
typedef struct colour_covariance {
    double entries[6];
} colour_covariance;

static void add_colour(size_t count, double d[3][AUR_REPLICAS_MAX], colour_covariance *covariance) {
    static const size_t of[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (size_t e = 0; e < 6; ++e) {
        covariance->entries[e] = 0.0;
        for (size_t r = 0; r < count; ++r)
            covariance->entries[e] += d[of[e][0]][r] * d[of[e][1]][r];
    }
}

/* The trace of the product of two covariances. */
static double product_of(const colour_covariance *a, const colour_covariance *b) {
    double sum = 0.0;
    for (size_t e = 0; e < 6; ++e)
        sum += (e < 3 ? 1.0 : 2.0) * a->entries[e] * b->entries[e];
    return sum;
}

/* tr C^2 of a block's pixels as their neighbours tell it: C_i and C_j are seen independently, so the
 * product's expectation is tr C_i C_j, which in the mean is at most that of the squares. */
static double alike_in(size_t count, pixel_range block, const colour_covariance *covariances) {
    const size_t width = block.x1 - block.x0, height = block.y1 - block.y0;
    const double degrees = (double)(count - 1);
    double sum = 0.0;
    for (size_t i = 0; i < width * height; ++i) {
        if (i % width + 1 < width)
            sum += product_of(&covariances[i], &covariances[i + 1]);
        if (i / width + 1 < height)
            sum += product_of(&covariances[i], &covariances[i + width]);
    }
    const size_t pairs = (width - 1) * height + width * (height - 1);
    return pairs > 0 ? sum * (double)(width * height) / ((double)pairs * degrees * degrees) : 0.0;
}

static aur_gram gram_of(size_t count, double d[3][AUR_REPLICAS_MAX]) {
    aur_gram gram = {.count = count};
    for (size_t r = 0; r < count; ++r)
        for (size_t s = 0; s < count; ++s)
            for (size_t channel = 0; channel < 3; ++channel)
                gram.products[r][s] += d[channel][r] * d[channel][s];
    return gram;
}

/* Adds a block's values to the mean and its pixels' variances, and returns its Gram matrix. */
static aur_gram measure_block(const aur_replicas *replicas, aur_weighing weighing, pixel_range block,
                              double *mean, const aur_pixel_measure *pixels) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    aur_gram gram = {.count = replicas->count};
    colour_covariance covariances[BLOCK * BLOCK];
    size_t seen = 0;
    for (size_t y = block.y0; y < block.y1; ++y)
        for (size_t x = block.x0; x < block.x1; ++x) {
            const size_t pixel = y * (layout->x1 - layout->x0) + x;
            const sample_shares shares = shares_at(replicas, pixel);
            double d[3][AUR_REPLICAS_MAX], means[3];
            for (size_t channel = 0; channel < 3; ++channel) {
                means[channel] = deviations_at(replicas, pixel, channel, d[channel]);
                *mean += means[channel];
            }
            aur_replicas_weigh(replicas->count, weighing, pixel, means, d);
            const aur_gram own = gram_of(replicas->count, d);
            for (size_t channel = 0; channel < 3 && pixels != NULL; ++channel)
                add_variances(replicas, pixel, &shares, d[channel], pixels->variances);
            if (pixels != NULL)
                pixels->spreads[pixel] = aur_gram_spread(&own);
            for (size_t r = 0; r < replicas->count; ++r)
                for (size_t s = 0; s < replicas->count; ++s)
                    gram.products[r][s] += own.products[r][s];
            add_colour(replicas->count, d, &covariances[seen++]);
        }
    gram.alike = alike_in(replicas->count, block, covariances);
    return gram;
}

void aur_replicas_measure(const aur_replicas *replicas, aur_weighing weighing, aur_replica_measure *measure,
                          const aur_pixel_measure *pixels) {
    const aur_film *const film = aur_render_film(replicas->renders[0]);
    const aur_film_layout *const layout = &film->layout;
    *measure = (aur_replica_measure){0};
    for (size_t i = 0; i < replicas->count * replicas->pixel_count && pixels != NULL; ++i)
        pixels->variances[i] = 0.0;
    for (size_t row = layout->y0 / BLOCK; row * BLOCK < layout->y1; ++row)
        for (size_t column = layout->x0 / BLOCK; column * BLOCK < layout->x1; ++column) {
            const aur_gram gram = measure_block(replicas, weighing, cell_of(layout, BLOCK, column, row),
                                                &measure->mean, pixels);
            aur_deviations_add(&measure->deviations, &gram);
        }
    measure->mean /= 3.0 * (double)replicas->pixel_count;
}

/* Along one axis, from `at` on: the places at most `reach` away. */
typedef struct span {
    size_t first, end;
} span;

static span span_about(size_t at, size_t reach, size_t side) {
    return (span){.first = at > reach ? at - reach : 0, .end = at + reach < side ? at + reach + 1 : side};
}

/* Adds to `own` `part` of the mean of `values` over the pixels at most `reach` away. */
static void add_means_about(const aur_film_layout *layout, const double *values, size_t reach, double part,
                            double *rows, double *own) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            const span across = span_about(x, reach, width);
            double sum = 0.0;
            for (size_t i = across.first; i < across.end; ++i)
                sum += values[y * width + i];
            rows[y * width + x] = part * sum / (double)(across.end - across.first);
        }
    for (size_t y = 0; y < height; ++y) {
        const span down = span_about(y, reach, height);
        const double share = 1.0 / (double)(down.end - down.first);
        for (size_t j = down.first; j < down.end; ++j)
            for (size_t x = 0; x < width; ++x)
                own[y * width + x] += share * rows[j * width + x];
    }
}

/* A sixteenth of the weight lies on more pixels, so that none is left alone because its first samples and
 * those of its neighbours agreed by chance. */
void aur_replicas_smooth(const aur_replicas *replicas, const uint32_t *samples, double *variances,
                         double *scratch) {
    enum { NEAR = 1, FAR = 4 };
    const double far_part = 1.0 / 16;
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t pixels = replicas->pixel_count;
    for (size_t r = 0; r < replicas->count; ++r) {
        double *const own = variances + r * pixels;
        memcpy(scratch, own, pixels * sizeof *scratch);
        memset(own, 0, pixels * sizeof *own);
        add_means_about(layout, scratch, NEAR, 1.0 - far_part, scratch + pixels, own);
        add_means_about(layout, scratch, FAR, far_part, scratch + pixels, own);
        for (size_t i = 0; i < pixels; ++i)
            own[i] /= samples[r * pixels + i];
    }
}

void aur_replicas_average(const aur_replicas *replicas, size_t side, const uint32_t *samples,
                          double *variances) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0, pixels = replicas->pixel_count;
    for (size_t row = layout->y0 / side; row * side < layout->y1; ++row)
        for (size_t column = layout->x0 / side; column * side < layout->x1; ++column) {
            const pixel_range cell = cell_of(layout, side, column, row);
            const size_t across = cell.x1 - cell.x0, count = across * (cell.y1 - cell.y0);
            for (size_t r = 0; r < replicas->count; ++r) {
                double *const own = variances + r * pixels + cell.y0 * width + cell.x0;
                double sum = 0.0;
                for (size_t k = 0; k < count; ++k)
                    sum += own[k / across * width + k % across];
                for (size_t k = 0; k < count; ++k) {
                    const size_t at = k / across * width + k % across;
                    const double share = samples != NULL ? samples[(size_t)(own - variances) + at] : 1.0;
                    own[at] = sum / (double)count / share;
                }
            }
        }
}

aur_result aur_replicas_develop(const aur_replicas *replicas, bool errors, aur_image **image,
                                aur_error *error) {
    static const char *const names[] = {"R", "G", "B", "error.R", "error.G", "error.B"};
    if (replicas->pixel_count == 0) /* they are being made */
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "there is no image yet");
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t channels = errors ? 6 : 3;
    const aur_result result =
        aur_image_create(layout->x1 - layout->x0, layout->y1 - layout->y0, channels, image, error);
    if (result != AUR_OK)
        return result;
    float *const data = aur_image_data(*image);
    for (size_t c = 0; c < channels; ++c)
        aur_image_name_channel(*image, c, names[c], NULL);
    for (size_t r = 0; r < replicas->count; ++r)
        pthread_mutex_lock(aur_render_film(replicas->renders[r])->lock);
    for (size_t pixel = 0; pixel < replicas->pixel_count; ++pixel)
        for (size_t c = 0; c < 3; ++c) {
            double d[AUR_REPLICAS_MAX], squares = 0.0;
            data[pixel * channels + c] = (float)deviations_at(replicas, pixel, c, d);
            for (size_t r = 0; r < replicas->count; ++r)
                squares += d[r] * d[r];
            if (errors)
                data[pixel * channels + 3 + c] =
                    (float)sqrt(squares / ((double)replicas->count * (double)(replicas->count - 1)));
        }
    for (size_t r = 0; r < replicas->count; ++r)
        pthread_mutex_unlock(aur_render_film(replicas->renders[r])->lock);
    return AUR_OK;
}
