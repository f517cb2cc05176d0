/* Records the ray packets of one size that a piece of code traces, with functions that replace Embree's as in
 * recorder.h, and replays them with Embree alone. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "render/trace/embree.h"

enum { BENCH_RECORDED_LANES = 16 };

/* Compact, so that reading it costs the replay little. */
typedef struct bench_recorded_packet {
    float origin[3][BENCH_RECORDED_LANES], direction[3][BENCH_RECORDED_LANES];
    float nearest[BENCH_RECORDED_LANES], farthest[BENCH_RECORDED_LANES];
    uint16_t lanes;
    uint8_t size;  /* 4, 8 or 16 */
    bool occluded; /* any hit, else the closest */
    bool coherent; /* the coherent flag of the call */
} bench_recorded_packet;

typedef struct bench_packet_recorder {
    size_t count, capacity; /* count may exceed capacity: the rest was dropped */
    size_t rays, coherent_rays;
    bench_recorded_packet *packets;
} bench_packet_recorder;

/* Starts recording packets to `recorder`; NULL stops. Single-threaded. */
void bench_record_packets(bench_packet_recorder *recorder);

/* Replays the packets with Embree, each with its flag; returns the number of hits. */
size_t bench_replay_packets(RTCScene scene, const bench_packet_recorder *recorder);
