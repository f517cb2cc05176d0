/* Times single tiles, each with both methods alternately: disturbances longer than a few milliseconds then
 * affect both. */
#include "gather_weights.h"
#include "program/lab/gather.h"

#include <stdio.h>
#include <stdlib.h>

#include "render/film/integrator.h"

enum { WIDTH = 128, QUICK_WIDTH = 16, CHANNELS = 3, ROUNDS = 2 };

typedef struct gather_context {
    const aur_scene *scene;
    aur_cache *cache;
    aur_sampler *sampler;
    size_t width;
    double *sums;
    uint32_t *counts;
    aur_error error;
} gather_context;

/* A method of weighting. */
typedef struct gather_way {
    gather_context *context;
    aur_integrator *integrator;
    double prepare_seconds; /* CPU */
    double seconds;         /* of the last round */
} gather_way;

static bool prepare(gather_context *context, const char *keys, gather_way *way) {
    char text[256];
    const char *const sizes = context->width == WIDTH
                                  ? "photons=500000,diffuse_samples=64,glossy_samples=32"
                                  : "photons=2000,diffuse_samples=16,glossy_samples=8,rotations=2";
    snprintf(text, sizeof text, "finalgather-lab:%s,density=same,%s", sizes, keys);
    const aur_integrator_context integrator_context = {.scene = context->scene,
                                                       .samples_per_pixel = 1,
                                                       .threads = 1,
                                                       .cache = context->cache,
                                                       .gather = &lab_finalgather};
    aur_parameters parameters;
    *way = (gather_way){.context = context};
    if (aur_parameters_parse(&parameters, "integrator", text, &context->error) != AUR_OK)
        return bench_fail("%s", context->error.message);
    const double start = bench_cpu_seconds();
    const aur_result result =
        aur_integrator_create(&parameters, &integrator_context, &way->integrator, &context->error);
    way->prepare_seconds = bench_cpu_seconds() - start;
    aur_parameters_release(&parameters);
    return result == AUR_OK || bench_fail("%s", context->error.message);
}

static aur_result render_tile(gather_way *way, size_t index) {
    const gather_context *const context = way->context;
    const aur_view view = {.scene = context->scene,
                           .sampler = context->sampler,
                           .filter = aur_filter_find("box"),
                           .width = context->width,
                           .height = context->width,
                           .has_lens = aur_camera_has_lens(context->scene)};
    const size_t columns = context->width / AUR_TILE_SIZE;
    const size_t x = index % columns * AUR_TILE_SIZE, y = index / columns * AUR_TILE_SIZE;
    aur_tile tile = {.view = &view,
                     .x0 = x,
                     .x1 = x + AUR_TILE_SIZE,
                     .y0 = y,
                     .y1 = y + AUR_TILE_SIZE,
                     .count = 1,
                     .stride = context->width,
                     .channel_count = CHANNELS,
                     .sums = context->sums + (y * context->width + x) * CHANNELS,
                     .counts = context->counts + y * context->width + x};
    const double start = bench_cpu_seconds();
    const aur_result result = way->integrator->descriptor->tile(way->integrator, &tile);
    way->seconds += bench_cpu_seconds() - start;
    return result;
}

/* Renders all tiles with both methods, in alternating order by tile and round. */
typedef struct round_of_tiles {
    gather_way *ways[2];
    size_t number;
} round_of_tiles;

