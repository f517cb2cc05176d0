#include "render/adaptive/bias.h"

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
    aur_moments products;              /* moments of the blocks' mean products */
    aur_moments squares;               /* and of the squares of the replicas' mean */
    double replicas[AUR_REPLICAS_MAX]; /* sums of products of each replica with the others */
} bias_sums;

/* The mean over a block's pixels of the differences in each replica: d[replica][channel]. Differences are
 * linear only in small errors, and noise is not small: they are linearised. */
static void differences_of(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], size_t count, const size_t *pixels,
                           double d[AUR_REPLICAS_MAX][3]) {
    const double step = 1e-3;
    double light[AUR_REPLICAS_MAX * AUR_BLOCK_PIXELS][3];
    aur_replicas_read(replicas, (const size_t[2]){pixels[0], pixels[count - 1]}, first, count, light);
    memset(d, 0, replicas->count * sizeof *d);
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

static void add_block(size_t count, double d[AUR_REPLICAS_MAX][3], bias_sums *sums) {
    const double others = (double)(count - 1);
    double all[3] = {0.0}, products = 0.0, square = 0.0;
    for (size_t r = 0; r < count; ++r)
        for (size_t c = 0; c < 3; ++c)
            all[c] += d[r][c];
    for (size_t r = 0; r < count; ++r) {
        double product = 0.0;
        for (size_t c = 0; c < 3; ++c)
            product += d[r][c] * (all[c] - d[r][c]) / others;
        sums->replicas[r] += product;
        products += product / (double)count;
    }
    for (size_t c = 0; c < 3; ++c)
        square += all[c] * all[c] / (double)(count * count);
    aur_moments_add(&sums->products, products);
    aur_moments_add(&sums->squares, square);
}

static bool has_samples(const aur_replicas *replicas, size_t count, const size_t *pixels) {
    for (size_t r = 0; r < replicas->count; ++r)
        for (size_t p = 0; p < count; ++p)
            if (aur_render_film(replicas->renders[r])->given[pixels[p]] == 0)
                return false;
    return true;
}

static aur_bias finish(const bias_sums *sums, size_t replica_count, size_t all, double confidence) {
    const double blocks = (double)sums->products.count, count = (double)replica_count;
    aur_moments replicas = {0};
    for (size_t r = 0; r < replica_count; ++r)
        aur_moments_add(&replicas, sums->replicas[r] / blocks);
    const double left_out = fmax(1.0 - blocks / (double)all, 0.0); /* of the image's blocks */
    /* Leaving out replica r changes the mean to (count mean - 2 T_r) / (count - 2), of its products T_r. */
    const double change = 2.0 / (count - 2.0);
    aur_bias bias = {.estimate = sums->products.mean / 3.0,
                     .of_replicas =
                         (count - 1.0) * change * aur_moments_interval(&replicas, confidence) / 3.0,
                     .of_blocks = sqrt(left_out) * aur_moments_interval(&sums->products, confidence) / 3.0};
    const double half = fmax(bias.of_replicas, bias.of_blocks);
    bias.low = fmax(bias.estimate - half, 0.0);
    bias.high = fmax(bias.estimate, 0.0) + half;
    const double square = sums->squares.mean / 3.0;
    const double of_squares = aur_moments_interval(&sums->squares, confidence) / 3.0;
    if (square + of_squares < bias.high) {
        bias.high = square + of_squares;
        bias.of_replicas = square - fmax(bias.estimate, 0.0);
        bias.of_blocks = of_squares;
    }
    return bias;
}

aur_bias aur_replicas_bias(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], double confidence) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t side = AUR_BLOCK_SIDE, width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    const aur_blocks blocks = {width, height, ((width + side - 1) / side) * ((height + side - 1) / side),
                               NULL};
    bias_sums sums = {.products = {0}};
    for (size_t block = 0; block < blocks.count && layout->channel_count >= first + 3; ++block) {
        size_t pixels[AUR_BLOCK_PIXELS];
        double d[AUR_REPLICAS_MAX][3];
        const size_t count = aur_blocks_pixels(&blocks, block, pixels);
        if (!has_samples(replicas, count, pixels))
            continue;
        differences_of(replicas, first, weighing, values, count, pixels, d);
        add_block(replicas->count, d, &sums);
    }
    return sums.products.count > 0 ? finish(&sums, replicas->count, blocks.count, confidence)
                                   : (aur_bias){.estimate = 0.0};
}

aur_bias aur_bias_of_both(aur_bias a, aur_bias b) {
    const double least = fmax(sqrt(a.low) - sqrt(b.high), sqrt(b.low) - sqrt(a.high));
    const double most = sqrt(a.high) + sqrt(b.high);
    return (aur_bias){.estimate = a.estimate + b.estimate,
                      .low = least > 0.0 ? least * least : 0.0,
                      .high = most * most,
                      .of_blocks = a.of_blocks,
                      .of_replicas = a.of_replicas};
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

aur_result aur_corrections_grow(aur_corrections *corrections, bool more_samples, const atomic_bool *cancelled,
                                aur_error *error) {
    const bool first = corrections->steps == 0;
    const size_t all = corrections->blocks.count;
    const size_t target = first ? FIRST_BLOCKS : corrections->rendered * (more_samples ? 1 : 2);
    const size_t blocks = target < all ? target : all;
    const uint32_t samples = corrections->samples * (!first && more_samples ? 2 : 1);
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
