/* Vertices of sixteen light paths on plain surfaces in structure-of-arrays form: surfaces, light samples,
 * directions. vertex.h has the same for one path and all kinds of surfaces. */
#pragma once

#include "points/base/simd.h"
#include "render/trace/packet.h"

typedef struct aur_vertex_lanes {
    _Alignas(64) aur_lane_vectors throughput;
    aur_lane_vectors sum; /* radiance accumulated so far */
    /* The ray's origin: the last surface, and its normal as in aur_light_reference. */
    aur_lane_vectors from, from_normal;
    aur_lane_numbers pdf; /* of its direction, per steradian */

    /* Numbers of the bounce, in [0,1). */
    aur_lane_numbers choice, roulette, light_u, light_v, lobe, selection, direction_u, direction_v;

    /* The triangle, and its reflectance on the side of its normal and on the back. */
    aur_lane_vectors corner[3];
    aur_lane_vectors albedo[2];

    /* The surface. */
    aur_lane_vectors position, normal; /* on the side of the winding */
    aur_lane_numbers side;             /* 1 seen from the side of the normal, -1 from the back */
    aur_lane_vectors facing;           /* the normal on the side that is seen */
    aur_lane_vectors reflectance;
    aur_lane_vectors origin; /* of rays that leave it: just off, on the side that is seen */

    aur_light_lanes light;
    aur_lane_vectors shadow;    /* unoccluded contribution of the light sample */
    int lit[AUR_PACKET_SIZE];   /* -1: it is not 0 */
    int alive[AUR_PACKET_SIZE]; /* -1: the path continues */
} aur_vertex_lanes;

/* Of sixteen paths, the candidates selected so far (candidates.h). */
typedef struct aur_vertex_candidates {
    _Alignas(64) aur_lane_vectors light, origin, direction;
    aur_lane_numbers farthest;
    aur_lane_numbers weight, total; /* the weight of the selected one, and of all; 0: all are black */
} aur_vertex_candidates;

/* Loops over all lanes, for each instruction set. Results of lanes that are not plain are undefined, so these
 * must be set afterwards. Results are bit-identical for every instruction set. */
typedef struct aur_vertex_kernels {
    /* The surface at the hits of `packet`, from corners and albedos. */
    void (*surface)(aur_vertex_lanes *lanes, const aur_packet *packet);
    /* Bit k: the surface of lane k is not nearly coplanar with that of lane `first`. */
    uint32_t (*tilted)(const aur_vertex_lanes *lanes, size_t first);
    /* Sets shadow rays and unoccluded contributions. */
    void (*shadow)(aur_vertex_lanes *lanes, aur_packet *packet);
    /* Considers one more candidate, set by `shadow`; takes random numbers from lanes->selection. */
    void (*consider)(aur_vertex_lanes *lanes, const aur_packet *packet, aur_vertex_candidates *selected);
    /* Writes the selected ones of `count` candidates where `shadow` writes rays and contributions. */
    void (*choose)(const aur_vertex_candidates *selected, uint32_t count, aur_vertex_lanes *lanes,
                   aur_packet *packet);
    /* Adds the contributions of the lanes whose bit is set. */
    void (*add)(aur_vertex_lanes *lanes, uint32_t lit);
    /* The next rays. */
    void (*scatter)(aur_vertex_lanes *lanes, bool roulette, aur_packet *packet);
} aur_vertex_kernels;

AUR_KERNELS(const aur_vertex_kernels, aur_vertex_kernels);
