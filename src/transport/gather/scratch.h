/* Working memory of estimators. Nothing in it outlives a call. */
#pragma once

#include "transport/gather/incident.h"

typedef struct aur_gather_scratch {
    aur_gather_rays rays;
    /* Weights of merged samples, a sample's sixteen lanes together, for one lobe and then the other; behind
     * them room for one lane's. */
    float *merged;
    float *values; /* adaptive gathering: 3 * AUR_PACKET_SIZE for each direction of the largest rule */
} aur_gather_scratch;

/* NULL when out of memory. */
aur_gather_scratch *aur_gather_scratch_create(const aur_gather_plan *plan);
void aur_gather_scratch_destroy(aur_gather_scratch *scratch); /* NULL is allowed */
