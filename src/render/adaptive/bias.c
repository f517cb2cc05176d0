#include "render/adaptive/bias.h"

#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "render/adaptive/race.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

enum { PIXELS = AUR_RACE_BLOCK * AUR_RACE_BLOCK, FIRST_BLOCKS = 54 };

/* Sums over blocks. */
typedef struct bias_sums {
    double products, squares;          /* of a block's mean product, and its square */
    double replicas[AUR_REPLICAS_MAX]; /* of products of each replica with the others */
    size_t blocks;
} bias_sums;

/* The mean over a block's pixels of the differences in each replica: d[replica][channel]. Differences are
 * linear in small errors, and noise is not small: it is made so. */
static void differences_of(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], size_t count, const size_t *pixels,
                           double d[AUR_REPLICAS_MAX][3]) {
    const double step = 1e-3;
    for (size_t r = 0; r < replicas->count; ++r) {
        d[r][0] = d[r][1] = d[r][2] = 0.0;
        for (size_t p = 0; p < count; ++p) {
            double errors[3], differences[3];
            for (size_t c = 0; c < 3; ++c)
                errors[c] = step * aur_replicas_value(replicas, r, pixels[p], first + c);
            aur_error_apply(weighing.measure, &weighing.weights[pixels[p]], values[pixels[p]], errors,
                            differences);
            for (size_t c = 0; c < 3; ++c)
                d[r][c] += differences[c] / (step * (double)count);
        }
    }
}

static void add_block(size_t count, double d[AUR_REPLICAS_MAX][3], bias_sums *sums) {
    const double others = (double)(count - 1);
    double all[3] = {0.0}, products = 0.0;
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
    sums->products += products;
    sums->squares += products * products;
    ++sums->blocks;
}

static bool has_samples(const aur_replicas *replicas, size_t count, const size_t *pixels) {
    for (size_t r = 0; r < replicas->count; ++r)
        for (size_t p = 0; p < count; ++p)
            if (aur_render_film(replicas->renders[r])->given[pixels[p]] == 0)
                return false;
    return true;
}

static aur_bias finish(const bias_sums *sums, size_t replica_count, size_t all, double confidence) {
    const double blocks = (double)sums->blocks, count = (double)replica_count;
    const double probability = 0.5 * (1.0 + confidence), mean = sums->products / blocks;
    double spread = 0.0;
    for (size_t r = 0; r < replica_count; ++r)
        spread += pow(sums->replicas[r] / blocks - mean, 2.0);
    /* Leaving out replica r changes the mean to (count mean - 2 T_r) / (count - 2), of its products T_r. */
    const double change = 2.0 / (count - 2.0);
    const double jackknife = (count - 1.0) / count * change * change * spread;
    const double left_out = fmax(1.0 - blocks / (double)all, 0.0); /* of the image's blocks */
    const double of_blocks =
        sums->blocks > 1 ? fmax(sums->squares / blocks - mean * mean, 0.0) / (blocks - 1.0) * left_out : 0.0;
    aur_bias bias = {.estimate = mean / 3.0};
    bias.of_replicas = aur_student_quantile(replica_count - 1, probability) * sqrt(jackknife) / 3.0;
    if (sums->blocks > 1)
        bias.of_blocks = aur_student_quantile(sums->blocks - 1, probability) * sqrt(of_blocks) / 3.0;
    const double half = fmax(bias.of_replicas, bias.of_blocks);
    bias.low = fmax(bias.estimate - half, 0.0);
    bias.high = fmax(bias.estimate, 0.0) + half;
    return bias;
}

