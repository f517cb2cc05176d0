/* What rays from every patch arrive at, counted for each randomisation. */
#pragma once

#include "lighting/viewfactors/facet_rays.h"
#include "points/base/parallel.h"

/* The patches that the rays of one patch arrive at. */
typedef struct aur_visits_row {
    size_t count;
    uint32_t *patches; /* ascending */
    uint16_t *hits;    /* [count][randomizations] */
} aur_visits_row;

typedef struct aur_visits {
    size_t patch_count, randomizations;
    size_t rays; /* of one randomisation */
    aur_visits_row *rows;
    double *sky, *back; /* [patch_count][randomizations], in rays */
    /* The rows that a patch stands in: those of sources[starts[i]] .. sources[starts[i + 1] - 1], at
     * places[...] of theirs. */
    size_t *starts;
    uint32_t *sources, *places;
} aur_visits;

/* Errors: CANCELLED, MEMORY. */
aur_result aur_visits_trace(const aur_facets *facets, const aur_facet_pattern *pattern, size_t randomizations,
                            const aur_parallel_options *parallel, aur_visits *visits, aur_error *error);
void aur_visits_release(aur_visits *visits);
