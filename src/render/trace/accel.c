/* Rays against the scene, by Embree. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/simd.h"
#include "render/scene/scene_data.h"
#include "render/trace/embree.h"

static aur_result fail(const aur_scene *scene, enum RTCError code, aur_error *error) {
    if (code == RTC_ERROR_NONE)
        code = rtcGetDeviceError(scene->device); /* without a device, the last error of this thread */
    return aur_fail(error, code == RTC_ERROR_OUT_OF_MEMORY ? AUR_ERROR_MEMORY : AUR_ERROR_INTERNAL,
                    "the ray-tracing structure cannot be built (Embree error %d)", (int)code);
}

static bool attach(aur_embree_scene to, RTCGeometry geometry, size_t id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, (uint32_t)id);
    rtcReleaseGeometry(geometry);
    return true;
}

static bool attach_mesh(aur_scene *scene, aur_embree_scene to, const aur_shape *shape, uint32_t id) {
    const aur_mesh *const mesh = &shape->mesh;
    if (mesh->triangle_count == 0)
        return true;
    const RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (geometry == NULL)
        return false;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->positions, 0,
                               3 * sizeof(float), mesh->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices, 0,
                               3 * sizeof(uint32_t), mesh->triangle_count);
    return attach(to, geometry, id);
}

/* --- shapes that are not meshes: Embree's callbacks */

static void curved_bounds(const struct RTCBoundsFunctionArguments *arguments) {
    const aur_shape *const shape = arguments->geometryUserPtr;
    double lower[3], upper[3];
    shape->curved->bounds(shape, arguments->primID, lower, upper);
    struct RTCBounds *const bounds = arguments->bounds_o;
    /* Bounds are widened by more than the rounding to float can narrow them. */
    float low[3], high[3];
    for (size_t i = 0; i < 3; ++i) {
        const double slack = 1e-6 * fmax(fabs(lower[i]), fabs(upper[i]));
        low[i] = (float)(lower[i] - slack);
        high[i] = (float)(upper[i] + slack);
    }
    bounds->lower_x = low[0];
    bounds->lower_y = low[1];
    bounds->lower_z = low[2];
    bounds->upper_x = high[0];
    bounds->upper_y = high[1];
    bounds->upper_z = high[2];
}

/* Packets of N rays are arrays of N per field; Embree's accessors for them are C++ only. */
enum { RAY_ORIGIN = 0, RAY_NEAREST = 3, RAY_DIRECTION = 4, RAY_FARTHEST = 8, RAY_FIELDS = 12 };
enum { HIT_NORMAL = 0, HIT_U = 3, HIT_V = 4, HIT_PRIMITIVE = 5, HIT_GEOMETRY = 6, HIT_INSTANCE = 7 };

static bool curved_hit(const aur_shape *shape, const float *rays, size_t n, size_t i, float *distance) {
    double origin[3], direction[3];
    for (size_t k = 0; k < 3; ++k) {
        origin[k] = rays[(RAY_ORIGIN + k) * n + i];
        direction[k] = rays[(RAY_DIRECTION + k) * n + i];
    }
    double t;
    if (!shape->curved->intersect(shape, origin, direction, rays[RAY_NEAREST * n + i],
                                  rays[RAY_FARTHEST * n + i], &t))
        return false;
    *distance = (float)t;
    return true;
}

static void curved_intersect(const struct RTCIntersectFunctionNArguments *arguments) {
    const size_t n = arguments->N;
    float *const rays = (float *)arguments->rayhit;
    float *const hits = rays + RAY_FIELDS * n;
    uint32_t *const ids = (uint32_t *)hits;
    for (size_t i = 0; i < n; ++i) {
        float distance;
        if (arguments->valid[i] == 0 || !curved_hit(arguments->geometryUserPtr, rays, n, i, &distance))
            continue;
        rays[RAY_FARTHEST * n + i] = distance;
        hits[HIT_U * n + i] = 0.0f;
        hits[HIT_V * n + i] = 0.0f;
        ids[HIT_PRIMITIVE * n + i] = arguments->primID;
        ids[HIT_GEOMETRY * n + i] = arguments->geomID;
        ids[HIT_INSTANCE * n + i] = arguments->context->instID[0];
    }
}

static void curved_occluded(const struct RTCOccludedFunctionNArguments *arguments) {
    const size_t n = arguments->N;
    float *const rays = (float *)arguments->ray;
    float distance;
    for (size_t i = 0; i < n; ++i)
        if (arguments->valid[i] != 0 && curved_hit(arguments->geometryUserPtr, rays, n, i, &distance))
            rays[RAY_FARTHEST * n + i] = -INFINITY;
}

static bool attach_curved(aur_scene *scene, aur_embree_scene to, aur_shape *shape, uint32_t id) {
    const RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_USER);
    if (geometry == NULL)
        return false;
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, shape);
    rtcSetGeometryBoundsFunction(geometry, curved_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, curved_intersect);
    rtcSetGeometryOccludedFunction(geometry, curved_occluded);
    return attach(to, geometry, id);
}

