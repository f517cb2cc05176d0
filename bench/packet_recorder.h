/* Which packets of rays, of one size, a piece of code traces, by functions in front of Embree's as in
 * recorder.h, and the same packets again through Embree alone. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "render/trace/embree.h"

enum { BENCH_RECORDED_LANES = 16 };

/* As small as can be, so that reading it back costs the bare tracer little. */
typedef struct bench_recorded_packet {
    float origin[3][BENCH_RECORDED_LANES], direction[3][BENCH_RECORDED_LANES];
    float nearest[BENCH_RECORDED_LANES], farthest[BENCH_RECORDED_LANES];
    uint16_t lanes;
    uint8_t size;  /* 4, 8 or 16 */
    bool occluded; /* any hit, else the closest */
    bool coherent; /* the flag that it was traced with */
} bench_recorded_packet;

typedef struct bench_packet_recorder {
    size_t count, capacity; /* count may exceed capacity: the rest was not kept */
    size_t rays, coherent_rays;
    bench_recorded_packet *packets;
} bench_packet_recorder;

/* From here on packets are kept in `recorder`; NULL ends that. On one thread only. */
void bench_record_packets(bench_packet_recorder *recorder);

/* Traces them again through Embree itself, each with its flag; how many rays hit something. */
size_t bench_replay_packets(RTCScene scene, const bench_packet_recorder *recorder);
