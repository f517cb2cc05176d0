#include "render/replicas/bias.h"

#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/film/integrator.h"

enum { FIRST_BLOCKS = 54 };

/* Over blocks. */
typedef struct bias_sums {
    aur_moments products; /* of the blocks' mean products of two replicas */
    double noise; /* sum of the blocks' variances of these means, by the spread of the replicas alone */
} bias_sums;

/* Adds the mean over a block's pixels of the differences in each replica to d[replica][channel]. Differences
 * are linear only in small errors, and noise is not small: they are linearised. */
static void add_differences(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                            const double (*values)[3], size_t count, const size_t *pixels,
                            double d[AUR_REPLICAS_MAX][3]) {
    const double step = 1e-3;
    double light[AUR_REPLICAS_MAX * AUR_BLOCK_PIXELS][3];
    aur_replicas_read(replicas, (const size_t[2]){pixels[0], pixels[count - 1]}, first, count, light);
    for (size_t p = 0; p < count; ++p) {
        double errors[AUR_REPLICAS_MAX][3], differences[AUR_REPLICAS_MAX][3];
        for (size_t r = 0; r < replicas->count; ++r)
            for (size_t c = 0; c < 3; ++c)
                errors[r][c] = step * light[r * count + p][c];
        aur_error_apply(weighing.measure, &weighing.weights[pixels[p]], values[pixels[p]], replicas->count,
                        (const double(*)[3])errors, differences);
        for (size_t r = 0; r < replicas->count; ++r)
            for (size_t c = 0; c < 3; ++c)
                d[r][c] += differences[r][c] / (step * (double)count);
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Noise of covariance C in each of n replicas gives the mean of their n (n - 1) / 2 products a variance of
 * tr C^2 by one of them. Differences a, b of two pairs of replicas are independent and have twice the
 * covariance, so the mean of (a b)^2 is 4 tr C^2, for any noise. */
static void add_block(size_t n, double d[AUR_REPLICAS_MAX][3], bias_sums *sums) {
    const double pairs = (double)(n * (n - 1)) / 2.0;
    double products = 0.0, traces = 0.0;
    for (size_t r = 0; r < n; ++r) {
        double a[3], b[3];
        for (size_t c = 0; c < 3; ++c) {
            a[c] = d[r][c] - d[(r + 1) % n][c];
            b[c] = d[(r + 2) % n][c] - d[(r + 3) % n][c];
        }
        traces += dot(a, b) * dot(a, b) / (4.0 * (double)n);
        for (size_t s = 0; s < r; ++s)
            products += dot(d[r], d[s]) / pairs;
    }
    aur_moments_add(&sums->products, products);
    sums->noise += traces / pairs;
}

static bool has_samples(const aur_replicas *replicas, size_t count, const size_t *pixels) {
    for (size_t r = 0; r < replicas->count; ++r)
        for (size_t p = 0; p < count; ++p)
            if (aur_render_film(replicas->renders[r])->given[pixels[p]] == 0)
                return false;
    return true;
}

static aur_bias finish(const bias_sums *sums, double confidence) {
    const double blocks = (double)sums->products.count;
    const size_t degrees = sums->products.count > 1 ? sums->products.count - 1 : 1;
    const double width = aur_student_quantile(degrees, 0.5 * (1.0 + confidence));
    aur_bias bias = {.estimate = sums->products.mean / 3.0,
                     .of_noise = width * sqrt(sums->noise) / blocks / 3.0,
                     .half = width * aur_moments_standard_error(&sums->products) / 3.0};
    bias.half = fmax(bias.half, bias.of_noise);
    bias.low = fmax(bias.estimate - bias.half, 0.0);
    bias.high = fmax(bias.estimate, 0.0) + bias.half;
    return bias;
}

aur_bias aur_replicas_bias(const aur_replicas *corrections, const aur_replicas *shared, aur_weighing weighing,
                           const double (*values)[3], double confidence) {
    const aur_film_layout *const layout = &aur_render_film(corrections->renders[0])->layout;
    const size_t side = AUR_BLOCK_SIDE, width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    const aur_blocks blocks = {width, height, ((width + side - 1) / side) * ((height + side - 1) / side),
                               NULL};
    bias_sums sums = {.noise = 0.0};
    for (size_t block = 0; block < blocks.count; ++block) {
        size_t pixels[AUR_BLOCK_PIXELS];
        double d[AUR_REPLICAS_MAX][3] = {{0.0}};
        const size_t count = aur_blocks_pixels(&blocks, block, pixels);
        if (!has_samples(corrections, count, pixels))
            continue;
        add_differences(corrections, 0, weighing, values, count, pixels, d);
        if (shared != NULL)
            add_differences(shared, 3, weighing, values, count, pixels, d);
        add_block(corrections->count, d, &sums);
    }
    return sums.products.count > 0 ? finish(&sums, confidence) : (aur_bias){.estimate = 0.0};
}

double aur_bias_with_noise(const aur_bias *bias, double noise, double noise_high) {
    const double square = noise * noise, half = noise_high * noise_high - square;
    return sqrt(square + bias->high - bias->half + sqrt(half * half + bias->half * bias->half));
}

aur_result aur_corrections_create(aur_renderer *renderer, const aur_render_options *options,
                                  const char *integrator, size_t replica_count, aur_corrections *corrections,
                                  aur_error *error) {
    aur_render_options local = *options;
    local.warnings = (aur_warnings){0};
    aur_result result =
        aur_replicas_create(renderer, &local, integrator, replica_count, &corrections->replicas, error);
    if (result != AUR_OK)
        return result;
    const aur_film_layout *const layout = &aur_render_film(corrections->replicas.renders[0])->layout;
    const uint32_t pattern = aur_render_integrator(corrections->replicas.renders[0])->samples_a_pattern;
    corrections->samples = pattern > 0 ? pattern : 1;
    corrections->targets = calloc(corrections->replicas.pixel_count, sizeof *corrections->targets);
    result = aur_blocks_create(layout->x1 - layout->x0, layout->y1 - layout->y0, &corrections->blocks, error);
    return corrections->targets == NULL ? aur_fail_memory(error) : result;
}

void aur_corrections_release(aur_corrections *corrections) {
    aur_replicas_release(&corrections->replicas);
    aur_blocks_release(&corrections->blocks);
    free(corrections->targets);
    *corrections = (aur_corrections){.steps = 0};
}

/* Half as many again, in whole units. */
static size_t next_count(size_t count, size_t unit) {
    return count + (count / unit + 1) / 2 * unit;
}

aur_result aur_corrections_grow(aur_corrections *corrections, bool more_samples, const atomic_bool *cancelled,
                                aur_error *error) {
    const bool first = corrections->steps == 0;
    const size_t all = corrections->blocks.count, rendered = corrections->rendered;
    const size_t target = first ? FIRST_BLOCKS : more_samples ? rendered : next_count(rendered, 1);
    const size_t blocks = target < all ? target : all;
    const uint32_t pattern = aur_render_integrator(corrections->replicas.renders[0])->samples_a_pattern;
    const uint32_t samples = first || !more_samples
                                 ? corrections->samples
                                 : (uint32_t)next_count(corrections->samples, pattern > 0 ? pattern : 1);
    for (size_t b = 0; b < blocks; ++b) {
        size_t pixels[AUR_BLOCK_PIXELS];
        const size_t count = aur_blocks_pixels(&corrections->blocks, corrections->blocks.order[b], pixels);
        for (size_t p = 0; p < count; ++p)
            corrections->targets[pixels[p]] = samples;
    }
    size_t done;
    const aur_result result =
        aur_replicas_step(&corrections->replicas, corrections->targets, 0, &done, cancelled, error);
    if (result == AUR_OK) {
        corrections->rendered = blocks;
        corrections->samples = samples;
        corrections->steps = first ? 1 : 2 * corrections->steps + more_samples;
    }
    return result;
}

aur_result aur_corrections_repeat(aur_corrections *corrections, uint64_t steps, const atomic_bool *cancelled,
                                  aur_error *error) {
    const aur_result result =
        steps > 1 ? aur_corrections_repeat(corrections, steps >> 1, cancelled, error) : AUR_OK;
    return result == AUR_OK ? aur_corrections_grow(corrections, (steps & 1) != 0, cancelled, error) : result;
}
