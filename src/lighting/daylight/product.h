/* Daylight coefficients times sky radiances: sixteen randomisations of one sensor at once, hours in blocks.
 * Each hour sums over the patches in the same order for every instruction set. */
#pragma once

#include <stddef.h>

#include "points/base/simd.h"

enum { AUR_DAYLIGHT_LANES = 16, AUR_DAYLIGHT_BLOCK = 4 };

/* values[hours][16] = radiance . coefficients[patches][16]. Radiances are stored in blocks of
 * AUR_DAYLIGHT_BLOCK hours, patch by patch: that of hour h and patch p is at aur_daylight_index. `hours` is a
 * multiple of the block size. */
typedef void aur_daylight_product(size_t hours, size_t patches, const double *radiance,
                                  const double *coefficients, double *values);

static inline size_t aur_daylight_index(size_t patches, size_t hour, size_t patch) {
    return hour / AUR_DAYLIGHT_BLOCK * AUR_DAYLIGHT_BLOCK * patches + patch * AUR_DAYLIGHT_BLOCK +
           hour % AUR_DAYLIGHT_BLOCK;
}

/* The number of hours, rounded up to whole blocks. */
static inline size_t aur_daylight_blocks(size_t hours) {
    return (hours + AUR_DAYLIGHT_BLOCK - 1) / AUR_DAYLIGHT_BLOCK * AUR_DAYLIGHT_BLOCK;
}

AUR_KERNELS(aur_daylight_product, aur_daylight_product);
