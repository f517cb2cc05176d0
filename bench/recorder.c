#define _GNU_SOURCE /* RTLD_NEXT */
#include "recorder.h"

#include <dlfcn.h>
#include <string.h>

static bench_recorder *current;

void bench_record(bench_recorder *recorder) {
    current = recorder;
}

static void record(const struct RTCRay *ray, bool occluded) {
    if (current == NULL)
        return;
    if (current->count < current->capacity)
        current->rays[current->count] = (bench_recorded_ray){*ray, occluded};
    ++current->count;
}

/* Embree's functions. The functions of the same names in this program replace them for the libraries. */
static __typeof__(rtcIntersect1) *real_intersect;
static __typeof__(rtcOccluded1) *real_occluded;

__attribute__((constructor)) static void find_real(void) {
    void *const intersect = dlsym(RTLD_NEXT, "rtcIntersect1"), *const occluded =
                                                                   dlsym(RTLD_NEXT, "rtcOccluded1");
    memcpy(&real_intersect, &intersect, sizeof intersect);
    memcpy(&real_occluded, &occluded, sizeof occluded);
}

#if AUR_EMBREE_VERSION >= 4

void rtcIntersect1(RTCScene scene, struct RTCRayHit *query, struct RTCIntersectArguments *arguments) {
    record(&query->ray, false);
    real_intersect(scene, query, arguments);
}

void rtcOccluded1(RTCScene scene, struct RTCRay *query, struct RTCOccludedArguments *arguments) {
    record(query, true);
    real_occluded(scene, query, arguments);
}

#else

void rtcIntersect1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRayHit *query) {
    record(&query->ray, false);
    real_intersect(scene, context, query);
}

void rtcOccluded1(RTCScene scene, struct RTCIntersectContext *context, struct RTCRay *query) {
    record(query, true);
    real_occluded(scene, context, query);
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
