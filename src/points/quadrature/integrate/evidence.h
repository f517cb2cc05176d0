/* Evidence from the values of a function on the reliability of an interval over replicates. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct aur_evidence {
    size_t count;              /* of values */
    bool all_equal;            /* also for 0 values */
    bool sparse;               /* few values differ from the most frequent one */
    bool dominated;            /* one value contributes most of the sum of magnitudes */
    bool heavy_tail;           /* as of infinite variance */
    double magnitude, largest; /* mean and largest magnitude */
    double jump;               /* the possible effect of a point beyond the sampled values */
} aur_evidence;

/* Evaluates values[count], which it reorders; the first `older` are those of two levels ago. scratch has
 * `count` elements. */
aur_evidence aur_evidence_of(size_t count, size_t older, double *values, double *scratch);
