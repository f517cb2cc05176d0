/* Renders fixed patterns of several sizes with the same photon map and primary hits, fits a line to the
 * logarithms of rays and error, and compares the number of rays at the error of the adaptive image. Each seed
 * of the patterns gives one comparison. */
#include "gather_adaptive.h"
#include "program/lab/gather.h"

#include <aureole-render/render.h>
#include <aureole/statistics.h>
#include <math.h>
#include <stdio.h>

enum {
    SIDE = 96,
    QUICK_SIDE = 16,
    SEEDS = 8,
    QUICK_SEEDS = 2,
    FIXED_COUNT = 5,
    REFERENCE_DIRECTIONS = 6144,
    QUICK_REFERENCE = 256,
    REFERENCE_SEED = 1000
};

typedef struct adaptive_context {
    aur_renderer *renderer;
    aur_render_options options;
    size_t side, seeds, reference_directions;
    aur_image *reference;
    aur_error error;
} adaptive_context;

typedef struct outcome {
    double rays;  /* pixels that gathered */
    double error; /* RMSE */
} outcome;

static bool render(adaptive_context *context, const char *keys, size_t seed, aur_image **image,
                   double *rays) {
    char integrator[256];
    aur_render_statistics statistics = {.size = sizeof statistics};
    snprintf(integrator, sizeof integrator,
             "finalgather-lab:direct=none,edges=0,pixel=centre,photons=%d,pattern_seed=%zu,%s",
             context->side == SIDE ? 200000 : 20000, seed, keys);
    context->options.integrator = integrator;
    if (aur_renderer_render(context->renderer, &context->options, image, &statistics, &context->error) !=
        AUR_OK)
        return bench_fail("%s: %s", integrator, context->error.message);
    *rays = (double)statistics.rays - (double)(context->side * context->side);
    return true;
}

static bool measure(adaptive_context *context, const char *keys, size_t seed, outcome *found) {
    aur_image *image = NULL;
    if (!render(context, keys, seed, &image, &found->rays))
        return false;
    const float *const values = aur_image_data(image);
    const float *const reference = aur_image_data(context->reference);
    double sum = 0.0;
    for (size_t pixel = 0; pixel < context->side * context->side; ++pixel)
        for (size_t c = 0; c < 3; ++c) {
            const double difference =
                (double)values[pixel * aur_image_channel_count(image) + c] -
                (double)reference[pixel * aur_image_channel_count(context->reference) + c];
            sum += difference * difference;
        }
    found->error = sqrt(sum / (double)(3 * context->side * context->side));
    aur_image_destroy(image);
    return true;
}

/* Fits log rays = a + b log error by least squares. */
typedef struct line {
    double a, b;
} line;

static bool fit_fixed(adaptive_context *context, size_t seed, line *fitted) {
    double x[FIXED_COUNT], y[FIXED_COUNT], mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (size_t i = 0; i < FIXED_COUNT; ++i) {
        char keys[80];
        outcome found;
        /* 80 + 40 to 320 + 160 rays: the range of the adaptive images' errors. */
        const size_t glossy = (size_t)(40.0 * pow(4.0, (double)i / (FIXED_COUNT - 1)) + 0.5);
        snprintf(keys, sizeof keys, "diffuse_samples=%zu,glossy_samples=%zu", 2 * glossy, glossy);
        if (!measure(context, keys, seed, &found))
            return false;
        x[i] = log(found.error);
        y[i] = log(found.rays);
        mean_x += x[i] / FIXED_COUNT;
        mean_y += y[i] / FIXED_COUNT;
    }
    for (size_t i = 0; i < FIXED_COUNT; ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    fitted->b = xy / xx;
    fitted->a = mean_y - fitted->b * mean_x;
    return true;
}

static bool compare(adaptive_context *context, const char *name, const char *keys, double target,
                    const line *fixed, bench_figures *figures) {
    char all[160];
    snprintf(all, sizeof all, "adaptive=true,%s", keys);
    aur_moments ratios = {0};
    for (size_t k = 0; k < context->seeds; ++k) {
        outcome found;
        if (!measure(context, all, k, &found))
            return false;
        aur_moments_add(&ratios, log(found.rays) - (fixed[k].a + fixed[k].b * log(found.error)));
    }
    const double mean = ratios.mean, half = aur_moments_interval(&ratios, 0.95);
    printf("  %-36s %.3f [%.3f, %.3f] of the rays of fixed patterns at equal error, %zu seeds\n", name,
           exp(mean), exp(mean - half), exp(mean + half), context->seeds);
    fflush(stdout);
    bench_figures_add(figures, target > 0.0 ? BENCH_AT_MOST : BENCH_NOTED, target, exp(mean), "",
                      "6. adaptive, %s: rays / fixed at equal error", name);
    return true;
}

static bool run_with(adaptive_context *context, bench_figures *figures) {
    static const struct {
        const char *name, *keys;
        double target;
    } ways[] = {
        {"variance, x2", "diffuse_samples=64,glossy_samples=32,level_factor=2,levels=4,threshold=0.02", 0.7},
        {"variance, x4", "diffuse_samples=40,glossy_samples=20,criterion=variance", 0.7},
        {"entropy, x4", "diffuse_samples=40,glossy_samples=20,criterion=entropy", 0.0}};
    char keys[80];
    double rays;
    snprintf(keys, sizeof keys, "diffuse_samples=%zu,glossy_samples=%zu", context->reference_directions,
             context->reference_directions / 2);
    /* Builds the photon map, which later renders use. */
    if (!render(context, keys, REFERENCE_SEED, &context->reference, &rays))
        return false;
    line fixed[SEEDS];
    bool good = true;
    for (size_t k = 0; k < context->seeds && good; ++k)
        good = fit_fixed(context, k, &fixed[k]);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0] && good; ++i)
        good = compare(context, ways[i].name, ways[i].keys, ways[i].target, fixed, figures);
    aur_image_destroy(context->reference);
    return good;
}

bool bench_gather_adaptive(const bench_options *options, bench_figures *figures) {
    adaptive_context context = {.side = options->quick ? QUICK_SIDE : SIDE,
                                .seeds = options->quick ? QUICK_SEEDS : SEEDS,
                                .reference_directions =
                                    options->quick ? QUICK_REFERENCE : REFERENCE_DIRECTIONS};
    context.options = (aur_render_options){.size = sizeof(aur_render_options),
                                           .gather = &lab_finalgather,
                                           .sampler = "sobol",
                                           .filter = "box",
                                           .samples_per_pixel = 1,
                                           .threads = options->threads,
                                           .width = context.side,
                                           .height = context.side};
    aur_scene *scene = NULL;
    if (aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml", NULL, &scene, &context.error) !=
        AUR_OK)
        return bench_fail("%s: %s", context.error.file, context.error.message);
    bool good = aur_renderer_create(scene, &context.renderer, &context.error) == AUR_OK ||
                bench_fail("%s", context.error.message);
    good = good && run_with(&context, figures);
    aur_renderer_destroy(context.renderer);
    aur_scene_destroy(scene);
    return good;
}
