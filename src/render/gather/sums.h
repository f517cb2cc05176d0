/* Output of the estimators for sixteen pixels, and working memory whose contents are discarded after a call.
 */
#pragma once

#include "render/gather/incident.h"
#include "render/gather/points.h"

/* Diffuse light that goes into the pool of neighbouring pixels instead of the radiance: irradiance times
 * coefficient. */
typedef struct aur_gather_pooled {
    aur_vector irradiance;       /* the integral of the diffuse lobe without its coefficient */
    aur_vector coefficient;      /* of the lobe, times the throughput to the camera */
    aur_vector position, normal; /* of the shading point, on the visible side */
} aur_gather_pooled;

typedef struct aur_gather_sums {
    aur_counters *counters;
    bool corrected; /* by paths: a sample may be negative */
    aur_vector radiance[AUR_PACKET_SIZE];
    uint32_t pooled_lanes; /* those that add to the pool */
    aur_gather_pooled pooled[AUR_PACKET_SIZE];
    uint32_t directions[AUR_PACKET_SIZE]; /* gathered with by the caller's method */
    /* Working memory. */
    aur_gather_rays rays;
    float *numbers; /* of the caller's method: see gather.h */
} aur_gather_sums;

/* Adds radiance that leaves a lane's shading point towards the camera. */
static inline void aur_gather_add(aur_gather_sums *sums, const aur_gather_points *surface_points, size_t lane,
                                  aur_vector radiance) {
    sums->radiance[lane] =
        aur_vector_add(sums->radiance[lane], aur_vector_multiply(surface_points->throughput[lane], radiance));
}
