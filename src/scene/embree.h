/* Embree 3 and 4 behind one face. Version 4 renamed the context of a query and moved it to an optional last
 * argument; nothing else that Aureole uses differs. FindEmbree.cmake sets AUR_EMBREE_VERSION. */
#pragma once

#if AUR_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/* What is known of a packet's rays. Coherent: nearby origins and directions. The flag halves the speed of
 * rays that are not. */
typedef enum aur_embree_order { AUR_EMBREE_INCOHERENT, AUR_EMBREE_COHERENT } aur_embree_order;

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
    rtcIntersect1(scene, ray, NULL);
}

/* valid[16] is -1 for the rays that are there and 0 for the others. */
static inline void aur_embree_intersect16(RTCScene scene, aur_embree_order order, const int *valid,
                                          struct RTCRayHit16 *rays) {
    struct RTCIntersectArguments arguments = aur_embree_intersect_arguments(order);
    rtcIntersect16(valid, scene, rays, &arguments);
}

/* Sets ray->tfar to minus infinity when anything is hit. */
static inline void aur_embree_occluded1(RTCScene scene, struct RTCRay *ray) {
    rtcOccluded1(scene, ray, NULL);
}

static inline void aur_embree_occluded16(RTCScene scene, aur_embree_order order, const int *valid,
                                         struct RTCRay16 *rays) {
    struct RTCOccludedArguments arguments = aur_embree_occluded_arguments(order);
    rtcOccluded16(valid, scene, rays, &arguments);
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
    struct RTCIntersectContext context = aur_embree_context(AUR_EMBREE_INCOHERENT);
    rtcIntersect1(scene, &context, ray);
}

/* valid[16] is -1 for the rays that are there and 0 for the others. */
static inline void aur_embree_intersect16(RTCScene scene, aur_embree_order order, const int *valid,
                                          struct RTCRayHit16 *rays) {
    struct RTCIntersectContext context = aur_embree_context(order);
    rtcIntersect16(valid, scene, &context, rays);
}

/* Sets ray->tfar to minus infinity when anything is hit. */
static inline void aur_embree_occluded1(RTCScene scene, struct RTCRay *ray) {
    struct RTCIntersectContext context = aur_embree_context(AUR_EMBREE_INCOHERENT);
    rtcOccluded1(scene, &context, ray);
}

static inline void aur_embree_occluded16(RTCScene scene, aur_embree_order order, const int *valid,
                                         struct RTCRay16 *rays) {
    struct RTCIntersectContext context = aur_embree_context(order);
    rtcOccluded16(valid, scene, &context, rays);
}

#endif