/* Curves are visible from outside only: a ray that leaves a curve does not hit it again, and through the open
 * end of a spline one sees the background. Some builds of Embree do this themselves. */
static void refuse_inside(const struct RTCFilterFunctionNArguments *arguments) {
    const size_t n = arguments->N;
    const float *const rays = (const float *)arguments->ray, *const hits = (const float *)arguments->hit;
    for (size_t i = 0; i < n; ++i) {
        float along = 0.0f;
        for (size_t k = 0; k < 3; ++k)
            along += rays[(RAY_DIRECTION + k) * n + i] * hits[(HIT_NORMAL + k) * n + i];
        if (along > 0.0f)
            arguments->valid[i] = 0;
    }
}

static bool attach_curves(aur_scene *scene, aur_embree_scene to, const aur_shape *shape, uint32_t id) {
    const aur_curves *const curves = &shape->curves;
    const RTCGeometry geometry =
        rtcNewGeometry(scene->device, curves->smooth ? RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE
                                                     : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    if (geometry == NULL)
        return false;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, curves->points, 0,
                               4 * sizeof(float), curves->point_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves->firsts, 0,
                               sizeof(uint32_t), curves->segment_count);
    rtcSetGeometryIntersectFilterFunction(geometry, refuse_inside);
    rtcSetGeometryOccludedFilterFunction(geometry, refuse_inside);
    return attach(to, geometry, id);
}

static bool attach_shape(aur_scene *scene, aur_embree_scene to, uint32_t id) {
    aur_shape *const shape = scene->shapes[id];
    if (shape->curves.segment_count != 0)
        return attach_curves(scene, to, shape, id);
    return shape->curved != NULL ? attach_curved(scene, to, shape, id) : attach_mesh(scene, to, shape, id);
}

static aur_embree_scene new_scene(const aur_scene *scene) {
    const aur_embree_scene created = rtcNewScene(scene->device);
    /* Robust traversal leaves no gaps between triangles that share an edge: closed rooms stay closed. */
    if (created != NULL)
        rtcSetSceneFlags(created, RTC_SCENE_FLAG_ROBUST);
    return created;
}

static bool build_group(aur_scene *scene, aur_shape_group *group) {
    group->accel = new_scene(scene);
    for (size_t i = 0; group->accel != NULL && i < group->count; ++i)
        if (!attach_shape(scene, group->accel, group->shapes[i]))
            return false;
    if (group->accel != NULL)
        rtcCommitScene(group->accel);
    return group->accel != NULL;
}

/* Instances are numbered after the shapes. */
static bool attach_instance(aur_scene *scene, size_t index) {
    const aur_instance *const instance = scene->instances[index];
    const RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_INSTANCE);
    if (geometry == NULL)
        return false;
    float matrix[12];
    for (size_t i = 0; i < 12; ++i)
        matrix[i] = (float)instance->to_world.m[i];
    rtcSetGeometryInstancedScene(geometry, instance->group->accel);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, matrix);
    return attach(scene->accel, geometry, scene->shape_count + index);
}

static bool attach_all(aur_scene *scene) {
    bool good = true;
    for (size_t i = 0; good && i < scene->group_count; ++i)
        good = build_group(scene, scene->groups[i]);
    for (size_t i = 0; good && i < scene->shape_count; ++i)
        if (!scene->shapes[i]->grouped)
            good = attach_shape(scene, scene->accel, (uint32_t)i);
    for (size_t i = 0; good && i < scene->instance_count; ++i)
        good = attach_instance(scene, i);
    return good;
}

/* The tree does not depend on the number of threads: Embree sorts the primitives of each leaf after dividing
 * them in parallel. So ties between hits at one distance are deterministic (tests/render/trace/test_accel.c).
 * Small trees are not worth the threads. Few triangles are not worth asking the system for huge pages, which
 * takes as long as building a tree of 200 triangles. Embree also obeys AUREOLE_ISA, so that a test on one
 * machine can run the kernels of others. */
void aur_embree_configuration(size_t primitives, size_t threads,
                              char text[AUR_EMBREE_CONFIGURATION_CAPACITY]) {
    enum { FEW = 1 << 15, MANY = 1 << 20 };
    static const char *const isa[] = {
        [AUR_ISA_PORTABLE] = "isa=sse2", [AUR_ISA_AVX2] = "isa=avx2", [AUR_ISA_AVX512] = ""};
    const char *const kernels = isa[aur_isa_of_rays()];
    const size_t workers = primitives < MANY ? 1 : threads;
    if (workers == 0)
        snprintf(text, AUR_EMBREE_CONFIGURATION_CAPACITY, "%s", kernels);
    else
        snprintf(text, AUR_EMBREE_CONFIGURATION_CAPACITY, "threads=%zu%s%s%s", workers,
                 primitives < FEW ? ",hugepages=0" : "", *kernels != '\0' ? "," : "", kernels);
}

