/* Path tracing against Embree alone on the same rays: the overhead of shading, sampling and the film. */
#include <aureole-render/render.h>
#include <stdio.h>
#include <stdlib.h>

#include "limits.h"
#include "recorder.h"
#include "render/scene/scene.h"

enum { WIDTH = 128, SAMPLES = 16, QUICK_WIDTH = 16, CAPACITY = 1 << 22 };

typedef struct path_context {
    const aur_scene *scene;
    aur_renderer *renderer;
    aur_render_options options;
    aur_render_statistics statistics;
    bench_recorder recorder;
    aur_error error;
    bool failed;
} path_context;

static void render(void *data) {
    path_context *const context = data;
    aur_image *image = NULL;
    if (aur_renderer_render(context->renderer, &context->options, &image, &context->statistics,
                            &context->error) != AUR_OK)
        context->failed = true;
    aur_image_destroy(image);
}

static aur_result replay(void *data, size_t index) {
    (void)index;
    const path_context *const context = data;
    bench_keep((double)bench_replay(aur_scene_embree(context->scene), &context->recorder));
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the renderer. */
static void run_replay(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, replay, context, NULL);
}

static bool record(path_context *context) {
    context->recorder.count = 0;
    context->options.integrator = "path:packets=false,lamp_rays=0";
    bench_record(&context->recorder);
    render(context);
    bench_record(NULL);
    if (context->failed)
        return bench_fail("%s", context->error.message);
    if (context->recorder.count > CAPACITY || context->recorder.count != context->statistics.rays)
        return bench_fail("%zu rays were recorded, %llu counted", context->recorder.count,
                          (unsigned long long)context->statistics.rays);
    return true;
}

/* Single paths, and sixteen at a time, against the rays of the single paths. */
static bool compare(const bench_options *options, path_context *context, const char *name) {
    static const char *const integrators[] = {"path:packets=false,lamp_rays=0", "path:lamp_rays=0",
                                              "path:interleaved=true,lamp_rays=0"};
    static const char *const kinds[] = {"single", "packets", "interleaved"};
    if (!record(context))
        return false;
    const bench_work bare = {run_replay, context, (double)context->recorder.count};
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0] && !context->failed; ++i) {
        char label[96];
        snprintf(label, sizeof label, "%s, %s", name, kinds[i]);
        context->options.integrator = integrators[i];
        render(context);
        const bench_work path = {render, context, (double)context->statistics.rays};
        const bench_pair pair = bench_compare(options, &path, &bare);
        bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
    }
    return !context->failed || bench_fail("%s", context->error.message);
}

static bool run_scene(const bench_options *options, path_context *context, const char *file) {
    aur_scene *scene = NULL;
    char path[512], name[64];
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/cornell-box/%s.xml", file);
    snprintf(name, sizeof name, "%s, sobol", file);
    if (aur_scene_load(path, NULL, &scene, &context->error) != AUR_OK)
        return bench_fail("%s: %s", context->error.file, context->error.message);
    context->scene = scene;
    bool good = aur_renderer_create(scene, &context->renderer, &context->error) == AUR_OK;
    context->options.sampler = "sobol";
    good = good && compare(options, context, name);
    snprintf(name, sizeof name, "%s, random", file);
    context->options.sampler = "random";
    good = good && compare(options, context, name);
    aur_renderer_destroy(context->renderer);
    aur_scene_destroy(scene);
    return good;
}

static bool run(const bench_options *options) {
    path_context context = {
        .statistics = {.size = sizeof(aur_render_statistics)},
        .options = {.size = sizeof(aur_render_options),
                    .integrator = "path:lamp_rays=0",
                    .threads = 1,
                    .width = options->quick ? QUICK_WIDTH : WIDTH,
                    .height = options->quick ? QUICK_WIDTH : WIDTH,
                    .samples_per_pixel = SAMPLES},
        .recorder = {.capacity = CAPACITY, .rays = malloc(CAPACITY * sizeof(bench_recorded_ray))}};
    const bool good = context.recorder.rays == NULL ? bench_fail("out of memory")
                                                    : run_scene(options, &context, "cornell-box") &&
                                                          run_scene(options, &context, "glossy");
    free(context.recorder.rays);
    return good;
}

const bench bench_path = {"path", "path tracing against Embree alone on the rays that it traced", run};
