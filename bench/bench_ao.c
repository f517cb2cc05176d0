/* Ambient occlusion against Embree alone on the same stored packets of 16 rays: the overhead of finding
 * shading points and generating rays. On the glossy Cornell box, and on the ambient-occlusion scene where its
 * meshes have been generated. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench.h"
#include "render/film/integrator.h"
#include "render/occlusion/rays.h"

enum { SIDE = 128, TILES = SIDE / AUR_TILE_SIZE * (SIDE / AUR_TILE_SIZE), SAMPLES = 64 };

/* Sixteen rays, in packets of the SIMD width. A packet is an array of rows, in the order of struct RTCRay16.
 */
enum { ROWS = sizeof(struct RTCRay16) / sizeof(float[AUR_PACKET_SIZE]), TFAR = 8 };

typedef struct stored_packet {
    _Alignas(64) int valid[AUR_PACKET_SIZE];
    _Alignas(64) float rows[ROWS * AUR_PACKET_SIZE];
    aur_embree_order order;
} stored_packet;

typedef struct occlusion_bench {
    const aur_integrator *integrator;
    const aur_view *view;
    size_t size; /* rays per packet */
    float farthest;
    size_t packet_count, ray_count;
    stored_packet *packets;
    double sums[3 * AUR_TILE_SIZE * AUR_TILE_SIZE];
    uint32_t counts[AUR_TILE_SIZE * AUR_TILE_SIZE];
} occlusion_bench;

static void tile_corner(size_t index, size_t *x, size_t *y) {
    *x = index % (SIDE / AUR_TILE_SIZE) * AUR_TILE_SIZE;
    *y = index / (SIDE / AUR_TILE_SIZE) * AUR_TILE_SIZE;
}

static aur_result render(void *data, size_t unused) {
    (void)unused;
    occlusion_bench *const self = data;
    for (size_t i = 0; i < TILES; ++i) {
        aur_tile tile = {.view = self->view,
                         .count = 1,
                         .stride = AUR_TILE_SIZE,
                         .channel_count = 3,
                         .sums = self->sums,
                         .counts = self->counts};
        tile_corner(i, &tile.x0, &tile.y0);
        tile.x1 = tile.x0 + AUR_TILE_SIZE;
        tile.y1 = tile.y0 + AUR_TILE_SIZE;
        const aur_result result = self->integrator->descriptor->tile(self->integrator, &tile);
        if (result != AUR_OK)
            return result;
        bench_keep(self->sums[0]);
    }
    return AUR_OK;
}

static aur_result trace(void *data, size_t unused) {
    (void)unused;
    occlusion_bench *const self = data;
    size_t stopped = 0;
    for (size_t i = 0; i < self->packet_count; ++i) {
        stored_packet *const packet = &self->packets[i];
        for (size_t first = 0; first < AUR_PACKET_SIZE; first += self->size) {
            float *const rows = packet->rows + ROWS * first, *const farthest = rows + TFAR * self->size;
            for (size_t k = 0; k < self->size; ++k)
                farthest[k] = self->farthest;
            aur_embree_occluded_packet(aur_scene_embree(self->view->scene), packet->order, self->size,
                                       packet->valid + first, rows);
            for (size_t k = 0; k < self->size; ++k)
                stopped += packet->valid[first + k] != 0 && farthest[k] < 0.0f;
        }
    }
    bench_keep((double)stopped);
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the renderer. */
static void run_render(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, render, context, NULL);
}

static void run_trace(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, trace, context, NULL);
}

static void store(void *context, size_t first, aur_embree_order order, aur_packet *packet) {
    (void)first;
    occlusion_bench *const self = context;
    stored_packet *const stored = &self->packets[self->packet_count++];
    memcpy(stored->valid, packet->valid, sizeof stored->valid);
    for (size_t at = 0; at < AUR_PACKET_SIZE; at += self->size)
        for (size_t row = 0; row < ROWS; ++row)
            memcpy(stored->rows + ROWS * at + row * self->size,
                   (const char *)&packet->query.ray + (row * AUR_PACKET_SIZE + at) * sizeof(float),
                   self->size * sizeof(float));
    stored->order = order;
    self->farthest = packet->query.ray.tfar[0];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        self->ray_count += packet->valid[k] != 0;
}

static void store_all(occlusion_bench *self) {
    aur_occlusion_points points = {0};
    for (size_t i = 0; i < TILES; ++i) {
        size_t x, y;
        tile_corner(i, &x, &y);
        aur_occlusion_find_points(self->view, x, y, 0, &points);
        aur_occlusion_visit(self->integrator->data, &points, x, y, 0, store, self);
    }
}

static bool compare(const bench_options *options, const char *name, const aur_scene *scene,
                    const aur_integrator *integrator) {
    aur_sampler *sampler;
    if (aur_sampler_create("sobol", 1, NULL, &sampler, NULL) != AUR_OK)
        return bench_fail("out of memory");
    const aur_view view = {
        .scene = scene, .sampler = sampler, .filter = aur_filter_find("box"), .width = SIDE, .height = SIDE};
    occlusion_bench context = {.integrator = integrator,
                               .view = &view,
                               .size = aur_embree_scene_packet_size(aur_scene_embree(scene))};
    if (context.size == 0) {
        aur_sampler_destroy(sampler);
        return bench_fail("this Embree is built without packets");
    }
    const size_t most = (size_t)SIDE * SIDE * SAMPLES / AUR_PACKET_SIZE;
    context.packets = aligned_alloc(_Alignof(stored_packet), most * sizeof *context.packets);
    if (context.packets == NULL) {
        aur_sampler_destroy(sampler);
        return bench_fail("out of memory");
    }
    store_all(&context);
    const bench_work ours = {run_render, &context, (double)context.ray_count};
    const bench_work bare = {run_trace, &context, (double)context.ray_count};
    const bench_pair pair = bench_compare(options, &ours, &bare);
    bench_print_pair(name, "Embree, the same packets", "Mray", 1e6, &pair);
    free(context.packets);
    aur_sampler_destroy(sampler);
    return true;
}

static bool bench_one(const bench_options *options, const char *name, const char *path) {
    aur_error error;
    aur_scene *scene = NULL;
    if (aur_scene_load(path, NULL, &scene, &error) != AUR_OK)
        return bench_fail("%s: %s", error.file, error.message);
    const aur_integrator_context context = {.scene = scene, .samples_per_pixel = 1};
    aur_parameters parameters;
    aur_integrator *integrator = NULL;
    bool good = aur_parameters_parse(&parameters, "integrator", "ao:samples=64", &error) == AUR_OK;
    if (good) {
        good = aur_integrator_create(&parameters, &context, &integrator, &error) == AUR_OK;
        aur_parameters_release(&parameters);
    }
    good = good ? compare(options, name, scene, integrator) : bench_fail("%s", error.message);
    aur_integrator_destroy(integrator);
    aur_scene_destroy(scene);
    return good;
}

static bool run(const bench_options *options) {
    if (!bench_one(options, "glossy Cornell box", AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml"))
        return false;
    if (access(AUR_SOURCE_DIR "/scenes/generated/temple.ply", R_OK) != 0 || options->quick)
        return true;
    return bench_one(options, "figure among columns", AUR_SOURCE_DIR "/scenes/occlusion/occlusion.xml");
}

const bench bench_ao = {"ao", "ambient occlusion against Embree on the same packets", run};