aur_result aur_scene_build_accel(aur_scene *scene, size_t threads, aur_error *error) {
    size_t primitives = 0;
    char configuration[AUR_EMBREE_CONFIGURATION_CAPACITY];
    for (size_t i = 0; i < scene->shape_count; ++i)
        primitives += aur_shape_primitives(scene->shapes[i]);
    aur_embree_configuration(primitives, threads, configuration);
    scene->device = rtcNewDevice(configuration);
    scene->accel = scene->device != NULL ? new_scene(scene) : NULL;
    if (scene->accel == NULL || !attach_all(scene))
        return fail(scene, RTC_ERROR_NONE, error);
    scene->packet_size = aur_embree_packet_size(scene->device);
    rtcCommitScene(scene->accel);
    const enum RTCError code = rtcGetDeviceError(scene->device);
    if (code != RTC_ERROR_NONE)
        return fail(scene, code, error);
    struct RTCBounds bounds;
    rtcGetSceneBounds(scene->accel, &bounds);
    scene->lower = (aur_vector){bounds.lower_x, bounds.lower_y, bounds.lower_z};
    scene->upper = (aur_vector){bounds.upper_x, bounds.upper_y, bounds.upper_z};
    if (!(scene->lower.x <= scene->upper.x)) /* empty scene */
        scene->lower = scene->upper = (aur_vector){0.0f, 0.0f, 0.0f};
    return AUR_OK;
}

void aur_scene_describe_tracer(const aur_scene *scene, size_t capacity, char *text) {
    const ssize_t version = rtcGetDeviceProperty(scene->device, RTC_DEVICE_PROPERTY_VERSION);
    snprintf(text, capacity, "Embree %zd.%zd.%zd, instructions %s, packets of %zu", version / 10000,
             version / 100 % 100, version % 100, aur_isa_name(aur_isa_of_rays()), scene->packet_size);
}

void aur_scene_release_accel(aur_scene *scene) {
    for (size_t i = 0; i < scene->group_count; ++i)
        if (scene->groups[i]->accel != NULL)
            rtcReleaseScene(scene->groups[i]->accel);
    if (scene->accel != NULL)
        rtcReleaseScene(scene->accel);
    if (scene->device != NULL)
        rtcReleaseDevice(scene->device);
}

/* A ray is written sixteen bytes at a time, as Embree reads it: a load that spans several smaller stores
 * would stall. */
typedef float four __attribute__((vector_size(16)));

static inline void fill_ray(const aur_ray *ray, struct RTCRay *query) {
    const four from = {ray->origin.x, ray->origin.y, ray->origin.z, ray->nearest};
    const four along = {ray->direction.x, ray->direction.y, ray->direction.z, 0.0f};
    memcpy(&query->org_x, &from, sizeof from);
    memcpy(&query->dir_x, &along, sizeof along);
    query->tfar = ray->farthest;
    query->mask = UINT32_MAX;
    query->id = query->flags = 0;
}

bool aur_scene_intersect(const aur_scene *scene, const aur_ray *ray, aur_hit *hit) {
    struct RTCRayHit query;
    fill_ray(ray, &query.ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    aur_embree_intersect1(scene->accel, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    const uint32_t instance = query.hit.instID[0] == RTC_INVALID_GEOMETRY_ID
                                  ? AUR_NO_INSTANCE
                                  : query.hit.instID[0] - (uint32_t)scene->shape_count;
    *hit = (aur_hit){query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID, instance};
    return true;
}

bool aur_scene_occluded(const aur_scene *scene, const aur_ray *ray) {
    struct RTCRay query;
    fill_ray(ray, &query);
    aur_embree_occluded1(scene->accel, &query);
    return query.tfar < 0.0f;
}

typedef struct near_query {
    void (*found)(void *context, const aur_hit *hit);
    void *context;
    uint32_t shapes; /* instances are numbered after them */
} near_query;

static bool take_near(struct RTCPointQueryFunctionArguments *arguments) {
    const near_query *const query = arguments->userPtr;
    const aur_hit hit = {.shape = arguments->geomID,
                         .primitive = arguments->primID,
                         .instance = arguments->context->instStackSize == 0
                                         ? AUR_NO_INSTANCE
                                         : arguments->context->instID[0] - query->shapes};
    query->found(query->context, &hit);
    return false;
}

void aur_scene_near(const aur_scene *scene, aur_vector point, float radius,
                    void (*found)(void *context, const aur_hit *hit), void *context) {
    near_query near = {found, context, (uint32_t)scene->shape_count};
    struct RTCPointQuery query = {.x = point.x, .y = point.y, .z = point.z, .radius = radius};
    struct RTCPointQueryContext stack;
    rtcInitPointQueryContext(&stack);
    rtcPointQuery(scene->accel, &query, &stack, take_near, &near);
}
