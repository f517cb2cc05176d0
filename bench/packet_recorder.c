#define _GNU_SOURCE /* RTLD_NEXT */
#include "packet_recorder.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

static bench_packet_recorder *current;

void bench_record_packets(bench_packet_recorder *recorder) {
    current = recorder;
}

/* A packet of `size` rays is an array of rows, in the order of struct RTCRayHit16. */
enum { ORIGIN = 0, NEAREST = 3, DIRECTION = 4, FARTHEST = 8, MASK = 9, GEOMETRY = 18, INSTANCE = 19 };
enum { ROWS = sizeof(struct RTCRayHit16) / sizeof(float[BENCH_RECORDED_LANES]) };

static void record(size_t size, const int *valid, const void *rays, bool coherent, bool occluded) {
    if (current == NULL)
        return;
    uint16_t lanes = 0;
    for (size_t k = 0; k < size; ++k)
        lanes |= (uint16_t)((valid[k] != 0) << k);
    const size_t count = (size_t)__builtin_popcount(lanes);
    current->rays += count;
    current->coherent_rays += coherent ? count : 0;
    if (current->count++ >= current->capacity)
        return;
    bench_recorded_packet *const packet = &current->packets[current->count - 1];
    const float *const rows = rays;
    const size_t bytes = size * sizeof *rows;
    for (size_t c = 0; c < 3; ++c) {
        memcpy(packet->origin[c], rows + (ORIGIN + c) * size, bytes);
        memcpy(packet->direction[c], rows + (DIRECTION + c) * size, bytes);
    }
    memcpy(packet->nearest, rows + NEAREST * size, bytes);
    memcpy(packet->farthest, rows + FARTHEST * size, bytes);
    packet->size = (uint8_t)size;
    packet->lanes = lanes;
    packet->occluded = occluded;
    packet->coherent = coherent;
}

/* Embree's functions. The functions of the same names in this program replace them for the libraries. */
static __typeof__(rtcIntersect4) *real_intersect4;
static __typeof__(rtcOccluded4) *real_occluded4;
static __typeof__(rtcIntersect8) *real_intersect8;
static __typeof__(rtcOccluded8) *real_occluded8;
static __typeof__(rtcIntersect16) *real_intersect16;
static __typeof__(rtcOccluded16) *real_occluded16;

static void find(const char *name, void *function) {
    void *const found = dlsym(RTLD_NEXT, name);
    memcpy(function, &found, sizeof found);
}

__attribute__((constructor)) static void find_real(void) {
    find("rtcIntersect4", &real_intersect4);
    find("rtcOccluded4", &real_occluded4);
    find("rtcIntersect8", &real_intersect8);
    find("rtcOccluded8", &real_occluded8);
    find("rtcIntersect16", &real_intersect16);
    find("rtcOccluded16", &real_occluded16);
}

#if AUR_EMBREE_VERSION >= 4

static bool is_coherent(const struct RTCIntersectArguments *arguments) {
    return arguments != NULL && (arguments->flags & RTC_RAY_QUERY_FLAG_COHERENT) != 0;
}

static bool is_coherent_shadow(const struct RTCOccludedArguments *arguments) {
    return arguments != NULL && (arguments->flags & RTC_RAY_QUERY_FLAG_COHERENT) != 0;
}

void rtcIntersect4(const int *valid, RTCScene scene, struct RTCRayHit4 *query,
                   struct RTCIntersectArguments *arguments) {
    record(4, valid, query, is_coherent(arguments), false);
    real_intersect4(valid, scene, query, arguments);
}

void rtcOccluded4(const int *valid, RTCScene scene, struct RTCRay4 *query,
                  struct RTCOccludedArguments *arguments) {
    record(4, valid, query, is_coherent_shadow(arguments), true);
    real_occluded4(valid, scene, query, arguments);
}

void rtcIntersect8(const int *valid, RTCScene scene, struct RTCRayHit8 *query,
                   struct RTCIntersectArguments *arguments) {
    record(8, valid, query, is_coherent(arguments), false);
    real_intersect8(valid, scene, query, arguments);
}

void rtcOccluded8(const int *valid, RTCScene scene, struct RTCRay8 *query,
                  struct RTCOccludedArguments *arguments) {
    record(8, valid, query, is_coherent_shadow(arguments), true);
    real_occluded8(valid, scene, query, arguments);
}

void rtcIntersect16(const int *valid, RTCScene scene, struct RTCRayHit16 *query,
                    struct RTCIntersectArguments *arguments) {
    record(16, valid, query, is_coherent(arguments), false);
    real_intersect16(valid, scene, query, arguments);
}

