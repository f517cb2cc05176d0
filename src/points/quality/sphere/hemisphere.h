/* Mean distances on the hemisphere. */
#pragma once

#include "points/quality/pairs/twofold.h"

/* The mean distance from a point of the unit sphere with height z, -1 <= z <= 1, to the hemisphere z >= 0; to
 * the last bits. */
double aur_hemisphere_potential(double z);

/* The mean distance of two points of the hemisphere, 32 / (9 pi), to twice the precision. */
static inline aur_twofold aur_hemisphere_mean_distance(void) {
    return (aur_twofold){1.1317684842090334, 7.806110843826092e-17};
}
