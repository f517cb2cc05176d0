#include "recorder.h"

static bench_recorder *current;

void bench_record(bench_recorder *recorder) {
    current = recorder;
}

static void keep(const struct RTCRay *ray, bool occluded) {
    if (current == NULL)
        return;
    if (current->count < current->capacity)
        current->rays[current->count] = (bench_recorded_ray){*ray, occluded};
    ++current->count;
}

/* The names are the linker's. */
#if AUR_EMBREE_VERSION >= 4

void __real_rtcIntersect1(RTCScene scene, struct RTCRayHit *query, struct RTCIntersectArguments *arguments);
void __real_rtcOccluded1(RTCScene scene, struct RTCRay *query, struct RTCOccludedArguments *arguments);
void __wrap_rtcIntersect1(RTCScene scene, struct RTCRayHit *query, struct RTCIntersectArguments *arguments);
void __wrap_rtcOccluded1(RTCScene scene, struct RTCRay *query, struct RTCOccludedArguments *arguments);

void __wrap_rtcIntersect1(RTCScene scene, struct RTCRayHit *query, struct RTCIntersectArguments *arguments) {
    keep(&query->ray, false);
    __real_rtcIntersect1(scene, query, arguments);
}

void __wrap_rtcOccluded1(RTCScene scene, struct RTCRay *query, struct RTCOccludedArguments *arguments) {
    keep(query, true);
    __real_rtcOccluded1(scene, query, arguments);
}

#else

void __real_rtcIntersect1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRayHit *query);
void __real_rtcOccluded1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRay *query);
void __wrap_rtcIntersect1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRayHit *query);
void __wrap_rtcOccluded1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRay *query);

void __wrap_rtcIntersect1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRayHit *query) {
    keep(&query->ray, false);
    __real_rtcIntersect1(scene, context, query);
}

void __wrap_rtcOccluded1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRay *query) {
    keep(query, true);
    __real_rtcOccluded1(scene, context, query);
}

#endif

size_t bench_replay(RTCScene scene, const bench_recorder *recorder) {
    size_t hits = 0;
    for (size_t i = 0; i < recorder->count; ++i) {
        const bench_recorded_ray *const recorded = &recorder->rays[i];
        struct RTCRayHit query = {.ray = recorded->ray};
        if (recorded->occluded) {
            aur_embree_occluded1(scene, &query.ray);
            hits += query.ray.tfar < 0.0f;
            continue;
        }
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        aur_embree_intersect1(scene, &query);
        hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}
