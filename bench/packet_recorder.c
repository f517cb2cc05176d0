#define _GNU_SOURCE /* RTLD_NEXT */
#include "packet_recorder.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

static bench_packet_recorder *current;

void bench_record_packets(bench_packet_recorder *recorder) {
    current = recorder;
}

static void keep(const int *valid, const struct RTCRay16 *rays, bool coherent, bool occluded) {
    if (current == NULL)
        return;
    uint16_t lanes = 0;
    for (size_t k = 0; k < BENCH_RECORDED_LANES; ++k)
        lanes |= (uint16_t)((valid[k] != 0) << k);
    const size_t count = (size_t)__builtin_popcount(lanes);
    current->rays += count;
    current->coherent_rays += coherent ? count : 0;
    if (current->count++ >= current->capacity)
        return;
    bench_recorded_packet *const packet = &current->packets[current->count - 1];
    memcpy(packet->origin[0], rays->org_x, sizeof rays->org_x);
    memcpy(packet->origin[1], rays->org_y, sizeof rays->org_y);
    memcpy(packet->origin[2], rays->org_z, sizeof rays->org_z);
    memcpy(packet->direction[0], rays->dir_x, sizeof rays->dir_x);
    memcpy(packet->direction[1], rays->dir_y, sizeof rays->dir_y);
    memcpy(packet->direction[2], rays->dir_z, sizeof rays->dir_z);
    memcpy(packet->nearest, rays->tnear, sizeof rays->tnear);
    memcpy(packet->farthest, rays->tfar, sizeof rays->tfar);
    packet->lanes = lanes;
    packet->occluded = occluded;
    packet->coherent = coherent;
}

/* Embree's own functions, which the program's of the same names hide from the libraries. */
static __typeof__(rtcIntersect16) *real_intersect;
static __typeof__(rtcOccluded16) *real_occluded;

__attribute__((constructor)) static void find_real(void) {
    void *const intersect = dlsym(RTLD_NEXT, "rtcIntersect16"), *const occluded =
                                                                    dlsym(RTLD_NEXT, "rtcOccluded16");
    memcpy(&real_intersect, &intersect, sizeof intersect);
    memcpy(&real_occluded, &occluded, sizeof occluded);
}

#if AUR_EMBREE_VERSION >= 4

void rtcIntersect16(const int *valid, RTCScene scene, struct RTCRayHit16 *query,
                    struct RTCIntersectArguments *arguments) {
    keep(valid, &query->ray, arguments != NULL && (arguments->flags & RTC_RAY_QUERY_FLAG_COHERENT) != 0,
         false);
    real_intersect(valid, scene, query, arguments);
}

void rtcOccluded16(const int *valid, RTCScene scene, struct RTCRay16 *query,
                   struct RTCOccludedArguments *arguments) {
    keep(valid, query, arguments != NULL && (arguments->flags & RTC_RAY_QUERY_FLAG_COHERENT) != 0, true);
    real_occluded(valid, scene, query, arguments);
}

#else

void rtcIntersect16(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                    struct RTCRayHit16 *query) {
    keep(valid, &query->ray, (context->flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) != 0, false);
    real_intersect(valid, scene, context, query);
}

void rtcOccluded16(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                   struct RTCRay16 *query) {
    keep(valid, query, (context->flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) != 0, true);
    real_occluded(valid, scene, context, query);
}

#endif

static void restore(const bench_recorded_packet *packet, int *valid, struct RTCRay16 *rays) {
    memcpy(rays->org_x, packet->origin[0], sizeof rays->org_x);
    memcpy(rays->org_y, packet->origin[1], sizeof rays->org_y);
    memcpy(rays->org_z, packet->origin[2], sizeof rays->org_z);
    memcpy(rays->dir_x, packet->direction[0], sizeof rays->dir_x);
    memcpy(rays->dir_y, packet->direction[1], sizeof rays->dir_y);
    memcpy(rays->dir_z, packet->direction[2], sizeof rays->dir_z);
    memcpy(rays->tnear, packet->nearest, sizeof rays->tnear);
    memcpy(rays->tfar, packet->farthest, sizeof rays->tfar);
    for (size_t k = 0; k < BENCH_RECORDED_LANES; ++k)
        valid[k] = -(int)(packet->lanes >> k & 1u);
}

size_t bench_replay_packets(RTCScene scene, const bench_packet_recorder *recorder) {
    _Alignas(64) int valid[BENCH_RECORDED_LANES];
    _Alignas(64) struct RTCRayHit16 query;
    memset(&query, 0, sizeof query);
    for (size_t k = 0; k < BENCH_RECORDED_LANES; ++k)
        query.ray.mask[k] = UINT32_MAX;
    size_t hits = 0;
    for (size_t i = 0; i < recorder->count; ++i) {
        const bench_recorded_packet *const packet = &recorder->packets[i];
        const aur_embree_order order = packet->coherent ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
        for (size_t line = 0; line < sizeof *packet; line += 64)
            __builtin_prefetch((const char *)(packet + 2) + line);
        restore(packet, valid, &query.ray);
        if (packet->occluded) {
            aur_embree_occluded16(scene, order, valid, &query.ray);
            for (size_t k = 0; k < BENCH_RECORDED_LANES; ++k)
                hits += valid[k] != 0 && query.ray.tfar[k] < 0.0f;
            continue;
        }
        memset(query.hit.geomID, 0xff, sizeof query.hit.geomID);
        memset(query.hit.instID, 0xff, sizeof query.hit.instID);
        aur_embree_intersect16(scene, order, valid, &query);
        for (size_t k = 0; k < BENCH_RECORDED_LANES; ++k)
            hits += valid[k] != 0 && query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}
