/* Vertices of sixteen light paths on plain surfaces, an array a number: the surface, a point on a light, a
 * direction, as vertex.h has them for one path and all surfaces. */
#pragma once

#include "points/base/simd.h"
#include "render/trace/packet.h"

typedef struct aur_vertex_lanes {
    _Alignas(64) aur_lane_vectors throughput;
    aur_lane_vectors sum; /* radiance found so far */
    /* Where the ray began: the last surface, and its normal as aur_light_reference has it. */
    aur_lane_vectors from, from_normal;
    aur_lane_numbers pdf; /* of its direction, per steradian */

    /* Numbers of the bounce, in [0,1). */
    aur_lane_numbers choice, roulette, light_u, light_v, lobe, selection, direction_u, direction_v;

    /* The triangle, and its reflectance seen from the side of its normal and from behind. */
    aur_lane_vectors corner[3];
    aur_lane_vectors albedo[2];

    /* The surface. */
    aur_lane_vectors position, normal; /* on the side of the winding */
    aur_lane_numbers side;             /* 1 seen from the side of the normal, -1 from behind */
    aur_lane_vectors facing;           /* the normal on the side that is seen */
    aur_lane_vectors reflectance;
    aur_lane_vectors origin; /* of rays that leave it: just off, on the side that is seen */

    aur_light_lanes light;
    aur_lane_vectors shadow;    /* light from there, if nothing lies between */
    int lit[AUR_PACKET_SIZE];   /* -1: it is not 0 */
    int alive[AUR_PACKET_SIZE]; /* -1: the path goes on */
} aur_vertex_lanes;

/* Of sixteen paths, the candidates that are kept so far (candidates.h). */
typedef struct aur_vertex_candidates {
    _Alignas(64) aur_lane_vectors light, origin, direction;
    aur_lane_numbers farthest;
    aur_lane_numbers own, total; /* the weight of the one that is kept, and of all; 0: all are black */
} aur_vertex_candidates;

/* Loops over all lanes, for each instruction set; lanes that are not plain hold something of no meaning
 * afterwards, so they are to be filled in later. The bits are the same for every instruction set. */
typedef struct aur_vertex_kernels {
    /* The surface at the hits of `packet`, from corners and albedos. */
    void (*surface)(aur_vertex_lanes *lanes, const aur_packet *packet);
    /* Bit k: the surface of lane k lies in no common plane with that of lane `first`, nearly. */
    uint32_t (*tilted)(const aur_vertex_lanes *lanes, size_t first);
    /* Rays towards the points on lights, and what they bring. */
    void (*shadow)(aur_vertex_lanes *lanes, aur_packet *packet);
    /* One more candidate: what `shadow` has left, for which it takes from lanes->selection. */
    void (*consider)(aur_vertex_lanes *lanes, const aur_packet *packet, aur_vertex_candidates *kept);
    /* Puts those of `count` that were kept where `shadow` leaves rays and light. */
    void (*choose)(const aur_vertex_candidates *kept, uint32_t count, aur_vertex_lanes *lanes,
                   aur_packet *packet);
    /* Adds what the lanes whose bit is set bring. */
    void (*add)(aur_vertex_lanes *lanes, uint32_t lit);
    /* The next rays. */
    void (*scatter)(aur_vertex_lanes *lanes, bool roulette, aur_packet *packet);
} aur_vertex_kernels;

AUR_KERNELS(const aur_vertex_kernels, aur_vertex_kernels);
