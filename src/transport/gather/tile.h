/* Final gathering of a tile. */
#ifndef AUR_TRANSPORT_GATHER_TILE_H
#define AUR_TRANSPORT_GATHER_TILE_H

#include "transport/gather/plan.h"

/* Adds the means of the tile's samples to its pixels, and the directions that were gathered with to an extra
 * channel when the plan is adaptive. Fails with MEMORY only. */
aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile);

#endif
