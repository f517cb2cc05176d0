/* Radiance along gather rays. */
#pragma once

#include "render/gather/plan.h"
#include "render/trace/packet_rays.h"

enum { AUR_LONGEST_CHAIN = 16 }; /* bounces in a row that are followed */

/* Sixteen gather rays and what comes along them. */
typedef struct aur_gather_rays {
    aur_packet packet;
    /* The density of each direction, a steradian, times the number of directions that a sample of the pixel
     * sends: a light's own sampling is weighed against it. */
    float density[AUR_PACKET_SIZE];
    /* Where not NULL: instead, the density of both patterns of this rule about these axes, found only where
     * it is needed. */
    const aur_merged_rule *merged[AUR_PACKET_SIZE];
    aur_vector axes[AUR_PACKET_SIZE][2];
    /* What chance decides where rays go on from what they meet: a hash of the direction, and those of the
     * lanes' pixels. So it is the same whichever pixels go together. */
    uint64_t hash;
    const uint64_t *pixels;
    aur_light_reference reference[AUR_PACKET_SIZE]; /* the points that gather */
    float radiance[3][AUR_PACKET_SIZE];             /* 0 for lanes without a ray */
} aur_gather_rays;

static inline uint64_t aur_gather_rays_hash(const aur_gather_rays *rays, size_t lane) {
    return aur_hash2(rays->hash, rays->pixels[lane]);
}

/* Traces the packet and finds the radiance. */
void aur_gather_rays_trace(const aur_gather_plan *plan, aur_embree_order order, aur_gather_rays *rays,
                           aur_counters *counters);

/* The nearest hits of a packet, and which of its rays are stopped, as the policy has them traced. */
uint32_t aur_gather_intersect(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
uint32_t aur_gather_occluded(const aur_gather_plan *plan, aur_embree_order order, aur_packet *packet);
