/* Light past the edges of narrow gaps, which no ray finds. */
#pragma once

#include "lighting/viewfactors/closed_pairs.h"

/* A patch whose rays arrive only at patches with closed forms, which leave some of its light, as in a narrow
 * gap between two plates: that rest goes to the other patches in front of it, in proportion to what it would
 * see of each if nothing stood between, and to the sky unless the mesh is closed. Each such factor is smaller
 * than those that the rays can find. Errors: MEMORY. */
aur_result aur_unseen_pairs_fill(const aur_facets *facets, aur_visits *visits, aur_closed_pairs *pairs,
                                 aur_error *error);
