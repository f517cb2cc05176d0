/* Radiance along gather rays. */
#pragma once

#include "render/gather/plan.h"
#include "render/trace/packet_rays.h"

enum { AUR_LONGEST_CHAIN = 16 }; /* bounces in a row that are followed */

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
    float radiance[3][AUR_PACKET_SIZE];             /* 0 for lanes without a ray */
} aur_gather_rays;

static inline uint64_t aur_gather_rays_hash(const aur_gather_rays *rays, size_t lane) {
    return aur_hash2(rays->hash[lane], rays->pixels[lane]);
}

/* Traces the packet and computes the radiance of its rays. */
void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters);

/* Intersects the packet as the policy demands (packets or single rays) and returns the lanes that hit
 * something. */
uint32_t aur_gather_intersect(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
uint32_t aur_gather_occluded(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
