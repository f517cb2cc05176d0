/* One interface for Embree 3 and 4. Version 4 renamed the query context and moved it to an optional last
 * argument; nothing else that Aureole uses differs. FindEmbree.cmake sets AUR_EMBREE_VERSION. */
#pragma once

#include <stddef.h>

#include "points/base/parallel.h"

#if AUR_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/* Packets have 4, 8 or 16 rays, up to the width of the processor's registers. Embree traces larger ones as a
 * ray stream, which takes twice the time of single rays, and includes inactive rays. 0 if Embree is built
 * without packets. */
static inline size_t aur_embree_packet_size(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0)
        return 16;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0)
        return 8;
    return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) != 0 ? 4 : 0;
}

/* The same for the device of a scene; Embree returns a reference that must be released. */
static inline size_t aur_embree_scene_packet_size(RTCScene scene) {
    const RTCDevice device = rtcGetSceneDevice(scene);
    const size_t size = aur_embree_packet_size(device);
    rtcReleaseDevice(device);
    return size;
}

/* Coherence of a packet's rays. Coherent: nearby origins and directions. The flag halves the speed of
 * incoherent rays. */
typedef enum aur_embree_order { AUR_EMBREE_INCOHERENT, AUR_EMBREE_COHERENT } aur_embree_order;

/* All rays are counted here, where they are traced (points/base/parallel.h). */
static inline void aur_embree_count_packet(size_t size, const int *valid) {
    int there = 0;
    for (size_t k = 0; k < size; ++k)
        there -= valid[k];
    aur_rays_traced += (uint64_t)there;
}

#if AUR_EMBREE_VERSION >= 4

static inline struct RTCIntersectArguments aur_embree_intersect_arguments(aur_embree_order order) {
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    if (order == AUR_EMBREE_COHERENT)
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    return arguments;
}

static inline struct RTCOccludedArguments aur_embree_occluded_arguments(aur_embree_order order) {
    struct RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    if (order == AUR_EMBREE_COHERENT)
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    return arguments;
}

static inline void aur_embree_intersect1(RTCScene scene, struct RTCRayHit *ray) {
    ++aur_rays_traced;
    rtcIntersect1(scene, ray, NULL);
}

/* `rays` is a struct RTCRayHit4, RTCRayHit8 or RTCRayHit16; valid[size] is -1 for the rays that are there and
 * 0 for the others. */
static inline void aur_embree_intersect_packet(RTCScene scene, aur_embree_order order, size_t size,
                                               const int *valid, void *rays) {
    aur_embree_count_packet(size, valid);
    struct RTCIntersectArguments arguments = aur_embree_intersect_arguments(order);
    if (size == 16)
        rtcIntersect16(valid, scene, rays, &arguments);
    else if (size == 8)
        rtcIntersect8(valid, scene, rays, &arguments);
    else
        rtcIntersect4(valid, scene, rays, &arguments);
}

/* Sets ray->tfar to minus infinity when anything is hit. */
static inline void aur_embree_occluded1(RTCScene scene, struct RTCRay *ray) {
    ++aur_rays_traced;
    rtcOccluded1(scene, ray, NULL);
}

static inline void aur_embree_occluded_packet(RTCScene scene, aur_embree_order order, size_t size,
                                              const int *valid, void *rays) {
    aur_embree_count_packet(size, valid);
    struct RTCOccludedArguments arguments = aur_embree_occluded_arguments(order);
    if (size == 16)
        rtcOccluded16(valid, scene, rays, &arguments);
    else if (size == 8)
        rtcOccluded8(valid, scene, rays, &arguments);
    else
        rtcOccluded4(valid, scene, rays, &arguments);
}

#else

static inline struct RTCIntersectContext aur_embree_context(aur_embree_order order) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (order == AUR_EMBREE_COHERENT)
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

static inline void aur_embree_intersect1(RTCScene scene, struct RTCRayHit *ray) {
    ++aur_rays_traced;
    struct RTCIntersectContext context = aur_embree_context(AUR_EMBREE_INCOHERENT);
    rtcIntersect1(scene, &context, ray);
}

/* `rays` is a struct RTCRayHit4, RTCRayHit8 or RTCRayHit16; valid[size] is -1 for the rays that are there and
 * 0 for the others. */
static inline void aur_embree_intersect_packet(RTCScene scene, aur_embree_order order, size_t size,
                                               const int *valid, void *rays) {
    aur_embree_count_packet(size, valid);
    struct RTCIntersectContext context = aur_embree_context(order);
    if (size == 16)
        rtcIntersect16(valid, scene, &context, rays);
    else if (size == 8)
        rtcIntersect8(valid, scene, &context, rays);
    else
        rtcIntersect4(valid, scene, &context, rays);
}

/* Sets ray->tfar to minus infinity when anything is hit. */
static inline void aur_embree_occluded1(RTCScene scene, struct RTCRay *ray) {
    ++aur_rays_traced;
    struct RTCIntersectContext context = aur_embree_context(AUR_EMBREE_INCOHERENT);
    rtcOccluded1(scene, &context, ray);
}

static inline void aur_embree_occluded_packet(RTCScene scene, aur_embree_order order, size_t size,
                                              const int *valid, void *rays) {
    aur_embree_count_packet(size, valid);
    struct RTCIntersectContext context = aur_embree_context(order);
    if (size == 16)
        rtcOccluded16(valid, scene, &context, rays);
    else if (size == 8)
        rtcOccluded8(valid, scene, &context, rays);
    else
        rtcOccluded4(valid, scene, &context, rays);
}

#endif
