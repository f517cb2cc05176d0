/* Blue noise by optimal transport on the torus. */
#pragma once

#include "points/pointset/relax/relaxation.h"

/* Points that own equal areas, each near the middle of its own, in random order. In each of the rounds all
 * points move to the middles: few leave the points irregular, many make crystals. A round takes time about
 * n. Errors: MEMORY. */
aur_result aur_transport_relax(uint64_t seed, unsigned rounds, size_t count, aur_point2 *sites,
                               aur_error *error);
