/* Radiance along gather rays. */
#pragma once

#include "render/gather/plan.h"
#include "render/trace/packet_rays.h"

enum { AUR_LONGEST_CHAIN = 16 }; /* bounces in a row that are followed */

/* Paths that replace the map's estimate: they wait until there are sixteen, also of several packets. */
typedef struct aur_gather_paths {
    size_t count;
    aur_continuation_start starts[AUR_PACKET_SIZE];
    aur_vector weights[AUR_PACKET_SIZE]; /* of the path's radiance in the ray's */
    float *to[AUR_PACKET_SIZE]; /* the ray's radiance: [0], [AUR_PACKET_SIZE], [2 * AUR_PACKET_SIZE] */
} aur_gather_paths;

/* Sixteen gather rays and what comes along them. */
typedef struct aur_gather_rays {
    aur_packet packet;
    /* Solid-angle density of each direction times the number of directions per sample: the pdf for MIS
     * against light sampling. */
    float density[AUR_PACKET_SIZE];
    /* Seeds of the random decisions where rays continue: hashes of the directions, and of the lanes'
     * pixels. The result does not depend on which pixels are grouped. */
    uint64_t hash[AUR_PACKET_SIZE];
    const uint64_t *pixels;
    aur_light_reference reference[AUR_PACKET_SIZE]; /* the points that gather */
    float (*radiance)[AUR_PACKET_SIZE];             /* [3], of the caller; 0 for lanes without a ray */
    aur_gather_paths paths;
} aur_gather_rays;

static inline uint64_t aur_gather_rays_hash(const aur_gather_rays *rays, size_t lane) {
    return aur_hash2(rays->hash[lane], rays->pixels[lane]);
}

/* Traces the packet and computes the radiance of its rays, but for what comes by waiting paths. */
void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters);
/* Adds what comes by waiting paths to the radiance of all packets so far, which must still be in place. */
void aur_gather_rays_finish(const aur_gather_plan *plan, aur_gather_rays *rays);

/* Intersects the packet as the policy demands (packets or single rays) and returns the lanes that hit
 * something. */
uint32_t aur_gather_intersect(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
uint32_t aur_gather_occluded(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
