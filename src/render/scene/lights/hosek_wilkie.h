/* The clear sky and sun of Hosek and Wilkie (2012, 2013), in sRGB primaries and at Mitsuba 3's scale:
 * W/m^2/sr/nm over the integral of CIE's Y. */
#pragma once

#include "points/base/vector.h"

typedef struct aur_hosek_wilkie_sky {
    double parameters[3][9], radiance[3]; /* of R, G, B */
    double sun[3];                        /* unit direction to the sun: east, north, up */
} aur_hosek_wilkie_sky;

/* Turbidity 1 to 10, ground albedo 0 to 1, the sun above the horizon. Interpolates linearly in turbidity and
 * albedo, and by a quintic in the cube root of the sun's elevation. */
aur_hosek_wilkie_sky aur_hosek_wilkie_sky_make(double turbidity, aur_vector albedo, const double sun[3]);
/* Radiance of a direction above the horizon, given as east, north and up. */
aur_vector aur_hosek_wilkie_sky_radiance(const aur_hosek_wilkie_sky *sky, const double direction[3]);

/* The mean radiance of the sun's disk at a diameter of .5358 degrees; `height` is the sine of its elevation.
 */
aur_vector aur_hosek_wilkie_sun_radiance(double turbidity, double height);