static aur_result render_round(void *data, size_t unused) {
    (void)unused;
    const round_of_tiles *const round = data;
    const gather_context *const context = round->ways[0]->context;
    const size_t columns = context->width / AUR_TILE_SIZE;
    round->ways[0]->seconds = round->ways[1]->seconds = 0.0;
    for (size_t tile = 0; tile < columns * columns; ++tile)
        for (size_t k = 0; k < 2; ++k) {
            const aur_result result = render_tile(round->ways[(k + tile + round->number) % 2], tile);
            if (result != AUR_OK)
                return result;
        }
    bench_keep(context->sums[0]);
    return AUR_OK;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Extra time over equal weights in percent: the median over many rounds. */
static bool compare(const bench_options *options, gather_context *context, const char *name, const char *keys,
                    gather_way *equal, double *percent) {
    enum { CAPACITY = 128 };
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    const size_t integrator_context = ROUNDS * options->pairs + 1;
    const size_t rounds = integrator_context < CAPACITY ? integrator_context : CAPACITY;
    double more[CAPACITY];
    gather_way way;
    bool good = prepare(context, keys, &way);
    round_of_tiles round = {.ways = {equal, &way}};
    for (; round.number < rounds + 1 && good; ++round.number) {
        /* On one thread with denormals flushed, like the renderer. The first round warms up. */
        good = aur_parallel_for(&one_thread, 1, render_round, &round, NULL) == AUR_OK ||
               bench_fail("out of memory");
        if (good && round.number > 0)
            more[round.number - 1] = 100.0 * (way.seconds / equal->seconds - 1.0);
    }
    if (good) {
        qsort(more, rounds, sizeof *more, ascending);
        *percent = more[rounds / 2];
        printf("  %-36s takes %.2f %% more than equal weights, quartiles %.2f and %.2f, %zu pairs of images; "
               "prepared in %.3f CPU s\n",
               name, *percent, more[rounds / 4], more[3 * rounds / 4], rounds, way.prepare_seconds);
        fflush(stdout);
    }
    aur_integrator_destroy(way.integrator);
    return good;
}

static bool run_with(const bench_options *options, gather_context *context, bench_figures *figures) {
    static const struct {
        const char *name, *keys;
        double target; /* upper limit in percent; 0: no target */
    } ways[] = {{"equal weights again", "weights=equal", 0.0},
                {"OSWA by table", "weights=oswa", 1.0},
                {"OSWA, a solve a point", "weights=oswa-solve", 0.0},
                {"OSW", "weights=osw", 0.0},
                {"MIS", "weights=mis", 0.0}};
    gather_way first, equal;
    /* Builds the photon map, which later renders use. */
    bool good = prepare(context, "weights=equal", &first);
    if (good)
        aur_integrator_destroy(first.integrator);
    if (!good || !prepare(context, "weights=equal", &equal))
        return false;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0] && good; ++i) {
        double percent = 0.0;
        good = compare(options, context, ways[i].name, ways[i].keys, &equal, &percent);
        bench_figures_add(figures, ways[i].target > 0.0 ? BENCH_AT_MOST : BENCH_NOTED, ways[i].target,
                          percent, "%", "3. %s: time over equal weights", ways[i].name);
    }
    aur_integrator_destroy(equal.integrator);
    return good;
}

bool bench_gather_weights_cost(const bench_options *options, bench_figures *figures) {
    gather_context context = {.width = options->quick ? QUICK_WIDTH : WIDTH, .cache = aur_cache_create()};
    aur_scene *scene = NULL;
    if (aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml", NULL, &scene, &context.error) !=
        AUR_OK) {
        aur_cache_destroy(context.cache);
        return bench_fail("%s: %s", context.error.file, context.error.message);
    }
    context.scene = scene;
    const size_t pixels = context.width * context.width;
    context.sums = calloc(pixels, CHANNELS * sizeof *context.sums);
    context.counts = calloc(pixels, sizeof *context.counts);
    bool good = context.sums != NULL && context.counts != NULL && context.cache != NULL;
    if (!good)
        bench_fail("out of memory");
    good = good && (aur_sampler_create("sobol", 1, NULL, &context.sampler, &context.error) == AUR_OK ||
                    bench_fail("%s", context.error.message));
    good = good && run_with(options, &context, figures);
    free(context.sums);
    free(context.counts);
    aur_sampler_destroy(context.sampler);
    aur_cache_destroy(context.cache);
    aur_scene_destroy(scene);
    return good;
}
