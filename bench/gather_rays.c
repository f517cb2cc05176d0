#include "gather_rays.h"

#include <aureole-render/render.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "child.h"
#include "heavy_box.h"
#include "packet_recorder.h"
#include "program/lab/gather.h"
#include "render/scene/scene.h"

enum { SIDE = 256, QUICK_SIDE = 32, DIRECTIONS = 32, BUMPY_TRIANGLES = 500000, MANY_TRIANGLES = 1500000 };

typedef struct gather_context {
    const aur_scene *scene;
    aur_renderer *renderer;
    aur_render_options options;
    aur_render_statistics statistics;
    bench_packet_recorder recorder;
    aur_error error;
    bool failed;
} gather_context;

static void render(void *data) {
    gather_context *const context = data;
    aur_image *image = NULL;
    if (aur_renderer_render(context->renderer, &context->options, &image, &context->statistics,
                            &context->error) != AUR_OK)
        context->failed = true;
    aur_image_destroy(image);
}

static aur_result replay(void *data, size_t index) {
    (void)index;
    const gather_context *const context = data;
    bench_keep((double)bench_replay_packets(aur_scene_embree(context->scene), &context->recorder));
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the renderer. */
static void run_replay(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, replay, context, NULL);
}

static bool record(gather_context *context) {
    context->recorder.count = context->recorder.rays = context->recorder.coherent_rays = 0;
    render(context); /* builds the photon map, whose rays do not count */
    bench_record_packets(&context->recorder);
    render(context);
    bench_record_packets(NULL);
    if (context->failed)
        return bench_fail("%s", context->error.message);
    if (context->recorder.count > context->recorder.capacity)
        return bench_fail("%zu packets are too many to record", context->recorder.count);
    return true;
}

/* Only indirect light of diffuse surfaces: one packet of primary rays per 32 packets of gather rays. */
#define GATHER "finalgather-lab:direct=none,edges=0,component=diffuse,photons=100000,diffuse_samples=32"

static bool compare(const bench_options *options, gather_context *context, const char *name, bool flat,
                    bench_figures *figures) {
    context->options.integrator = GATHER;
    if (!record(context))
        return false;
    const double packet_rays = (double)context->recorder.rays, rays = (double)context->statistics.rays;
    const bench_work ours = {render, context, rays}, bare = {run_replay, context, packet_rays};
    const bench_pair pair = bench_compare(options, &ours, &bare);
    bench_print_pair(name, "Embree, the same packets", "Mray", 1e6, &pair);
    gather_context single = *context;
    single.options.integrator = GATHER ",packets=false";
    render(&single);
    const bench_work one_by_one = {render, &single, (double)single.statistics.rays};
    const bench_pair against = bench_compare(options, &ours, &one_by_one);
    bench_print_pair(name, "rays one by one", "Mray", 1e6, &against);
    gather_context shared = *context;
    shared.options.threads = options->threads;
    const bench_work on_all = {render, &shared, rays};
    const bench_pair threads = bench_compare(options, &on_all, &ours);
    bench_print_pair(name, "the same on one thread", "Mray", 1e6, &threads);
    if (context->failed || single.failed || shared.failed)
        return bench_fail("%s", context->error.message);
    const double limit = pair.limit / 1e6;
    const double target = limit < 10.0 ? 0.80 : limit > 40.0 ? 0.45 : 0.0;
    bench_figures_add(figures, BENCH_NOTED, 0.0, limit, "Mray", "1. %s: bare Embree, a CPU second", name);
    bench_figures_add(figures, BENCH_NOTED, 0.0, (double)context->recorder.coherent_rays / packet_rays, "",
                      "1. %s: part of the rays traced as coherent", name);
    bench_figures_add(figures, target > 0.0 ? BENCH_AT_LEAST : BENCH_NOTED, target, pair.ratio, "",
                      "1. %s: rays / bare Embree", name);
    bench_figures_add(figures, BENCH_AT_LEAST, flat ? 2.0 : 1.0, against.ratio, "",
                      "1. %s: packets / single rays", name);
    if (options->threads > 1)
        bench_figures_add(figures, BENCH_AT_MOST, 1.1, 1.0 / threads.ratio, "",
                          "8. %s: CPU time of a ray, %zu threads / one", name, options->threads);
    return true;
}

static bool run_scene(const bench_options *options, const char *path, const char *name, bool flat,
                      bench_figures *figures) {
    const size_t side = options->quick ? QUICK_SIDE : SIDE;
    gather_context context = {.statistics = {.size = sizeof(aur_render_statistics)},
                              .options = {.size = sizeof(aur_render_options),
                                          .gather = &lab_finalgather,
                                          .sampler = "sobol",
                                          .filter = "box",
                                          .samples_per_pixel = 1,
                                          .threads = 1,
                                          .width = side,
                                          .height = side}};
    aur_scene *scene = NULL;
    if (aur_scene_load(path, NULL, &scene, &context.error) != AUR_OK)
        return bench_fail("%s: %s", context.error.file, context.error.message);
    context.scene = scene;
    /* Lanes of a group may have different rules and groups may be partly filled: capacity for four times as
     * many packets as when full. Two more packets for the prefetch of the replay. */
    const size_t size = aur_embree_scene_packet_size(aur_scene_embree(scene));
    context.recorder.capacity = 4 * side * side * (DIRECTIONS + 1) / (size > 0 ? size : 1);
    context.recorder.packets = malloc((context.recorder.capacity + 3) * sizeof *context.recorder.packets);
    bool good = context.recorder.packets != NULL || bench_fail("out of memory");
    if (good)
        good = aur_renderer_create(scene, &context.renderer, &context.error) == AUR_OK ||
               bench_fail("%s", context.error.message);
    good = good && compare(options, &context, name, flat, figures);
    aur_renderer_destroy(context.renderer);
    free(context.recorder.packets);
    aur_scene_destroy(scene);
    return good;
}

bool bench_gather_rays(const bench_options *options, bench_figures *figures) {
    char folder[4000], bumpy[4096], many[4096];
    if (!bench_data_folder(folder, sizeof folder) ||
        !bench_heavy_box(folder, options->quick ? 2000 : BUMPY_TRIANGLES, bumpy, sizeof bumpy) ||
        !run_scene(options, AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", "flat walls", true,
                   figures) ||
        !run_scene(options, bumpy, "bumpy spheres, 500k", false, figures))
        return false;
    if (options->quick)
        return true;
    if (access(AUR_SOURCE_DIR "/scenes/generated/car-body.ply", R_OK) == 0 &&
        !run_scene(options, AUR_SOURCE_DIR "/scenes/parade/parade.xml", "parade of cars, 1.5M", false,
                   figures))
        return false;
    return bench_heavy_box(folder, MANY_TRIANGLES, many, sizeof many) &&
           run_scene(options, many, "bumpy spheres, 1.5M", false, figures);
}
