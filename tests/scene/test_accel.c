/* Embree's tree of a mesh that lies there twice: which of two hits at one distance wins is the same by any
 * number of threads, whose work it divides where a part has some thousand triangles. */
#include "check.h"

#include <math.h>
#include <stdlib.h>

#include "scene/embree.h"

enum { SIDE = 160, RAYS = 20000 };

/* A rough square whose faces come twice. */
typedef struct twice {
    size_t vertices, triangles;
    float *positions;
    uint32_t *indices;
} twice;

static twice make_mesh(void) {
    twice mesh = {.vertices = (SIDE + 1) * (SIDE + 1), .triangles = 4 * SIDE * SIDE};
    mesh.positions = malloc((3 * mesh.vertices + 1) * sizeof *mesh.positions);
    mesh.indices = malloc(3 * mesh.triangles * sizeof *mesh.indices);
    assert_non_null(mesh.positions);
    assert_non_null(mesh.indices);
    for (size_t i = 0; i < mesh.vertices; ++i) {
        mesh.positions[3 * i] = (float)(i % (SIDE + 1)) / SIDE;
        mesh.positions[3 * i + 1] = (float)(i / (SIDE + 1)) / SIDE;
        mesh.positions[3 * i + 2] = 0.01f * sinf(12.9898f * (float)i);
    }
    for (size_t i = 0; i < 2 * SIDE * SIDE; ++i) {
        const size_t cell = i % (SIDE * SIDE);
        const uint32_t a = (uint32_t)(cell / SIDE * (SIDE + 1) + cell % SIDE), b = a + SIDE + 1;
        const uint32_t corners[6] = {a, a + 1, b + 1, a, b + 1, b};
        for (size_t k = 0; k < 6; ++k)
            mesh.indices[6 * i + k] = corners[k];
    }
    return mesh;
}

static void find_hits(const twice *mesh, const char *configuration, uint32_t *hits) {
    const RTCDevice device = rtcNewDevice(configuration);
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->positions, 0,
                               3 * sizeof(float), mesh->vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices, 0,
                               3 * sizeof(uint32_t), mesh->triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    for (size_t i = 0; i < RAYS; ++i) {
        struct RTCRayHit query = {.ray = {.org_x = fmodf(0.618034f * (float)i, 1.0f),
                                          .org_y = fmodf(0.754878f * (float)i, 1.0f),
                                          .org_z = 1.0f,
                                          .dir_z = -1.0f,
                                          .tfar = INFINITY,
                                          .mask = UINT32_MAX},
                                  .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        aur_embree_intersect1(scene, &query);
        hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? UINT32_MAX : query.hit.primID;
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

static void threads_decide_no_tie(void **state) {
    (void)state;
    twice mesh = make_mesh();
    uint32_t *const one = malloc(RAYS * sizeof *one), *const several = malloc(RAYS * sizeof *several);
    assert_non_null(one);
    assert_non_null(several);
    find_hits(&mesh, "threads=1", one);
    for (size_t k = 0; k < 3; ++k) {
        find_hits(&mesh, k == 0 ? "threads=2" : "threads=5", several);
        assert_memory_equal(one, several, RAYS * sizeof *one);
    }
    free(one);
    free(several);
    free(mesh.positions);
    free(mesh.indices);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_decide_no_tie)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
