/* Embree's trees with duplicate primitives: of two hits at one distance, the same one wins for any number of
 * threads, which share the work if a part has some thousand primitives. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/scene/scene.h"
#include "render/trace/embree.h"

enum { SIDE = 160, RAYS = 20000 };

/* A rough square of vertices and their radii. */
static float *make_points(void) {
    float *const points = malloc(((size_t)(SIDE + 1) * (SIDE + 1) + 1) * 4 * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < (SIDE + 1) * (SIDE + 1); ++i) {
        points[4 * i] = (float)(i % (SIDE + 1)) / SIDE;
        points[4 * i + 1] = (float)(i / (SIDE + 1)) / SIDE;
        points[4 * i + 2] = 0.01f * sinf(12.9898f * (float)i);
        points[4 * i + 3] = 0.4f / SIDE;
    }
    return points;
}

/* Attaches a buffer of indices, retained by Embree. */
static uint32_t *make_indices(RTCGeometry geometry, enum RTCFormat format, size_t each, size_t count) {
    uint32_t *const indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format, each * sizeof(uint32_t), count);
    assert_non_null(indices);
    return indices;
}

static void attach(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

/* Each face twice. */
static void add_triangles(RTCDevice device, RTCScene scene, float *points) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, points, 0,
                               4 * sizeof(float), (SIDE + 1) * (SIDE + 1));
    uint32_t *const indices = make_indices(geometry, RTC_FORMAT_UINT3, 3, 4 * SIDE * SIDE);
    for (size_t i = 0; i < 2 * SIDE * SIDE; ++i) {
        const size_t cell = i % (SIDE * SIDE);
        const uint32_t a = (uint32_t)(cell / SIDE * (SIDE + 1) + cell % SIDE), b = a + SIDE + 1;
        const uint32_t corners[6] = {a, a + 1, b + 1, a, b + 1, b};
        for (size_t k = 0; k < 6; ++k)
            indices[6 * i + k] = corners[k];
    }
    attach(scene, geometry);
}

/* A curve from each point in each row, twice. */
static void add_curves(RTCDevice device, RTCScene scene, float *points, enum RTCGeometryType type,
                       size_t length) {
    const RTCGeometry geometry = rtcNewGeometry(device, type);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, points, 0,
                               4 * sizeof(float), (SIDE + 1) * (SIDE + 1));
    const size_t each_row = SIDE + 2 - length, count = each_row * (SIDE + 1);
    uint32_t *const indices = make_indices(geometry, RTC_FORMAT_UINT, 1, 2 * count);
    for (size_t i = 0; i < 2 * count; ++i)
        indices[i] = (uint32_t)(i % count / each_row * (SIDE + 1) + i % count % each_row);
    attach(scene, geometry);
}

static void add_cones(RTCDevice device, RTCScene scene, float *points) {
    add_curves(device, scene, points, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, 2);
}

static void add_splines(RTCDevice device, RTCScene scene, float *points) {
    add_curves(device, scene, points, RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE, 4);
}

/* --- balls by user-geometry callbacks, each a separate geometry like a scene's curved shapes */

static void find_bounds(const struct RTCBoundsFunctionArguments *arguments) {
    const float *const ball = arguments->geometryUserPtr;
    *arguments->bounds_o = (struct RTCBounds){.lower_x = ball[0] - ball[3],
                                              .lower_y = ball[1] - ball[3],
                                              .lower_z = ball[2] - ball[3],
                                              .upper_x = ball[0] + ball[3],
                                              .upper_y = ball[1] + ball[3],
                                              .upper_z = ball[2] + ball[3]};
}

/* Single rays, vertically from above. */
static void find_ball(const struct RTCIntersectFunctionNArguments *arguments) {
    const float *const ball = arguments->geometryUserPtr;
    struct RTCRayHit *const query = (struct RTCRayHit *)arguments->rayhit;
    assert_int_equal(arguments->N, 1);
    const float x = query->ray.org_x - ball[0], y = query->ray.org_y - ball[1];
    const float squared = ball[3] * ball[3] - x * x - y * y;
    const float distance = query->ray.org_z - ball[2] - sqrtf(fmaxf(squared, 0.0f));
    if (arguments->valid[0] == 0 || squared < 0.0f || distance > query->ray.tfar)
        return;
    query->ray.tfar = distance;
    query->hit.geomID = arguments->geomID;
    query->hit.primID = arguments->primID;
}

