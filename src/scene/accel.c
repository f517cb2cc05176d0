/* Rays against the scene, by Embree. */
#include <stdlib.h>

#include "scene/embree.h"
#include "scene/scene_data.h"

static aur_result fail(const aur_scene *scene, aur_error *error) {
    const enum RTCError code =
        scene->device != NULL ? rtcGetDeviceError(scene->device) : rtcGetDeviceError(NULL);
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory while building the ray-tracing structure");
    return aur_fail(error, AUR_ERROR_INTERNAL, "Embree failed with error %d", (int)code);
}

static bool attach_mesh(aur_scene *scene, const aur_shape *shape, uint32_t id) {
    const aur_mesh *const mesh = &shape->mesh;
    const RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (geometry == NULL)
        return false;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->positions, 0,
                               3 * sizeof(float), mesh->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices, 0,
                               3 * sizeof(uint32_t), mesh->triangle_count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene->accel, geometry, id);
    rtcReleaseGeometry(geometry);
    return true;
}

aur_result aur_scene_build_accel(aur_scene *scene, aur_error *error) {
    /* One thread builds the same tree each time: with it, which of two hits at one distance wins is settled.
     */
    scene->device = rtcNewDevice("threads=1");
    if (scene->device == NULL)
        return fail(scene, error);
    scene->accel = rtcNewScene(scene->device);
    if (scene->accel == NULL)
        return fail(scene, error);
    /* Robust traversal leaves no gaps between triangles that share an edge: closed rooms stay closed. */
    rtcSetSceneFlags(scene->accel, RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; i < scene->shape_count; ++i)
        if (!attach_mesh(scene, scene->shapes[i], (uint32_t)i))
            return fail(scene, error);
    rtcCommitScene(scene->accel);
    const enum RTCError code = rtcGetDeviceError(scene->device);
    if (code != RTC_ERROR_NONE)
        return aur_fail(error, code == RTC_ERROR_OUT_OF_MEMORY ? AUR_ERROR_MEMORY : AUR_ERROR_INTERNAL,
                        "the ray-tracing structure cannot be built (Embree error %d)", (int)code);
    struct RTCBounds bounds;
    rtcGetSceneBounds(scene->accel, &bounds);
    scene->lower = (aur_vector){bounds.lower_x, bounds.lower_y, bounds.lower_z};
    scene->upper = (aur_vector){bounds.upper_x, bounds.upper_y, bounds.upper_z};
    if (scene->shape_count == 0)
        scene->lower = scene->upper = (aur_vector){0.0f, 0.0f, 0.0f};
    return AUR_OK;
}

void aur_scene_release_accel(aur_scene *scene) {
    if (scene->accel != NULL)
        rtcReleaseScene(scene->accel);
    if (scene->device != NULL)
        rtcReleaseDevice(scene->device);
}

static inline void fill_ray(const aur_ray *ray, struct RTCRay *query) {
    *query = (struct RTCRay){.org_x = ray->origin.x,
                             .org_y = ray->origin.y,
                             .org_z = ray->origin.z,
                             .tnear = ray->nearest,
                             .dir_x = ray->direction.x,
                             .dir_y = ray->direction.y,
                             .dir_z = ray->direction.z,
                             .tfar = ray->farthest,
                             .mask = UINT32_MAX};
}

bool aur_scene_intersect(const aur_scene *scene, const aur_ray *ray, aur_hit *hit) {
    struct RTCRayHit query;
    fill_ray(ray, &query.ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    aur_embree_intersect1(scene->accel, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    *hit = (aur_hit){query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID};
    return true;
}

bool aur_scene_occluded(const aur_scene *scene, const aur_ray *ray) {
    struct RTCRay query;
    fill_ray(ray, &query);
    aur_embree_occluded1(scene->accel, &query);
    return query.tfar < 0.0f;
}
