/* Final gathering of a tile. */
#pragma once

#include "transport/gather/plan.h"

/* Adds the means of the tile's samples to its pixels, and the directions that were gathered with to an extra
 * channel when the plan is adaptive. Fails with MEMORY only. */
aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile);
