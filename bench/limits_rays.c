/* Embree alone: the baseline of every integrator's ray tracing. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "trace.h"

typedef enum ray_form { PRIMARY, SECONDARY, OCCLUDED } ray_form;
enum { FORM_MASK = 3, PACKET = 4, BUMPY = 8, WIDTH = 256, RAY_COUNT = WIDTH * WIDTH };

typedef struct ray_context {
    RTCDevice device;
    aur_ray *stored; /* RAY_COUNT */
    bench_rays rays;
    bool packets;
} ray_context;

/* --- the scenes */

static bool add_mesh(RTCDevice device, RTCScene scene, size_t vertex_count, const aur_vector *vertices,
                     size_t triangle_count, const uint32_t *indices) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *const v = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof *vertices, vertex_count);
    void *const t = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof *indices, triangle_count);
    if (v == NULL || t == NULL) {
        rtcReleaseGeometry(geometry);
        return false;
    }
    memcpy(v, vertices, vertex_count * sizeof *vertices);
    memcpy(t, indices, 3 * triangle_count * sizeof *indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return true;
}

/* The cube [-1,1]^3. */
static bool add_box(RTCDevice device, RTCScene scene) {
    aur_vector vertices[8];
    for (size_t i = 0; i < 8; ++i)
        vertices[i] = (aur_vector){(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 1.0f : -1.0f,
                                   (i & 4) != 0 ? 1.0f : -1.0f};
    static const uint32_t indices[36] = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                         2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    return add_mesh(device, scene, 8, vertices, 12, indices);
}

/* A sphere about the origin with a wavy radius: `rows` by `rows` quads. */
static bool add_bumpy_sphere(RTCDevice device, RTCScene scene, size_t rows) {
    const size_t side = rows + 1;
    aur_vector *const vertices = malloc(side * side * sizeof *vertices);
    uint32_t *const indices = malloc(6 * rows * rows * sizeof *indices);
    const bool allocated = vertices != NULL && indices != NULL;
    for (size_t i = 0; allocated && i < side * side; ++i) {
        const double theta = AUR_PI * (double)(i / side) / (double)rows;
        const double phi = 2.0 * AUR_PI * (double)(i % side) / (double)rows;
        const double radius = 0.5 + 0.05 * sin(24.0 * theta) * sin(24.0 * phi);
        vertices[i] = (aur_vector){(float)(radius * sin(theta) * cos(phi)),
                                   (float)(radius * sin(theta) * sin(phi)), (float)(radius * cos(theta))};
    }
    for (size_t i = 0; allocated && i < rows * rows; ++i) {
        const uint32_t a = (uint32_t)(i / rows * side + i % rows), b = a + (uint32_t)side;
        const uint32_t quad[6] = {a, b, b + 1, a, b + 1, a + 1};
        memcpy(indices + 6 * i, quad, sizeof quad);
    }
    const bool added = allocated && add_mesh(device, scene, side * side, vertices, 2 * rows * rows, indices);
    free(vertices);
    free(indices);
    return added;
}

/* --- the rays */

static aur_ray primary_ray(size_t index) {
    size_t x, y;
    bench_pixel(index, WIDTH, &x, &y);
    const aur_vector direction = {2.0f * ((float)x + 0.5f) / WIDTH - 1.0f, 1.0f,
                                  2.0f * ((float)y + 0.5f) / WIDTH - 1.0f};
    return (aur_ray){
        .origin = {0.01f, -0.97f, 0.02f}, .direction = aur_vector_normalize(direction), .farthest = INFINITY};
}

/* From the primary hit, cosine-distributed about the normal that faces the camera. */
static aur_ray secondary_ray(RTCScene scene, size_t index, float farthest) {
    const aur_ray primary = primary_ray(index);
    struct RTCRayHit query = bench_query(&primary);
    aur_embree_intersect1(scene, &query);
    aur_vector normal = aur_vector_normalize((aur_vector){query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
    if (aur_vector_dot(normal, primary.direction) > 0.0f)
        normal = aur_vector_scale(normal, -1.0f);
    const aur_vector hit = aur_vector_add_scaled(primary.origin, query.ray.tfar, primary.direction);
    return (aur_ray){.origin = aur_vector_add_scaled(hit, 1e-4f, normal),
                     .direction = bench_cosine_direction(normal, index),
                     .farthest = farthest};
}

static aur_result trace(void *data, size_t index) {
    (void)index;
    const ray_context *const context = data;
    bench_keep((double)(context->packets ? bench_trace_packets(&context->rays)
                                         : bench_trace_single(&context->rays)));
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the renderer. */
static void run_rays(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, trace, context, NULL);
}

static void close_rays(bench_work *work) {
    ray_context *const context = work->context;
    if (context == NULL)
        return;
    if (context->rays.scene != NULL)
        rtcReleaseScene(context->rays.scene);
    if (context->device != NULL)
        rtcReleaseDevice(context->device);
    free(context->stored);
    free(context);
    work->context = NULL;
}

static bool open_rays(const bench_limit *limit, const bench_options *options, bench_work *work) {
    ray_context *const context = calloc(1, sizeof *context);
    *work = (bench_work){.run = run_rays, .context = context, .units = RAY_COUNT};
    if (context == NULL)
        return bench_fail("out of memory");
    const ray_form form = (ray_form)(limit->form & FORM_MASK);
    context->packets = (limit->form & PACKET) != 0;
    context->stored = malloc(RAY_COUNT * sizeof *context->stored);
    char configuration[AUR_EMBREE_CONFIGURATION_CAPACITY];
    aur_embree_configuration(0, 0, configuration);
    context->device = rtcNewDevice(configuration);
    const RTCScene scene = context->device != NULL ? rtcNewScene(context->device) : NULL;
    context->rays = (bench_rays){.scene = scene,
                                 .count = RAY_COUNT,
                                 .rays = context->stored,
                                 .occluded = form == OCCLUDED,
                                 .order = form == PRIMARY ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT};
    const size_t rows = options->quick ? 50 : 500;
    if (context->stored == NULL || scene == NULL || !add_box(context->device, scene) ||
        ((limit->form & BUMPY) != 0 && !add_bumpy_sphere(context->device, scene, rows))) {
        close_rays(work);
        return bench_fail("Embree cannot build the scene of %s", limit->name);
    }
    rtcCommitScene(scene);
    /* Half the size of the room, so that some rays are occluded and some are not. */
    const float farthest = form == OCCLUDED ? 1.0f : INFINITY;
    for (size_t i = 0; i < RAY_COUNT; ++i)
        context->stored[i] = form == PRIMARY ? primary_ray(i) : secondary_ray(scene, i, farthest);
    return true;
}

const bench_limit bench_limit_rays_box_primary = {"rays-box-primary", "Mray",     1e6,
                                                  open_rays,          close_rays, PRIMARY};
const bench_limit bench_limit_rays_box_primary_packet = {
    "rays-box-primary-packet", "Mray", 1e6, open_rays, close_rays, PRIMARY | PACKET};
const bench_limit bench_limit_rays_box_secondary = {"rays-box-secondary", "Mray",   1e6, open_rays,
                                                    close_rays,           SECONDARY};
const bench_limit bench_limit_rays_box_secondary_packet = {
    "rays-box-secondary-packet", "Mray", 1e6, open_rays, close_rays, SECONDARY | PACKET};
const bench_limit bench_limit_rays_box_occluded = {"rays-box-occluded", "Mray",     1e6,
                                                   open_rays,           close_rays, OCCLUDED};
const bench_limit bench_limit_rays_box_occluded_packet = {
    "rays-box-occluded-packet", "Mray", 1e6, open_rays, close_rays, OCCLUDED | PACKET};
const bench_limit bench_limit_rays_bumpy_primary = {"rays-bumpy-primary", "Mray",         1e6, open_rays,
                                                    close_rays,           BUMPY | PRIMARY};
const bench_limit bench_limit_rays_bumpy_primary_packet = {
    "rays-bumpy-primary-packet", "Mray", 1e6, open_rays, close_rays, BUMPY | PRIMARY | PACKET};
const bench_limit bench_limit_rays_bumpy_secondary = {
    "rays-bumpy-secondary", "Mray", 1e6, open_rays, close_rays, BUMPY | SECONDARY};
const bench_limit bench_limit_rays_bumpy_secondary_packet = {
    "rays-bumpy-secondary-packet", "Mray", 1e6, open_rays, close_rays, BUMPY | SECONDARY | PACKET};
const bench_limit bench_limit_rays_bumpy_occluded = {
    "rays-bumpy-occluded", "Mray", 1e6, open_rays, close_rays, BUMPY | OCCLUDED};
const bench_limit bench_limit_rays_bumpy_occluded_packet = {
    "rays-bumpy-occluded-packet", "Mray", 1e6, open_rays, close_rays, BUMPY | OCCLUDED | PACKET};
