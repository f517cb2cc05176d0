/* What weights cost in a picture: the final gather of the glossy Cornell box with optimal weights from
 * tables, with the published solve at every shading point, and by multiple importance sampling, against equal
 * weights, all preparation apart. */
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "core/parallel.h"
#include "transport/integrator.h"

enum { WIDTH = 128, QUICK_WIDTH = 32, CHANNELS = 3 };

typedef struct gather_context {
    const aur_scene *scene;
    aur_cache *cache;
    aur_sampler *sampler;
    size_t width;
    double *sums;
    uint32_t *counts;
    aur_error error;
} gather_context;

/* One way to weigh. */
typedef struct gather_way {
    gather_context *context;
    aur_integrator *integrator;
    double prepare_seconds; /* CPU */
    bool failed;
} gather_way;

static bool prepare(gather_context *context, const char *keys, gather_way *way) {
    char text[256];
    snprintf(text, sizeof text, "finalgather:photons=%d,diffuse_samples=64,glossy_samples=32,density=same,%s",
             context->width == WIDTH ? 500000 : 20000, keys);
    const aur_integrator_context wanted = {
        .scene = context->scene, .samples_per_pixel = 1, .threads = 1, .cache = context->cache};
    aur_parameters parameters;
    *way = (gather_way){.context = context};
    if (aur_parameters_parse(&parameters, "integrator", text, &context->error) != AUR_OK)
        return false;
    const double start = bench_cpu_seconds();
    const aur_result result = aur_integrator_create(&parameters, &wanted, &way->integrator, &context->error);
    way->prepare_seconds = bench_cpu_seconds() - start;
    aur_parameters_release(&parameters);
    return result == AUR_OK;
}

static aur_result render_tile(void *data, size_t index) {
    gather_way *const way = data;
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
    return way->integrator->descriptor->tile(way->integrator, &tile);
}

static void render(void *data) {
    static const aur_parallel_options one_thread = {.threads = 1};
    gather_way *const way = data;
    const size_t columns = way->context->width / AUR_TILE_SIZE;
    way->failed = aur_parallel_for(&one_thread, columns * columns, render_tile, way) != AUR_OK;
    bench_keep(way->context->sums[0]);
}

static bool compare(const bench_options *options, gather_context *context, const char *name, const char *keys,
                    gather_way *equal) {
    gather_way way;
    bool good = prepare(context, keys, &way);
    if (good) {
        const double pixels = (double)(context->width * context->width);
        const bench_work subject = {render, &way, pixels}, limit = {render, equal, pixels};
        const bench_pair pair = bench_compare(options, &subject, &limit);
        bench_print_pair(name, "equal weights", "kpixel", 1e3, &pair);
        printf("    %-37s takes %.2f %% more, [%.2f, %.2f]; prepared in %.3f CPU s (equal weights: %.3f)\n",
               "", 100.0 * (1.0 / pair.ratio - 1.0), 100.0 * (1.0 / pair.ratio_high - 1.0),
               100.0 * (1.0 / pair.ratio_low - 1.0), way.prepare_seconds, equal->prepare_seconds);
        good = !way.failed;
    }
    aur_integrator_destroy(way.integrator);
    return good;
}

static bool run_with(const bench_options *options, gather_context *context) {
    gather_way first = {0}, equal = {0};
    /* The photon map is made here and kept. */
    bool good = prepare(context, "weights=equal,clip=false", &first) &&
                prepare(context, "weights=equal,clip=false", &equal);
    good = good && compare(options, context, "OSW", "weights=osw,clip=false", &equal) &&
           compare(options, context, "OSWA by table", "weights=oswa,clip=false", &equal) &&
           compare(options, context, "OSWA by table, clipped", "weights=oswa", &equal) &&
           compare(options, context, "equal weights, clipped", "weights=equal", &equal) &&
           compare(options, context, "MIS", "weights=mis", &equal) &&
           compare(options, context, "OSWA, a solve a point", "weights=oswa-solve", &equal);
    aur_integrator_destroy(first.integrator);
    aur_integrator_destroy(equal.integrator);
    return good || bench_fail("gather-weights: %s", context->error.message);
}

static bool run(const bench_options *options) {
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
    good = good && aur_sampler_create("sobol", 1, NULL, &context.sampler, &context.error) == AUR_OK;
    good = good && run_with(options, &context);
    free(context.sums);
    free(context.counts);
    aur_sampler_destroy(context.sampler);
    aur_cache_destroy(context.cache);
    aur_scene_destroy(scene);
    return good;
}

const bench bench_gather_weights = {"gather-weights",
                                    "optimal weights in the final gather against equal ones", run};