void rtcOccluded16(const int *valid, RTCScene scene, struct RTCRay16 *query,
                   struct RTCOccludedArguments *arguments) {
    record(16, valid, query, is_coherent_shadow(arguments), true);
    real_occluded16(valid, scene, query, arguments);
}

#else

static bool is_coherent(const struct RTCIntersectContext *context) {
    return (context->flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) != 0;
}

void rtcIntersect4(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                   struct RTCRayHit4 *query) {
    record(4, valid, query, is_coherent(context), false);
    real_intersect4(valid, scene, context, query);
}

void rtcOccluded4(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                  struct RTCRay4 *query) {
    record(4, valid, query, is_coherent(context), true);
    real_occluded4(valid, scene, context, query);
}

void rtcIntersect8(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                   struct RTCRayHit8 *query) {
    record(8, valid, query, is_coherent(context), false);
    real_intersect8(valid, scene, context, query);
}

void rtcOccluded8(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                  struct RTCRay8 *query) {
    record(8, valid, query, is_coherent(context), true);
    real_occluded8(valid, scene, context, query);
}

void rtcIntersect16(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                    struct RTCRayHit16 *query) {
    record(16, valid, query, is_coherent(context), false);
    real_intersect16(valid, scene, context, query);
}

void rtcOccluded16(const int *valid, RTCScene scene, struct RTCIntersectContext *context,
                   struct RTCRay16 *query) {
    record(16, valid, query, is_coherent(context), true);
    real_occluded16(valid, scene, context, query);
}

#endif

static inline void restore(const bench_recorded_packet *packet, size_t size, int *valid, float *rows) {
    const size_t bytes = size * sizeof *rows;
    for (size_t c = 0; c < 3; ++c) {
        memcpy(rows + (ORIGIN + c) * size, packet->origin[c], bytes);
        memcpy(rows + (DIRECTION + c) * size, packet->direction[c], bytes);
    }
    memcpy(rows + NEAREST * size, packet->nearest, bytes);
    memcpy(rows + FARTHEST * size, packet->farthest, bytes);
    for (size_t k = 0; k < size; ++k)
        valid[k] = -(int)(packet->lanes >> k & 1u);
}

/* Replays one packet; `rows` holds the members that are the same for all packets. */
static inline size_t replay(RTCScene scene, size_t size, const bench_recorded_packet *packet, float *rows) {
    _Alignas(64) int valid[BENCH_RECORDED_LANES];
    const aur_embree_order order = packet->coherent ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    size_t hits = 0;
    restore(packet, size, valid, rows);
    if (packet->occluded) {
        aur_embree_occluded_packet(scene, order, size, valid, rows);
        for (size_t k = 0; k < size; ++k)
            hits += valid[k] != 0 && rows[FARTHEST * size + k] < 0.0f;
        return hits;
    }
    memset(rows + GEOMETRY * size, 0xff, size * sizeof *rows);
    memset(rows + INSTANCE * size, 0xff, size * sizeof *rows);
    aur_embree_intersect_packet(scene, order, size, valid, rows);
    for (size_t k = 0; k < size; ++k) {
        uint32_t geometry;
        memcpy(&geometry, rows + GEOMETRY * size + k, sizeof geometry);
        hits += valid[k] != 0 && geometry != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

/* Constant sizes let the compiler unroll the loops over lanes. */
static size_t replay_any(RTCScene scene, const bench_recorded_packet *packet, float *rows) {
    switch (packet->size) {
    case 16:
        return replay(scene, 16, packet, rows);
    case 8:
        return replay(scene, 8, packet, rows);
    default:
        return replay(scene, 4, packet, rows);
    }
}

size_t bench_replay_packets(RTCScene scene, const bench_packet_recorder *recorder) {
    const size_t size = recorder->count > 0 ? recorder->packets[0].size : BENCH_RECORDED_LANES;
    _Alignas(64) float rows[ROWS * BENCH_RECORDED_LANES] = {0};
    memset(rows + MASK * size, 0xff, size * sizeof rows[0]);
    size_t hits = 0;
    for (size_t i = 0; i < recorder->count; ++i) {
        const bench_recorded_packet *const packet = &recorder->packets[i];
        for (size_t line = 0; line < sizeof *packet; line += 64)
            __builtin_prefetch((const char *)(packet + 2) + line);
        hits += replay_any(scene, packet, rows);
    }
    return hits;
}
