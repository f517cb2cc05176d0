/* Which rays a piece of code traces one by one. The program has an rtcIntersect1 and an rtcOccluded1 of its
 * own, which the libraries find before Embree's, so nothing that is measured has to know of it. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "render/trace/embree.h"

typedef struct bench_recorded_ray {
    struct RTCRay ray;
    bool occluded; /* any hit, else the closest */
} bench_recorded_ray;

typedef struct bench_recorder {
    size_t count, capacity; /* count may exceed capacity: the rest was not kept */
    bench_recorded_ray *rays;
} bench_recorder;

/* From here on rays are kept in `recorder`; NULL ends that. On one thread only. */
void bench_record(bench_recorder *recorder);

/* Traces them again through Embree itself; how many hit something. */
size_t bench_replay(RTCScene scene, const bench_recorder *recorder);
