/* The steps of Roberts' additive recurrences. */
#pragma once

#include <stddef.h>

#include "pointset/fraction128.h"

enum { AUR_R2_DIMENSIONS = 64 };

/* steps[d] = t^(d+1), t^s + t^(s+1) = 1 in s dimensions. */
void aur_r2_steps(size_t dimension, aur_fraction128 *steps);
