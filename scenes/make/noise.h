/* Smooth noise from hashes. */
#pragma once

#include "vec.h"

/* Gradient noise (Perlin 2002) over space: about -1 to 1, mean 0, one feature a unit. */
double noise(vec p);
/* The sum of `octaves` of it, each of twice the frequency and half the height. */
double fractal_noise(vec p, int octaves);
