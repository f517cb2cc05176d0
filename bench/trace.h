/* Replays stored rays with Embree, as single rays and in packets of the SIMD width, at most 16. */
#pragma once

#include "render/scene/scene.h"
#include "render/trace/embree.h"

enum { BENCH_PACKET_SIZE = 16 };

typedef struct bench_rays {
    RTCScene scene;
    size_t count; /* a multiple of BENCH_PACKET_SIZE */
    const aur_ray *rays;
    bool occluded;          /* any hit, else the closest */
    aur_embree_order order; /* packets of coherent rays */
} bench_rays;

/* Returns the number of hits. */
size_t bench_trace_single(const bench_rays *rays);
size_t bench_trace_packets(const bench_rays *rays);

/* Converts the ray to Embree's struct. */
struct RTCRayHit bench_query(const aur_ray *ray);

/* The pixel of ray `index` in an image of width `width`, a multiple of 4: a packet covers 4 by 4 pixels. */
void bench_pixel(size_t index, size_t width, size_t *x, size_t *y);

/* A cosine-distributed direction about a unit normal, from a hash of `index`. */
aur_vector bench_cosine_direction(aur_vector normal, size_t index);
