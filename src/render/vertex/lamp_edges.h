/* Lamps of a few pixels, which a pixel's first samples and those of its neighbours may all miss: where an
 * edge of one crosses a pixel is known from points on the lamps, before any sample is drawn. Larger lamps are
 * seen by all pixels beside their edges. */
#pragma once

#include "render/film/integrator.h"

/* `looks` for each pixel of the whole picture whose filter may see the edge of such a lamp, 0 for the others.
 * Belongs to the context's cache; NULL where there are none, or the camera is no pinhole. Errors: MEMORY. */
aur_result aur_lamp_edges_find(const aur_view *view, uint16_t looks, const aur_integrator_context *context,
                               const uint16_t **edges, aur_error *error);