static void add_balls(RTCDevice device, RTCScene scene, float *points) {
    for (size_t i = 0; i < 2 * SIDE * SIDE; ++i) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, &points[4 * (i % (SIDE * SIDE))]);
        rtcSetGeometryBoundsFunction(geometry, find_bounds, NULL);
        rtcSetGeometryIntersectFunction(geometry, find_ball);
        attach(scene, geometry);
    }
}

typedef void add_function(RTCDevice device, RTCScene scene, float *points);

/* The hit of each ray, and the number of hits. */
static size_t find_hits(add_function *add, float *points, const char *configuration, uint32_t (*hits)[2]) {
    const RTCDevice device = rtcNewDevice(configuration);
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    add(device, scene, points);
    rtcCommitScene(scene);
    size_t count = 0;
    for (size_t i = 0; i < RAYS; ++i) {
        struct RTCRayHit query = {.ray = {.org_x = fmodf(0.618034f * (float)i, 1.0f),
                                          .org_y = fmodf(0.754878f * (float)i, 1.0f),
                                          .org_z = 1.0f,
                                          .dir_z = -1.0f,
                                          .tfar = INFINITY,
                                          .mask = UINT32_MAX},
                                  .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        aur_embree_intersect1(scene, &query);
        const bool met = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        hits[i][0] = met ? query.hit.geomID : UINT32_MAX;
        hits[i][1] = met ? query.hit.primID : UINT32_MAX;
        count += met;
    }
    assert_int_equal(rtcGetDeviceError(device), RTC_ERROR_NONE);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return count;
}

static void threads_decide_no_tie(void **state) {
    add_function *const add = *(add_function **)*state;
    float *const points = make_points();
    uint32_t(*const one)[2] = malloc(RAYS * sizeof *one),
                    (*const several)[2] = malloc(RAYS * sizeof *several);
    assert_non_null(one);
    assert_non_null(several);
    assert_true(find_hits(add, points, "threads=1", one) > RAYS / 3);
    for (size_t k = 0; k < 3; ++k) {
        find_hits(add, points, k == 0 ? "threads=2" : "threads=5", several);
        assert_memory_equal(one, several, RAYS * sizeof *one);
    }
    free(one);
    free(several);
    free(points);
}

/* The requested threads build large trees, and never more. */
static void threads_are_bounded(void **state) {
    (void)state;
    static const struct {
        size_t primitives, threads;
        const char *start;
    } rows[] = {
        {100, 3, "threads=1"}, {100, 0, "threads=1"}, {1 << 20, 3, "threads=3"}, {1 << 20, 1, "threads=1"}};
    char text[AUR_EMBREE_CONFIGURATION_CAPACITY];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_embree_configuration(rows[i].primitives, rows[i].threads, text);
        const size_t length = strlen(rows[i].start);
        assert_true(strncmp(text, rows[i].start, length) == 0 &&
                    (text[length] == '\0' || text[length] == ','));
    }
    aur_embree_configuration(1 << 20, 0, text);
    assert_null(strstr(text, "threads"));
    assert_null(strstr(text, "hugepages"));
    aur_embree_configuration(100, 0, text);
    assert_non_null(strstr(text, "hugepages=0"));
}

int main(void) {
    static add_function *kinds[] = {add_triangles, add_balls, add_cones, add_splines};
    const struct CMUnitTest tests[] = {
        {"triangles", threads_decide_no_tie, NULL, NULL, &kinds[0]},
        {"balls", threads_decide_no_tie, NULL, NULL, &kinds[1]},
        {"cones", threads_decide_no_tie, NULL, NULL, &kinds[2]},
        {"splines", threads_decide_no_tie, NULL, NULL, &kinds[3]},
        cmocka_unit_test(threads_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
