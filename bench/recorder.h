/* Records the single rays that a piece of code traces. The program defines rtcIntersect1 and rtcOccluded1,
 * which the libraries resolve before Embree's, so that the measured code needs no change. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "render/trace/embree.h"

typedef struct bench_recorded_ray {
    struct RTCRay ray;
    bool occluded; /* any hit, else the closest */
} bench_recorded_ray;

typedef struct bench_recorder {
    size_t count, capacity; /* count may exceed capacity: the rest was dropped */
    bench_recorded_ray *rays;
} bench_recorder;

/* Starts recording rays to `recorder`; NULL stops. Single-threaded. */
void bench_record(bench_recorder *recorder);

/* Replays the rays with Embree; returns the number of hits. */
size_t bench_replay(RTCScene scene, const bench_recorder *recorder);
