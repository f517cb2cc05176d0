/* A large mesh: a wavy square. */
#include "grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "render/scene/scene.h"
#include "render/trace/embree.h"

/* Rounded so that 6 decimal digits reproduce the mesh. */
static float rounded(double x) {
    return (float)(floor(x * 1e5 + 0.5) * 1e-5);
}

bool bench_grid_create(bench_grid *g, size_t side) {
    *g = (bench_grid){
        .side = side, .vertex_count = (side + 1) * (side + 1), .triangle_count = 2 * side * side};
    g->positions = malloc((3 * g->vertex_count + 1) * sizeof *g->positions);
    g->indices = malloc(3 * g->triangle_count * sizeof *g->indices);
    if (g->positions == NULL || g->indices == NULL)
        return bench_fail("out of memory");
    for (size_t i = 0; i < g->vertex_count; ++i) {
        const double x = (double)(i % (side + 1)) / (double)side, y = (double)(i / (side + 1)) / (double)side;
        const double position[3] = {x, y, 0.05 * sin(40.0 * x) * sin(40.0 * y)};
        for (size_t k = 0; k < 3; ++k)
            g->positions[3 * i + k] = rounded(position[k]);
    }
    for (size_t i = 0; i < side * side; ++i) {
        const uint32_t a = (uint32_t)(i / side * (side + 1) + i % side), b = a + (uint32_t)side + 1;
        const uint32_t quad[6] = {a, a + 1, b + 1, a, b + 1, b};
        memcpy(&g->indices[6 * i], quad, sizeof quad);
    }
    return true;
}

void bench_grid_release(bench_grid *g) {
    free(g->positions);
    free(g->indices);
}

void bench_grid_write_ply(const bench_grid *g, FILE *file) {
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
            "property float z\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            g->vertex_count, g->triangle_count);
    fwrite(g->positions, 3 * sizeof(float), g->vertex_count, file);
    for (size_t i = 0; i < g->triangle_count; ++i) {
        fputc(3, file);
        fwrite(&g->indices[3 * i], sizeof(uint32_t), 3, file);
    }
}

void bench_grid_build(const bench_grid *g) {
    char configuration[AUR_EMBREE_CONFIGURATION_CAPACITY];
    aur_embree_configuration(g->triangle_count, 0, configuration);
    const RTCDevice device = rtcNewDevice(configuration);
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, g->positions, 0,
                               3 * sizeof(float), g->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, g->indices, 0,
                               3 * sizeof(uint32_t), g->triangle_count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
