/* The clear sky and the sun of Hosek and Wilkie (2012, 2013), in sRGB's primaries and on the scale of Mitsuba
 * 3: W/m^2/sr/nm over the integral of CIE's Y. */
#pragma once

#include "points/base/vector.h"

typedef struct aur_hosek_wilkie_sky {
    double parameters[3][9], radiance[3]; /* of R, G, B */
    double sun[3];                        /* unit: to the sun, by east, north and up */
} aur_hosek_wilkie_sky;

/* Turbidity from 1 to 10, the ground's albedo from 0 to 1, the sun above the horizon. Tables are interpolated
 * linearly in turbidity and albedo, and by a quintic in the cube root of the sun's elevation. */
aur_hosek_wilkie_sky aur_hosek_wilkie_sky_make(double turbidity, aur_vector albedo, const double sun[3]);
/* From a direction above the horizon, by east, north and up. */
aur_vector aur_hosek_wilkie_sky_radiance(const aur_hosek_wilkie_sky *sky, const double direction[3]);

/* The mean radiance of the sun's disk when it has a diameter of .5358 degrees; `height` is the sine of its
 * elevation. */
aur_vector aur_hosek_wilkie_sun_radiance(double turbidity, double height);