aur_bias aur_replicas_bias(const aur_replicas *replicas, size_t first, aur_weighing weighing,
                           const double (*values)[3], double confidence) {
    const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    const size_t all =
        (width + AUR_RACE_BLOCK - 1) / AUR_RACE_BLOCK * ((height + AUR_RACE_BLOCK - 1) / AUR_RACE_BLOCK);
    bias_sums sums = {.blocks = 0};
    for (size_t block = 0; block < all && layout->channel_count >= first + 3; ++block) {
        size_t pixels[PIXELS];
        double d[AUR_REPLICAS_MAX][3];
        const size_t count = aur_race_pixels(width, height, block, pixels);
        if (!has_samples(replicas, count, pixels))
            continue;
        differences_of(replicas, first, weighing, values, count, pixels, d);
        add_block(replicas->count, d, &sums);
    }
    return sums.blocks > 0 ? finish(&sums, replicas->count, all, confidence) : (aur_bias){.estimate = 0.0};
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
    aur_render_options own = *options;
    own.integrator = integrator;
    own.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    own.warnings = (aur_warnings){0};
    aur_result result = aur_replicas_create(renderer, &own, replica_count, &corrections->replicas, error);
    if (result != AUR_OK)
        return result;
    const aur_film_layout *const layout = &aur_render_film(corrections->replicas.renders[0])->layout;
    corrections->width = layout->x1 - layout->x0;
    corrections->height = layout->y1 - layout->y0;
    corrections->all = corrections->replicas.pixel_count;
    corrections->all =
        aur_race_blocks(corrections->width, corrections->height, corrections->all, &corrections->order);
    corrections->targets = calloc(corrections->replicas.pixel_count, sizeof *corrections->targets);
    const uint32_t pattern = aur_render_integrator(corrections->replicas.renders[0])->samples_a_pattern;
    corrections->pattern = pattern > 0 ? pattern : 1;
    return corrections->all > 0 && corrections->targets != NULL ? AUR_OK : aur_fail_memory(error);
}

void aur_corrections_release(aur_corrections *corrections) {
    aur_replicas_release(&corrections->replicas);
    free(corrections->order);
    free(corrections->targets);
    *corrections = (aur_corrections){.blocks = 0};
}

aur_result aur_corrections_grow(aur_corrections *corrections, bool more_samples, const atomic_bool *cancelled,
                                aur_error *error) {
    const bool first = corrections->steps == 0;
    size_t blocks = first ? FIRST_BLOCKS : corrections->blocks * (more_samples ? 1 : 2);
    const uint32_t samples = first ? corrections->pattern : corrections->samples * (more_samples ? 2 : 1);
    blocks = blocks < corrections->all ? blocks : corrections->all;
    for (size_t b = 0; b < blocks; ++b) {
        size_t pixels[PIXELS];
        const size_t count =
            aur_race_pixels(corrections->width, corrections->height, corrections->order[b], pixels);
        for (size_t p = 0; p < count; ++p)
            corrections->targets[pixels[p]] = samples;
    }
    aur_result result = AUR_OK;
    for (size_t r = 0; r < corrections->replicas.count && result == AUR_OK; ++r)
        result = atomic_load(cancelled)
                     ? AUR_ERROR_CANCELLED
                     : aur_render_step_pixels(corrections->replicas.renders[r],
                                              corrections->replicas.pixel_count, corrections->targets, error);
    if (result == AUR_OK) {
        corrections->blocks = blocks;
        corrections->samples = samples;
        corrections->steps = first ? 1 : 2 * corrections->steps + more_samples;
    }
    return result;
}

aur_result aur_corrections_repeat(aur_corrections *corrections, uint64_t steps, const atomic_bool *cancelled,
                                  aur_error *error) {
    int last = 0;
    while (steps >> last > 1)
        ++last;
    aur_result result = AUR_OK;
    for (int bit = last; bit >= 0 && result == AUR_OK; --bit)
        result = aur_corrections_grow(corrections, (steps >> bit & 1) != 0, cancelled, error);
    return result;
}

double aur_corrections_rays(const aur_corrections *corrections) {
    uint64_t rays = 0;
    for (size_t r = 0; r < corrections->replicas.count; ++r)
        rays += aur_film_counted(aur_render_film(corrections->replicas.renders[r])).rays;
    return (double)rays;
}
