/* Additive recurrences: coordinate d of point i is start + i steps[d] modulo 1. */
#pragma once

#include <stddef.h>

#include "points/pointset/fraction128.h"

enum { AUR_R2_DIMENSIONS = 64 };

typedef struct aur_recurrence {
    uint64_t start; /* in units of 2^-64 */
    aur_fraction128 steps[AUR_R2_DIMENSIONS];
} aur_recurrence;

/* The golden ratio sequence from s in [0,1), one dimension. */
void aur_recurrence_golden(double s, aur_recurrence *recurrence);
/* Roberts' sequence in 1 to 64 dimensions. */
void aur_recurrence_r2(size_t dimension, aur_recurrence *recurrence);
