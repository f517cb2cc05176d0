/* The scene's rays against Embree itself on the same scene, ray by ray and in packets of 16, from the eye and
 * from the surfaces of the glossy Cornell box. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "limits.h"
#include "scene/embree.h"
#include "scene/scene_data.h"

enum { WIDTH = 256, RAY_COUNT = WIDTH * WIDTH, PACKET_SIZE = 16 };

typedef struct trace_context {
    const aur_scene *scene;
    const aur_ray *rays;    /* RAY_COUNT */
    aur_embree_order order; /* of packets */
    double (*trace)(const struct trace_context *context);
} trace_context;

/* Rays with a name. */
typedef struct ray_batch {
    const char *name;
    const aur_ray *rays;
    aur_embree_order order;
} ray_batch;

static double trace_scene(const trace_context *context) {
    size_t hits = 0;
    aur_hit hit;
    for (size_t i = 0; i < RAY_COUNT; ++i)
        hits += aur_scene_intersect(context->scene, &context->rays[i], &hit);
    return (double)hits;
}

/* What a shading point costs: the hit and all that is known of the surface there. */
static double trace_surfaces(const trace_context *context) {
    float sum = 0.0f;
    aur_hit hit;
    aur_surface surface;
    for (size_t i = 0; i < RAY_COUNT; ++i)
        if (aur_scene_intersect(context->scene, &context->rays[i], &hit)) {
            aur_scene_surface(context->scene, &context->rays[i], &hit, &surface);
            sum += surface.frame.z.z;
        }
    return (double)sum;
}

static double trace_single(const trace_context *context) {
    size_t hits = 0;
    for (size_t i = 0; i < RAY_COUNT; ++i) {
        const aur_ray *const ray = &context->rays[i];
        struct RTCRayHit query = {.ray = {.org_x = ray->origin.x,
                                          .org_y = ray->origin.y,
                                          .org_z = ray->origin.z,
                                          .tnear = ray->nearest,
                                          .dir_x = ray->direction.x,
                                          .dir_y = ray->direction.y,
                                          .dir_z = ray->direction.z,
                                          .tfar = ray->farthest,
                                          .mask = UINT32_MAX}};
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        aur_embree_intersect1(context->scene->accel, &query);
        hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return (double)hits;
}

static double trace_packets(const trace_context *context) {
    static const _Alignas(64) int valid[PACKET_SIZE] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                        -1, -1, -1, -1, -1, -1, -1, -1};
    _Alignas(64) struct RTCRayHit16 query;
    memset(&query, 0, sizeof query);
    size_t hits = 0;
    for (size_t first = 0; first < RAY_COUNT; first += PACKET_SIZE) {
        for (size_t k = 0; k < PACKET_SIZE; ++k) {
            const aur_ray *const ray = &context->rays[first + k];
            query.ray.org_x[k] = ray->origin.x;
            query.ray.org_y[k] = ray->origin.y;
            query.ray.org_z[k] = ray->origin.z;
            query.ray.tnear[k] = ray->nearest;
            query.ray.dir_x[k] = ray->direction.x;
            query.ray.dir_y[k] = ray->direction.y;
            query.ray.dir_z[k] = ray->direction.z;
            query.ray.tfar[k] = ray->farthest;
            query.ray.mask[k] = UINT32_MAX;
            query.hit.geomID[k] = query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        aur_embree_intersect16(context->scene->accel, context->order, valid, &query);
        for (size_t k = 0; k < PACKET_SIZE; ++k)
            hits += query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
    return (double)hits;
}

static aur_result trace(void *data, size_t index) {
    (void)index;
    const trace_context *const context = data;
    bench_keep(context->trace(context));
    return AUR_OK;
}

/* One item on one thread: with denormals flushed, as the renderer traces. */
static void run_trace(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1};
    aur_parallel_for(&one_thread, 1, trace, context);
}

static void compare(const bench_options *options, const aur_scene *scene, const ray_batch *batch) {
    trace_context ours = {scene, batch->rays, batch->order, trace_scene}, surfaces = ours, single = ours,
                  packets = ours;
    surfaces.trace = trace_surfaces;
    single.trace = trace_single;
    packets.trace = trace_packets;
    const bench_work hits = {run_trace, &ours, RAY_COUNT}, shading = {run_trace, &surfaces, RAY_COUNT};
    const bench_work one = {run_trace, &single, RAY_COUNT}, sixteen = {run_trace, &packets, RAY_COUNT};
    char label[64];
    snprintf(label, sizeof label, "%s: hits", batch->name);
    bench_pair pair = bench_compare(options, &hits, &one);
    bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
    pair = bench_compare(options, &hits, &sixteen);
    bench_print_pair(label, "Embree, packets", "Mray", 1e6, &pair);
    snprintf(label, sizeof label, "%s: hits and surfaces", batch->name);
    pair = bench_compare(options, &shading, &one);
    bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
}

/* Cosine distributed from where the ray hits; a ray that hits nothing is kept. */
static aur_ray secondary_ray(const aur_scene *scene, const aur_ray *primary, size_t index) {
    aur_hit hit;
    if (!aur_scene_intersect(scene, primary, &hit))
        return *primary;
    aur_surface surface;
    aur_scene_surface(scene, primary, &hit, &surface);
    const bool behind = aur_vector_dot(surface.frame.z, primary->direction) > 0.0f;
    const aur_frame frame =
        aur_frame_about(behind ? aur_vector_scale(surface.frame.z, -1.0f) : surface.frame.z);
    const double u = aur_unit_double(aur_hash2(index, 0)),
                 phi = 2.0 * AUR_PI * aur_unit_double(aur_hash2(index, 1));
    const aur_vector local = {(float)(sqrt(u) * cos(phi)), (float)(sqrt(u) * sin(phi)), (float)sqrt(1.0 - u)};
    return aur_surface_ray(&surface, aur_frame_to_world(&frame, local));
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
            /* Blocks of 4x4 pixels, so that a packet's rays are neighbours. */
            const size_t block = i / PACKET_SIZE, within = i % PACKET_SIZE;
            const size_t x = block % (WIDTH / 4) * 4 + within % 4, y = block / (WIDTH / 4) * 4 + within / 4;
            aur_camera_ray(scene, WIDTH, WIDTH, (float)x + 0.5f, (float)y + 0.5f, lens, &primary[i]);
            secondary[i] = secondary_ray(scene, &primary[i], i);
        }
        compare(options, scene, &(ray_batch){"from the eye", primary, AUR_EMBREE_COHERENT});
        compare(options, scene, &(ray_batch){"from surfaces", secondary, AUR_EMBREE_INCOHERENT});
    }
    const bool allocated = primary != NULL;
    free(primary);
    aur_scene_destroy(scene);
    return allocated || bench_fail("out of memory");
}

const bench bench_scene = {"scene", "rays of a loaded scene against Embree itself", run};
