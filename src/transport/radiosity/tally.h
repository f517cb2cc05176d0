/* What the paths of one randomisation have left behind: the power that each patch received, and how the paths
 * ended. Sums are exact, so tallies of several threads can be added in any order. */
#pragma once

#include <stdbool.h>

#include "core/error.h"
#include "transport/radiosity/exact_sum.h"

typedef struct aur_radiosity_tally {
    size_t patch_count;
    aur_exact_sum (*power)[3]; /* patch -> quanta received */
    aur_exact_sum last;        /* received by the last flight, all channels */
    aur_exact_sum rest;        /* carried on after it */
    uint64_t rays, lost, behind, trapped;
    uint64_t cut;    /* terms that were greater than a sum takes; not kept in files */
    bool not_finite; /* one of them was no finite number: the sums are worth nothing */
} aur_radiosity_tally;

aur_result aur_radiosity_tally_create(size_t patch_count, aur_radiosity_tally *tally, aur_error *error);
void aur_radiosity_tally_release(aur_radiosity_tally *tally);
/* Adds `other` and empties it. */
void aur_radiosity_tally_take(aur_radiosity_tally *tally, aur_radiosity_tally *other);
