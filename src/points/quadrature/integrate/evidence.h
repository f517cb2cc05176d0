/* What the values of a function say of how far an interval over replicates can be trusted. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct aur_evidence {
    size_t count;              /* of values */
    bool all_equal;            /* 0 values are */
    bool sparse;               /* few values differ from the most frequent one */
    bool dominated;            /* one value has most of the sum of magnitudes */
    bool heavy_tail;           /* as of infinite variance */
    double magnitude, largest; /* mean and largest magnitude */
    double jump;               /* what a point may add that no value has shown */
} aur_evidence;

/* Judges values[count] (reordered), of which the first `older` were there two levels ago; scratch has room
 * for as many. */
aur_evidence aur_evidence_of(size_t count, size_t older, double *values, double *scratch);
