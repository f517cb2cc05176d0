/* Sharing gathered light between pixels: the error that is left and its uniformity. Renders the same
 * directions with each value of the key `share`, with two seeds. */
#include <aureole-render/render.h>
#include <stdio.h>

#include "bench.h"
#include "error_pattern.h"

enum { SIDE = 256, QUICK_SIDE = 16, BLOCK = 8 };

static const char *const scenes[] = {"cornell-box/cornell-box.xml", "cornell-box/glossy.xml"};
static const char *const shares[] = {"false", "near", "true"};
static const size_t directions[] = {4, 16};

/* Mean of all values, difference of two images, and CPU seconds of one image. */
typedef struct shared_error {
    double mean, error, clumps, seconds;
} shared_error;

static bool measure(aur_renderer *renderer, aur_render_options options, shared_error *found,
                    aur_error *error) {
    aur_image *images[2] = {NULL, NULL};
    bool good = true;
    *found = (shared_error){.seconds = 0.0};
    for (size_t i = 0; i < 2 && good; ++i) {
        const double begin = bench_cpu_seconds();
        options.seed = i + 1;
        good = aur_renderer_render(renderer, &options, &images[i], NULL, error) == AUR_OK;
        found->seconds += 0.5 * (bench_cpu_seconds() - begin);
    }
    error_pattern pattern = {.width = options.width, .height = options.height};
    const size_t pixels = options.width * options.height;
    if (good && !error_pattern_open(options.width, options.height, aur_image_channel_count(images[0]),
                                    aur_image_data(images[0]), aur_image_data(images[1]), &pattern))
        good = snprintf(error->message, sizeof error->message, "out of memory") < 0;
    double squares = 0.0;
    for (size_t i = 0; i < 3 * pixels && good; ++i) {
        const size_t at = i / 3 * aur_image_channel_count(images[0]) + i % 3;
        squares += pattern.differences[i] * pattern.differences[i];
        found->mean +=
            (double)(aur_image_data(images[0])[at] + aur_image_data(images[1])[at]) / (6.0 * (double)pixels);
    }
    if (good) {
        found->error = sqrt(squares / (6.0 * (double)pixels)) / found->mean;
        found->clumps = error_pattern_clumps(&pattern, BLOCK);
    }
    error_pattern_close(&pattern);
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
    return good;
}

static bool run_scene(const bench_options *options, const char *scene, aur_renderer *renderer) {
    const size_t side = options->quick ? QUICK_SIDE : SIDE;
    aur_error error = {0};
    for (size_t d = 0; d < (options->quick ? 1 : sizeof directions / sizeof directions[0]); ++d)
        for (size_t s = 0; s < sizeof shares / sizeof shares[0]; ++s) {
            char integrator[200];
            shared_error found;
            snprintf(integrator, sizeof integrator,
                     "finalgather:photons=100000,short_rays=4,edges=256,light_samples=4,"
                     "diffuse_samples=%zu,glossy_samples=64,share=%s",
                     directions[d], shares[s]);
            const aur_render_options render = {.size = sizeof render,
                                               .integrator = integrator,
                                               .sampler = "sobol",
                                               .filter = "box",
                                               .threads = 1,
                                               .width = side,
                                               .height = side,
                                               .samples_per_pixel = 4};
            if (!measure(renderer, render, &found, &error))
                return bench_fail("%s", error.message);
            printf(
                "%s, %zu directions, share=%s: error %.3g %%, means over %d x %d pixels %.2f of independent "
                "errors', %.2f CPU s\n",
                scene, directions[d], shares[s], 100.0 * found.error, BLOCK, BLOCK, found.clumps,
                found.seconds);
        }
    return true;
}

static bool run(const bench_options *options) {
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; ++i) {
        char path[512];
        aur_error error = {0};
        aur_scene *scene = NULL;
        aur_renderer *renderer = NULL;
        snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", scenes[i]);
        bool good = aur_scene_load(path, NULL, &scene, &error) == AUR_OK &&
                    aur_renderer_create(scene, &renderer, &error) == AUR_OK;
        good = good ? run_scene(options, scenes[i], renderer) : bench_fail("%s", error.message);
        aur_renderer_destroy(renderer);
        aur_scene_destroy(scene);
        if (!good)
            return false;
    }
    return true;
}

const bench bench_share = {"share", "what shared light leaves of the error, and how even it is", run};
