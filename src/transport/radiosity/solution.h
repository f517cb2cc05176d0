/* A radiosity solution: the scene as its walk sees it, and the sums of all paths so far, apart for each
 * randomisation. It is not changed by pictures and files; one call at a time may trace it further. */
#pragma once

#include "transport/radiosity/walk.h"

struct aur_radiosity {
    aur_radiosity_scene scene;
    aur_radiosity_walk walk;
    aur_radiosity_options options;
    char *sequence; /* options.sequence */
    uint64_t paths, coincident;
    double change;                /* NaN: never measured */
    aur_radiosity_tally *tallies; /* one a randomisation */
    size_t lane_count;            /* threads that have tallies of their own; 0: none yet */
    aur_radiosity_tally *lanes;   /* [lane_count][randomizations]: empty between calls */
    bool warned;                  /* of paths that ended badly */
};

enum { AUR_RADIOSITY_MOST_BOUNCES = 10000, AUR_RADIOSITY_MOST_RANDOMIZATIONS = 1024 };

/* Paths that randomisation r has among the first `paths`. */
static inline uint64_t aur_radiosity_share(const aur_radiosity *radiosity, size_t r, uint64_t paths) {
    const uint64_t count = radiosity->options.randomizations;
    return paths / count + (r < paths % count);
}
