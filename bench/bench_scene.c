/* The scene's ray queries against Embree on the same scene, single rays and packets of 16, from the camera
 * and from the surfaces of the glossy Cornell box. */
#include <stdio.h>
#include <stdlib.h>

#include "limits.h"
#include "trace.h"

enum { WIDTH = 256, RAY_COUNT = WIDTH * WIDTH };

typedef struct trace_context {
    const aur_scene *scene;
    const bench_rays *rays;
    size_t (*trace)(const struct trace_context *context);
} trace_context;

static size_t trace_scene(const trace_context *context) {
    size_t hits = 0;
    aur_hit hit;
    for (size_t i = 0; i < RAY_COUNT; ++i)
        hits += aur_scene_intersect(context->scene, &context->rays->rays[i], &hit);
    return hits;
}

/* The cost of a shading point: intersection and surface interaction. */
static size_t trace_surfaces(const trace_context *context) {
    size_t upwards = 0;
    aur_hit hit;
    aur_surface surface;
    for (size_t i = 0; i < RAY_COUNT; ++i) {
        const aur_ray *const ray = &context->rays->rays[i];
        if (!aur_scene_intersect(context->scene, ray, &hit))
            continue;
        aur_scene_surface(context->scene, ray, &hit, &surface);
        upwards += surface.frame.z.y > 0.0f;
    }
    return upwards;
}

static size_t trace_single(const trace_context *context) {
    return bench_trace_single(context->rays);
}

static size_t trace_packets(const trace_context *context) {
    return bench_trace_packets(context->rays);
}

static aur_result trace(void *data, size_t index) {
    (void)index;
    const trace_context *const context = data;
    bench_keep((double)context->trace(context));
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the renderer. */
static void run_trace(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, trace, context, NULL);
}

static void compare(const bench_options *options, const aur_scene *scene, const char *name,
                    const bench_rays *rays) {
    trace_context ours = {scene, rays, trace_scene}, surfaces = {scene, rays, trace_surfaces};
    trace_context single = {scene, rays, trace_single}, packets = {scene, rays, trace_packets};
    const bench_work hits = {run_trace, &ours, RAY_COUNT}, shading = {run_trace, &surfaces, RAY_COUNT};
    const bench_work one = {run_trace, &single, RAY_COUNT}, sixteen = {run_trace, &packets, RAY_COUNT};
    char label[64];
    snprintf(label, sizeof label, "%s: hits", name);
    bench_pair pair = bench_compare(options, &hits, &one);
    bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
    pair = bench_compare(options, &hits, &sixteen);
    bench_print_pair(label, "Embree, packets", "Mray", 1e6, &pair);
    snprintf(label, sizeof label, "%s: hits and surfaces", name);
    pair = bench_compare(options, &shading, &one);
    bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
}

/* Cosine-distributed from the hit point; a ray without a hit is unchanged. */
static aur_ray secondary_ray(const aur_scene *scene, const aur_ray *primary, size_t index) {
    aur_hit hit;
    if (!aur_scene_intersect(scene, primary, &hit))
        return *primary;
    aur_surface surface;
    aur_scene_surface(scene, primary, &hit, &surface);
    const bool behind = aur_vector_dot(surface.frame.z, primary->direction) > 0.0f;
    const aur_vector normal = behind ? aur_vector_scale(surface.frame.z, -1.0f) : surface.frame.z;
    return aur_surface_ray(&surface, bench_cosine_direction(normal, index));
}

static bool run(const bench_options *options) {
    aur_error error;
    aur_scene *scene = NULL;
    if (aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml", NULL, &scene, &error) != AUR_OK)
        return bench_fail("%s: %s", error.file, error.message);
    aur_ray *const primary = malloc(2 * RAY_COUNT * sizeof *primary);
    if (primary != NULL) {
        aur_ray *const secondary = primary + RAY_COUNT;
        static const float lens[2] = {0.5f, 0.5f};
        for (size_t i = 0; i < RAY_COUNT; ++i) {
            size_t x, y;
            bench_pixel(i, WIDTH, &x, &y);
            aur_camera_ray(scene, WIDTH, WIDTH, (float)x + 0.5f, (float)y + 0.5f, lens, &primary[i]);
            secondary[i] = secondary_ray(scene, &primary[i], i);
        }
        const bench_rays from_eye = {aur_scene_embree(scene), RAY_COUNT, primary, false, AUR_EMBREE_COHERENT};
        const bench_rays from_surfaces = {aur_scene_embree(scene), RAY_COUNT, secondary, false,
                                          AUR_EMBREE_INCOHERENT};
        compare(options, scene, "from the eye", &from_eye);
        compare(options, scene, "from surfaces", &from_surfaces);
    }
    const bool allocated = primary != NULL;
    free(primary);
    aur_scene_destroy(scene);
    return allocated || bench_fail("out of memory");
}

const bench bench_scene = {"scene", "rays of a loaded scene against Embree itself", run};
